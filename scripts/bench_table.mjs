// One Markdown table from what bench_runtime writes, read from standard input:
//   bench_runtime --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true --benchmark_format=json |
//     node scripts/bench_table.mjs
// Medians of processor time a character, beside the same run's multiply-adds; then how straight the lines are.
import { readFileSync } from 'node:fs';

const { context, benchmarks } = JSON.parse(readFileSync(0, 'utf8'));
const runs = new Map();
for (const run of benchmarks) {
  if (run.run_type === 'aggregate') continue;
  // `cpu_time` is in nanoseconds of one iteration; us_per_character is its counter in microseconds.
  const us = run.us_per_character ?? run.cpu_time / 1000;
  if (!runs.has(run.name)) runs.set(run.name, []);
  runs.get(run.name).push(us);
}
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const loop = runs.get('calibrate');
if (!loop) {
  console.error('bench_table: the run has no `calibrate`; run bench_runtime without a filter that leaves it out');
  process.exit(2);
}
console.log(`Kernels: ${context.kernels}. One unit is ${median(loop).toFixed(3)} us, 16 000 multiply-adds.\n`);
console.log('| what | us, median | least | most | in units |\n| --- | ---: | ---: | ---: | ---: |');
const in_order = [...runs].sort(([a], [b]) => a.localeCompare(b, 'en', { numeric: true }));
for (const [name, values] of in_order)
  console.log(`| ${name} | ${median(values).toFixed(3)} | ${Math.min(...values).toFixed(3)} | ` +
    `${Math.max(...values).toFixed(3)} | ${(median(values) / median(loop)).toFixed(3)} |`);

// A straight line by least squares through the medians of one benchmark over its argument.
for (const [what, prefix] of [['clips', 'sample_blend/vector/clips:'], ['joints', 'crowd_frame_by_joints/joints:']]) {
  const points = [...runs].filter(([name]) => name.startsWith(prefix))
    .map(([name, values]) => [Number(name.slice(prefix.length)), median(values)]);
  if (points.length < 3) continue;
  const mean = (k) => points.reduce((sum, p) => sum + p[k], 0) / points.length;
  const [x, y] = [mean(0), mean(1)];
  const slope = points.reduce((sum, p) => sum + (p[0] - x) * (p[1] - y), 0) /
    points.reduce((sum, p) => sum + (p[0] - x) ** 2, 0);
  const worst = Math.max(...points.map((p) => Math.abs(p[1] - (y + slope * (p[0] - x))) / p[1]));
  console.log(`\nOver ${what}: ${(y - slope * x).toFixed(3)} us + ${slope.toFixed(4)} us each; ` +
    `the worst is ${(100 * worst).toFixed(0)} % off the line.`);
}
