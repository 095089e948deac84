import { defineConfig } from 'vite';
import { fileURLToPath } from 'node:url';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

// Built to build/studio, which `surefoot studio` serves; the same files work from any static server, in any folder.
export default defineConfig({
  base: './',
  build: {
    outDir: here('../../build/studio'),
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0, // the content security policy has no place for data: but in pictures
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 900,
    reportCompressedSize: false,
  },
  worker: { format: 'es' },
  esbuild: { jsx: 'automatic', jsxImportSource: 'preact' },
  resolve: {
    alias: [
      { find: /^@wasm/, replacement: here('../../build/wasm/surefoot.wasm') },
      { find: '@bindings', replacement: here('../../bindings/wasm') },
    ],
  },
  server: { headers: { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' } },
});
