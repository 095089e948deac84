// The same frames natively and as WebAssembly in Node, rounds in turns, then one Markdown table.
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
// Scenes by the numbers that bench/wasm/frames.cpp knows them by. The default character's are at least a few steps long.
const scenes = [
  { scene: 0, name: 'without ground', crowds: [1, 8, 100, 1000, 10000] },
  { scene: 1, name: 'feet on hills', crowds: [8, 100, 1000, 10000] },
  { scene: 2, name: 'a hero on hills', crowds: [1] },
];
const budget = 200000, least = 4, heroes = 20;  // characters' frames a round, frames; a hero's costs so many others'
console.log('| what | characters | native, us | WebAssembly, us | ratio |\n| --- | ---: | ---: | ---: | ---: |');
let kernels;
for (const { scene, name, crowds } of scenes)
  for (const characters of crowds) {
    const frames = Math.max(least, Math.ceil(budget / characters / (scene === 2 ? heroes : 1)));
    const us = { native: [], wasm: [] };
    for (let round = 0; round < Number(rounds); ++round) {
      const run = JSON.parse(execFileSync(program, [scene, characters, frames], { encoding: 'utf8' }));
      kernels = run.kernels;
      us.native.push(run.us);
      const warm = instance.exports.play(scene, characters, frames), began = cpu();
      const sum = instance.exports.play(scene, characters, frames);
      us.wasm.push((cpu() - began) / characters / frames);
      if (round === 0 && (Math.fround(run.warm) !== warm || Math.fround(run.sum) !== sum))
        throw new Error(`${name}, ${characters} characters: WebAssembly's poses are not the native ones`);
    }
    console.log(`| ${name} | ${characters} | ${median(us.native).toFixed(3)} | ${median(us.wasm).toFixed(3)} | ` +
      `${(median(us.wasm) / median(us.native)).toFixed(2)} |`);
  }
console.log(`\nNative kernels: ${kernels}.`);
