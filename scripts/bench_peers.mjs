// Surefoot beside the libraries that Debian and npm offer, at the same work: rounds in turns, then one Markdown table.
//   node scripts/bench_peers.mjs BUILD_FOLDER [ROUNDS]
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [build, rounds = '5'] = process.argv.slice(2);
const program = build && join(build, 'bench/peers/bench_peers');
if (!program || !existsSync(program) || !(Number(rounds) >= 1)) {
  console.error('usage: node scripts/bench_peers.mjs BUILD_FOLDER [ROUNDS]   (BUILD_FOLDER/bench/peers/bench_peers is built by `make bench`)');
  process.exit(2);
}
const here = new URL('..', import.meta.url).pathname;
const has_three = existsSync(join(here, 'tests/judges/node_modules/three'));
if (!has_three) console.error('bench_peers: three.js is left out; `make test` installs it where there is a Node');

// What a library says on standard error passes through.
const run = (file, args) => JSON.parse(execFileSync(file, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] }));
const folder = mkdtempSync(join(tmpdir(), 'surefoot-peers-'));
const hero = join(folder, 'hero.json');
const rows = new Map();  // name -> { us: [], single, mixed }
try {
  execFileSync(program, ['--write-hero', hero]);
  for (let round = 0; round < Number(rounds); ++round) {
    if (process.stderr.isTTY) process.stderr.write(`\rround ${round + 1} of ${rounds}`);
    const all = [...run(program, ['--benchmark_format=json', '--benchmark_min_time=0.2']).benchmarks];
    if (has_three)
      all.push(...run(process.execPath, ['--max-old-space-size=12000', join(here, 'bench/peers/three.mjs'), hero]).benchmarks);
    for (const one of all) {
      if (one.error_occurred) throw new Error(`${one.name}: ${one.error_message}`);
      if (!rows.has(one.name)) rows.set(one.name, { us: [], single: one.single_clip_mm, mixed: one.mixed_mm });
      rows.get(one.name).us.push(one.us_per_character);
    }
  }
} finally {
  rmSync(folder, { recursive: true });
  if (process.stderr.isTTY) process.stderr.write('\n');
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const names = [...new Set([...rows.keys()].map((name) => name.split('/')[0]))];
const us = (name, count) => median(rows.get(`${name}/characters:${count}`).us);
console.log('| library | us, 100 characters | times ours | us, 10 000 | times ours | one clip, mm apart | three mixed, mm apart |');
console.log('| --- | ---: | ---: | ---: | ---: | ---: | ---: |');
for (const name of names) {
  const { single, mixed } = rows.get(`${name}/characters:100`);
  const times = (count) => (us(name, count) / us('surefoot', count)).toFixed(1);
  console.log(`| ${name} | ${us(name, 100).toFixed(2)} | ${times(100)} | ${us(name, 10000).toFixed(2)} | ${times(10000)} | ` +
    `${single.toFixed(3)} | ${mixed.toFixed(1)} |`);
}
