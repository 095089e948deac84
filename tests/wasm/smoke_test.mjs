// The WebAssembly module in plain Node against the native build: same hashes, same facts, same weights.
//
//   node tests/wasm/smoke_test.mjs MODULE.wasm NATIVE_TWIN
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { load } from '../../bindings/wasm/surefoot.mjs';

const [moduleFile, twinFile] = process.argv.slice(2);
const twin = (what) => execFileSync(twinFile, [what], { encoding: 'utf8', maxBuffer: 1 << 28 });
const surefoot = await load(readFileSync(moduleFile));

let passed = 0;
function test(name, body) {
  body();
  console.log(`ok  ${name}`);
  ++passed;
}

test('every scenario has the same bits as natively', () => {
  const lines = surefoot.scenarios();
  assert.ok(lines.split('\n').length > 2);
  assert.equal(lines, twin('scenarios'));
});

test('the facts of a clip are the same text as natively', () => {
  const facts = surefoot.analyzeBvh(twin('bvh'));
  assert.deepEqual(facts, JSON.parse(twin('facts')));
  assert.ok(facts.frames > 10 && Number.isFinite(facts.speed_mps));
});

test('a bad file throws our message', () => {
  assert.throws(() => surefoot.analyzeBvh('HIERARCHY nonsense'), /clip\.bvh/);
  assert.throws(() => surefoot.analyzeBvh(''), /clip\.bvh/);
});

test('a blend space gives barycentric weights and clamps outside', () => {
  const space = surefoot.space([[0, 0], [2, 0], [2, 80]], [0, -90], [5, 90]);
  const middle = space.weights([1, 0]);
  assert.equal(middle.reduce((sum, w) => sum + w.weight, 0), 1);
  assert.deepEqual(middle.filter((w) => w.weight > 0).map((w) => [w.sample, w.weight]), [[0, 0.5], [1, 0.5]]);
  const outside = space.weights([99, 0]);
  assert.ok(outside.find((w) => w.sample === 1).weight > 0.9);
  assert.throws(() => surefoot.space([], [0], [1]), /at least one sample/);
});

test('memory grows and is given back', () => {
  const space = surefoot.space([[0], [1]], [0], [1]);
  for (let i = 0; i < 20000; ++i) space.weights([i / 20000]);
  surefoot.scenarios();
});

console.log(`${passed} tests passed`);
