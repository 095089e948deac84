// The same frames of a crowd natively and as WebAssembly in Node, rounds in turns, then one Markdown table.
//   node scripts/bench_wasm.mjs NATIVE_BUILD WASM_BUILD [ROUNDS]
// with bench_frames built in both (-DSUREFOOT_BUILD_BENCH=ON; natively -DSUREFOOT_KERNELS_X86_64=OFF compares with x86-64-v2).
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const [native, wasm, rounds = '7'] = process.argv.slice(2);
if (!wasm || !(Number(rounds) >= 1)) {
  console.error('usage: node scripts/bench_wasm.mjs NATIVE_BUILD WASM_BUILD [ROUNDS]');
  process.exit(2);
}
const program = join(native, 'bench/wasm/bench_frames');
const nothing = new Proxy({}, { get: () => new Proxy({}, { get: () => () => 0, has: () => true }) });
const { instance } = await WebAssembly.instantiate(readFileSync(join(wasm, 'bench/wasm/bench_frames.wasm')), nothing);
instance.exports._initialize?.();

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const cpu = () => { const { user, system } = process.cpuUsage(); return user + system; };
console.log('| characters | native, us | WebAssembly, us | ratio |\n| ---: | ---: | ---: | ---: |');
let kernels;
for (const characters of [1, 8, 100, 1000, 10000]) {
  const frames = Math.max(4, Math.ceil(200000 / characters)), us = { native: [], wasm: [] };
  for (let round = 0; round < Number(rounds); ++round) {
    const run = JSON.parse(execFileSync(program, [characters, frames], { encoding: 'utf8' }));
    kernels = run.kernels;
    us.native.push(run.us);
    const warm = instance.exports.play(characters, frames), began = cpu();
    const sum = instance.exports.play(characters, frames);
    us.wasm.push((cpu() - began) / characters / frames);
    if (round === 0 && (Math.fround(run.warm) !== warm || Math.fround(run.sum) !== sum))
      throw new Error(`${characters} characters: WebAssembly's matrices are not the native ones`);
  }
  console.log(`| ${characters} | ${median(us.native).toFixed(3)} | ${median(us.wasm).toFixed(3)} | ` +
    `${(median(us.wasm) / median(us.native)).toFixed(2)} |`);
}
console.log(`\nNative kernels: ${kernels}.`);
