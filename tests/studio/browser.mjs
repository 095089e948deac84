// A real browser and the built studio, for tests and for pictures.
import { createServer } from 'node:http';
import { existsSync, readFileSync, statSync } from 'node:fs';
import path from 'node:path';

const k_types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
};

/** Says what is missing, or gives playwright's chromium with arguments that keep it to itself. */
export async function findBrowser() {
  const executablePath = process.env.CHROMIUM || '/usr/bin/chromium';
  if (!existsSync(executablePath)) return { missing: `no browser at ${executablePath} (apt-get install chromium)` };
  let playwright;
  try {
    playwright = await import('playwright-core');
  } catch {
    return { missing: 'playwright-core is not installed (cd tests/studio && npm ci)' };
  }
  const args = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run'];
  args.push('--disable-background-networking', '--disable-component-update', '--disable-sync', '--mute-audio');
  return { launch: () => playwright.chromium.launch({ executablePath, args }) };
}

/** The studio as static files, as any web server gives them: no headers of ours. Ends with `close`. */
export async function serveStatic(built) {
  const folder = path.resolve(built);
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    const file = path.join(folder, name.endsWith('/') ? `${name}index.html` : name);
    if (!file.startsWith(folder) || !existsSync(file) || !statSync(file).isFile()) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'content-type': k_types[path.extname(file)] ?? 'application/octet-stream' });
    response.end(readFileSync(file));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** Until the engine has given its first frames, and the workspace is there with all that it begins with. */
export async function untilItMoves(page) {
  await page.waitForFunction(() => globalThis.studio?.session.frameCount.value > 2);
  await page.evaluate(() => globalThis.studio.entered());
}
