// The WebAssembly module in plain Node against the native build: same hashes, same facts, same weights.
//
//   node tests/wasm/smoke_test.mjs MODULE.wasm NATIVE_TWIN
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { load } from '../../bindings/wasm/surefoot.mjs';

const [moduleFile, twinFile] = process.argv.slice(2);
const twin = (what) => execFileSync(twinFile, [what], { encoding: 'utf8', maxBuffer: 1 << 28 });
const surefoot = await load(readFileSync(moduleFile));
const nothing = new Proxy({}, { get: () => new Proxy({}, { get: () => () => 0, has: () => true }) });
const { instance } = await WebAssembly.instantiate(readFileSync(moduleFile), nothing);

const types = readFileSync(new URL('../../bindings/wasm/surefoot.d.mts', import.meta.url), 'utf8');
/** The members that an interface of it declares. */
function keys(name) {
  const body = types.match(new RegExp(`export interface ${name} \\{\n([^]*?)\n\\}`))[1];
  return [...body.matchAll(/^  (\w+):/gm)].map((match) => match[1]).sort();
}

let passed = 0;
async function test(name, body) {
  await body();
  console.log(`ok  ${name}`);
  ++passed;
}

await test('every scenario has the same bits as natively', () => {
  const lines = surefoot.scenarios();
  assert.ok(lines.split('\n').length > 2);
  assert.equal(lines, twin('scenarios'));
});

await test('the facts of a clip are the same text as natively', () => {
  const facts = surefoot.analyzeBvh(twin('bvh'));
  assert.deepEqual(facts, JSON.parse(twin('facts')));
  assert.ok(facts.frames > 10 && Number.isFinite(facts.speed_mps));
});

await test('a bad file throws our message', () => {
  assert.throws(() => surefoot.analyzeBvh('HIERARCHY nonsense'), /clip\.bvh/);
  assert.throws(() => surefoot.analyzeBvh(''), /clip\.bvh/);
});

await test('a blend space gives barycentric weights and clamps outside', () => {
  const space = surefoot.space([[0, 0], [2, 0], [2, 80]], [0, -90], [5, 90]);
  const middle = space.weights([1, 0]);
  assert.equal(middle.reduce((sum, w) => sum + w.weight, 0), 1);
  assert.deepEqual(middle.filter((w) => w.weight > 0).map((w) => [w.sample, w.weight]), [[0, 0.5], [1, 0.5]]);
  const outside = space.weights([99, 0]);
  assert.ok(outside.find((w) => w.sample === 1).weight > 0.9);
  assert.throws(() => surefoot.space([], [0], [1]), /at least one sample/);
});

await test('memory grows and is given back', () => {
  const space = surefoot.space([[0], [1]], [0], [1]);
  for (let i = 0; i < 20000; ++i) space.weights([i / 20000]);
  surefoot.scenarios();
});

await test('the module exports what surefoot.d.mts declares, with as many parameters', () => {
  const declared = new Map();
  for (const [, name, parameters] of types.matchAll(/^  (sf_\w+)\((.*)\): \w+;$/gm))
    declared.set(name, parameters === '' ? 0 : parameters.split(',').length);
  const exported = Object.entries(instance.exports).filter(([name]) => name.startsWith('sf_'));
  assert.ok(exported.length > 10);
  assert.deepEqual([...declared].sort(), exported.map(([name, call]) => [name, call.length]).sort());
});

/** What native twin and browser play alike; see twin.cpp. */
function playStage(frame) {
  surefoot.openDefault();
  const play = (frames, parts) => {
    for (let f = 0; f < frames; ++f) {
      surefoot.advance(1, parts);
      frame(surefoot.array('frame'));
    }
  };
  surefoot.setCourse('stairs_up', 15);
  surefoot.patrol(1.2);
  play(300, 1);
  surefoot.steer(1.4, 0, 30);
  play(120, 1);
  surefoot.setMode('colvin2013');
  surefoot.steer(0.5, 0.25, -20);
  play(60, 2);
  surefoot.setMode('none');
  play(60, 1);
}

await test('a steered walk has the same bits as natively, frame by frame', () => {
  const native = execFileSync(twinFile, ['stage'], { maxBuffer: 1 << 28 });
  let at = 0;
  playStage((frame) => {
    const bytes = Buffer.from(frame.buffer, frame.byteOffset, frame.byteLength);
    assert.ok(bytes.equals(native.subarray(at, at + bytes.length)), `the frame at byte ${at}`);
    at += bytes.length;
  });
  assert.equal(at, native.length);
});

await test('what a character is has all that surefoot.d.mts declares, and its mesh is sound', () => {
  const facts = surefoot.openDefault();
  assert.deepEqual(Object.keys(facts).sort(), keys('CharacterFacts'));
  assert.deepEqual(Object.keys(facts.layout).sort(), keys('FrameLayout'));
  const joints = facts.joints.length, vertices = surefoot.array('positions').length / 3;
  const { ghosts, ghostFloats, mostGhosts, ghost } = facts.layout;
  assert.equal(ghosts, facts.layout.joints + 16 * joints);
  assert.equal(ghostFloats, ghost.joints + 16 * joints);
  assert.equal(surefoot.array('frame').length, ghosts + mostGhosts * ghostFloats);
  assert.equal(surefoot.array('inverseBind').length, 16 * joints);
  assert.equal(surefoot.array('weights').length, 4 * vertices);
  assert.ok(surefoot.array('triangles').every((corner) => corner < vertices));
  assert.ok(surefoot.array('joints').every((joint) => joint < joints));
  assert.ok(surefoot.array('terrain').length > 0 && surefoot.array('terrainTriangles').length % 3 === 0);
});

await test('a project under another threshold, what mends it, and what the probe finds are the same text as natively', () => {
  surefoot.openDefault();
  const [weights, described, attempts, mended, heat] = twin('bench').split('\n').map((line) => line && JSON.parse(line));
  assert.deepEqual(surefoot.blend('facing', [1, 20]), weights);
  const before = surefoot.benchDefault();
  const after = surefoot.benchThreshold('too-close', 'distance', 20);
  assert.deepEqual(after, described);
  assert.ok(after.findings.length > before.findings.length, 'a wider threshold finds more');
  assert.deepEqual(surefoot.benchFix(), attempts);
  assert.ok(attempts.some(({ done }) => done), 'something is mended');
  surefoot.benchProbe(5);
  assert.deepEqual(surefoot.bench(), mended);
  assert.deepEqual(surefoot.benchHeat(), heat);
  assert.ok(heat.length > 4 && heat[0].cells.some(({ value }) => value > heat[0].least));
  assert.throws(() => surefoot.blend('nowhere', [0]), /no such blend space/);
  const sum = surefoot.blend('lateral', [0.2, 0.1]).reduce((total, each) => total + each.weight, 0);
  assert.ok(Math.abs(sum - 1) < 1e-6);
  const shapes = {
    BenchFacts: after, SpaceFacts: after.spaces[0], LintRule: after.rules[0], Finding: after.findings[0],
    FixAttempt: attempts[0], Heat: heat[0],
  };
  for (const [name, value] of Object.entries(shapes)) assert.deepEqual(Object.keys(value).sort(), keys(name), name);
});

await test('every step on the bench can be undone and done again, and a bad one changes nothing', () => {
  const before = surefoot.benchDefault();
  assert.equal(before.undo, null);
  const clip = 'strafe_left';
  const left = surefoot.benchLeaveOut(clip, true);
  assert.ok(left.leftOut.some((each) => each.clip === clip && each.byUser && each.atHand));
  surefoot.benchFix();
  const mended = surefoot.bench();
  assert.ok(mended.repairs.length > 0);
  const taken = surefoot.benchTakeBack(mended.repairs[0].id);
  assert.ok(taken.repairs.length < mended.repairs.length);
  const steps = ({ undo, redo, ...rest }) => rest;
  assert.deepEqual(steps(surefoot.benchUndo()), steps(mended));
  assert.deepEqual(steps(surefoot.benchUndo()), steps(left));
  assert.deepEqual(steps(surefoot.benchUndo()), steps(before));
  assert.deepEqual(steps(surefoot.benchUndo()), steps(before), 'there is nothing before the beginning');
  assert.deepEqual(steps(surefoot.benchRedo()), steps(left));
  assert.throws(() => surefoot.benchThreshold('too-close', 'nonsense', 1), /too-close/);
  assert.throws(() => surefoot.benchTakeBack('77'), /77/);
  assert.throws(() => surefoot.benchLeaveOut('nobody', true), /nobody/);
  assert.throws(() => surefoot.benchAuthor([['a.bvh', new Uint8Array(3)]], 'x'), /a\.bvh/);
  assert.throws(() => surefoot.benchOpen([]), /project\.json/);
  assert.throws(() => surefoot.benchOpen([['project.json', new TextEncoder().encode('{"version": 1')]]), /project\.json/);
  assert.deepEqual(steps(surefoot.bench()), steps(left));
  surefoot.benchThreshold('too-close', 'distance', 20);
  const [one, two] = [surefoot.benchThreshold('too-close', 'distance', 21), surefoot.benchUndo()];
  assert.equal(one.undo, 'too-close.distance', 'a slider that is dragged is one step');
  assert.deepEqual(steps(two), steps(left));
});

await test('a project that is mended gives the same files and the same pack as natively, and opens again from them', () => {
  surefoot.benchDefault();
  surefoot.benchFix();
  const { files } = surefoot.benchFiles(true), pack = surefoot.benchPack();
  const made = Buffer.concat([...files.map(([, bytes]) => bytes), pack]);
  assert.ok(made.equals(execFileSync(twinFile, ['files'], { maxBuffer: 1 << 28 })));
  const again = surefoot.benchOpen(files);
  assert.equal(again.unsaved, false);
  assert.equal(again.name, 'Default character');
  assert.deepEqual(surefoot.benchFiles(false).files.map(([name]) => name), ['project.json', 'report.html']);
  assert.equal(surefoot.benchOpen(files, false).unsaved, true);
  assert.deepEqual(surefoot.benchFiles(false).files.map(([name]) => name).sort(), files.map(([name]) => name).sort());
  const told = surefoot.openPack(pack);
  surefoot.advance(10);
  assert.throws(() => surefoot.openPack(pack.subarray(0, 1000)), /pack/);
  surefoot.advance(10);
});

await test('long work is told step by step', async () => {
  const told = [];
  const watched = await load(readFileSync(moduleFile), (...step) => told.push(step.join(' ')));
  watched.benchAuthor([['clip.bvh', new TextEncoder().encode(twin('bvh'))]], 'one');
  assert.deepEqual(told, ['reading 0 1', 'reading 1 1', 'measuring 0 1', 'measuring 1 1']);
});

await test('ghosts are the clips that play, each in a pose of its own', () => {
  const { layout, clipNames } = surefoot.openDefault();
  surefoot.setCourse('flat', 15);
  surefoot.steerTo('facing', [1.7, 12]);
  surefoot.advance(180);
  const frame = surefoot.array('frame').slice();
  const playing = surefoot.blend('facing', [1.7, 12]).filter(({ weight }) => weight > 0.02);
  for (const [g, { clip, weight }] of playing.entries()) {
    const at = layout.ghosts + g * layout.ghostFloats;
    assert.ok(Math.abs(frame[at + layout.ghost.weight] - weight) < 1e-3);
    assert.equal(clipNames[frame[at + layout.ghost.clip]], clip);
    // Near the character's own hips, and not the same.
    const apart = Math.hypot(...[12, 13, 14].map((k) => frame[at + layout.ghost.joints + k] - frame[layout.joints + k]));
    assert.ok(apart > 0 && apart < 0.2, `${clip}: ${apart}`);
  }
  assert.ok(playing.length > 1);
});

await test('a gait that is shaped while it goes has the same bits as natively, frame by frame', () => {
  const native = execFileSync(twinFile, ['gait'], { maxBuffer: 1 << 28 });
  surefoot.openDefault();
  const facts = surefoot.gaitRead(surefoot.gaitSource('bhatti2017'));
  const values = (changes) => facts.parameters.map((each) => changes[each.name] ?? each.initial);
  let at = 0;
  const play = (values, speed, turn, slope) => {
    surefoot.gaitPlay(values, speed, turn, slope);
    for (let f = 0; f < 100; ++f) {
      surefoot.advance(1);
      const frame = surefoot.array('frame');
      const bytes = Buffer.from(frame.buffer, frame.byteOffset, frame.byteLength);
      assert.ok(bytes.equals(native.subarray(at, at + bytes.length)), `the frame at byte ${at}`);
      at += bytes.length;
    }
  };
  play(values({}), 0, 0, 0);
  play(values({ df: 0.2 }), 0, 0, 0);
  play(values({ df: 0.2, Shgt: 0.6 }), 1.1, 20, 0);
  surefoot.gaitFitted('jog');
  const stiff = surefoot.gaitPersonality('{"stiff": {"spine": {"lean_deg": 12}}}');
  play(surefoot.gaitPersonality('{"own": {}}'), 2.3, 0, 0);
  play(stiff, 1.2, -30, 0);
  play(stiff, 1.2, 0, 9);
  surefoot.gaitRig('child', surefoot.rigs().find(({ name }) => name === 'child').parameters.map((each) => each.initial));
  play(stiff, 1.2, 0, 9);
  assert.equal(at, native.length);
  surefoot.gaitStop();
});

await test('gaits have all that surefoot.d.mts declares, can be saved, and a bad text changes nothing', () => {
  surefoot.openDefault();
  assert.throws(() => surefoot.gaitPlay([], 0, 0, 0), /no gait yet/);
  for (const { name, fitted } of surefoot.gaits()) if (!fitted) surefoot.gaitRead(surefoot.gaitSource(name));
  const facts = surefoot.gaitRead(surefoot.gaitSource('bhatti2017'));
  const initial = facts.parameters.map((each) => each.initial);
  surefoot.gaitPlay(initial, 0, 0, 0);
  const played = surefoot.gaitPlayed(), curves = surefoot.array('gaitCurves').slice();
  const points = curves.length / played.curves.length;
  assert.ok(Number.isInteger(points) && points > 50);
  // Feet go up and come down again in a cycle; the body goes on.
  const lift = played.curves.findIndex(({ name }) => name === 'LeftFoot.tY'), foot = curves.subarray(lift * points, (lift + 1) * points);
  assert.ok(Math.abs(foot[0] - foot[points - 1]) < 1e-4 && Math.max(...foot) > Math.min(...foot) + 0.02, `${foot}`);
  const names = { GaitFacts: facts, GaitParameter: facts.parameters[0], GaitPreset: facts.presets[0], GaitPlayed: played };
  for (const [name, value] of Object.entries(names)) assert.deepEqual(Object.keys(value).sort(), keys(name), name);
  assert.throws(() => surefoot.gaitRead('gait x\nparameter a = 1 +'), /:2:\d+[^]*\^/);
  assert.throws(() => surefoot.gaitSource('moonwalk'), /no such gait/);
  surefoot.gaitPlay(initial.map((value, i) => (facts.parameters[i].name === 'df' ? 0.3 : value)), 0, 0, 0);
  assert.notDeepEqual(surefoot.array('gaitCurves').slice(), curves);
  surefoot.gaitPlay(initial, 0, 0, 0);
  assert.deepEqual(surefoot.gaitPlayed(), played);
  assert.deepEqual(surefoot.array('gaitCurves').slice(), curves);
  const saved = surefoot.analyzeBvh(new TextDecoder().decode(surefoot.gaitFile('bvh')));
  assert.ok(Math.abs(saved.speed_mps - played.speed) < 0.02, `${saved.speed_mps} and ${played.speed}`);
  assert.equal(new TextDecoder().decode(surefoot.gaitFile('glb').subarray(0, 4)), 'glTF');
  // Who stops goes by its own clips, as if nothing had been.
  surefoot.gaitStop();
  surefoot.setCourse('flat', 15);
  surefoot.patrol(1);
  surefoot.advance(120);
  const after = surefoot.array('frame').slice();
  surefoot.openDefault();
  surefoot.setCourse('flat', 15);
  surefoot.patrol(1);
  surefoot.advance(120);
  assert.deepEqual(surefoot.array('frame').slice(), after);
});

await test('fitted gaits go as fast, and turn, as they are asked to, on every body, uphill too', () => {
  surefoot.openDefault();
  const own = surefoot.array('frame').length;
  const walk = surefoot.gaitFitted('walk'), rigs = surefoot.rigs();
  for (const [name, value] of Object.entries({ GaitFacts: walk, GaitRange: walk.speed, RigFacts: rigs[0] }))
    assert.deepEqual(Object.keys(value).sort(), keys(name), name);
  const initial = walk.parameters.map((each) => each.initial);
  assert.deepEqual(surefoot.gaitPersonality('{"nobody": {}}'), initial);
  assert.deepEqual(walk.presets.find(({ name }) => name === 'neutral').values, initial);
  for (const { name, parameters } of rigs) {
    const { gait, character } = surefoot.gaitRig(name, parameters.map((each) => each.initial));
    assert.ok(character.name === name && character.clipNames.length === 0);
    for (const [speed, turn] of [[1.2, 0], [1.6, -40], [gait.speed.high, 0]]) {
      surefoot.gaitPlay(initial, speed, turn, 0);
      const played = surefoot.gaitPlayed();
      assert.ok(Math.abs(played.speed - speed) < 0.02 * speed, `${name}: ${played.speed} for ${speed} m/s`);
      assert.ok(Math.abs(played.turn - turn) < 1, `${name}: ${played.turn} for ${turn} deg/s`);
    }
  }
  // A finger more, and the frame has other joints; its own body again, and all is as it was.
  const child = rigs.find(({ name }) => name === 'child');
  const values = (changes) => child.parameters.map((each) => changes[each.name] ?? each.initial);
  const small = surefoot.gaitRig('child', values({ stature: 0.9 })).character.hipHeight;
  const { character } = surefoot.gaitRig('child', values({ stature: 1.3, fingers: 1, spine: 5 }));
  assert.ok(character.hipHeight > 1.3 * small && character.joints.length > 50);
  assert.ok(surefoot.array('frame').length > own);
  // The ground goes up under it, and its soles are on it.
  surefoot.gaitPlay(initial, 1.2, 0, 12);
  const { layout } = character;
  const start = surefoot.array('frame').slice();
  surefoot.advance(240);
  const frame = surefoot.array('frame').slice();
  const gone = [0, 1, 2].map((k) => frame[layout.root + k] - start[layout.root + k]);
  assert.ok(gone[2] > 3 && Math.abs(gone[1] / gone[2] - Math.tan((12 * Math.PI) / 180)) < 1e-3, `${gone}`);
  let least = 1, most = -1;
  for (let f = 0; f < 60; ++f) {
    surefoot.advance(1);
    const low = Math.min(...[0, 1].map((side) => surefoot.array('frame')[layout.feet + side * layout.footFloats + layout.foot.clearance]));
    least = Math.min(least, low);
    most = Math.max(most, low);
  }
  assert.ok(least > -0.03 && most < 0.04, `the lower sole is ${least} to ${most} m over the slope`);
  assert.throws(() => surefoot.gaitRig('child', values({}).slice(1)), /one value a parameter/);
  assert.throws(() => surefoot.gaitRig('ogre', []), /no template/);
  assert.throws(() => surefoot.gaitFitted('moonwalk'), /no fitted gait/);
  assert.throws(() => surefoot.gaitPersonality('{"x": {"spine": {"lean": 1}}}'), /no slider 'spine.lean'/);
  assert.equal(surefoot.gaitStop().clipNames.length, 19);
  assert.equal(surefoot.gaitStop(), null);
  assert.equal(surefoot.array('frame').length, own);
});

const graphFile = fileURLToPath(new URL('../../apps/studio/src/graphs/stroll.json', import.meta.url));
const graphText = readFileSync(graphFile, 'utf8');

await test('a graph has the same bits as natively, frame by frame, and says the same of itself', () => {
  const native = execFileSync(twinFile, ['graph', graphFile], { maxBuffer: 1 << 28 });
  surefoot.openDefault();
  const facts = surefoot.graphRead(graphText);
  let at = 0;
  const play = (frames) => {
    for (let f = 0; f < frames; ++f) {
      surefoot.advance(1);
      const frame = surefoot.array('frame');
      const bytes = Buffer.from(frame.buffer, frame.byteOffset, frame.byteLength);
      assert.ok(bytes.equals(native.subarray(at, at + bytes.length)), `the frame at byte ${at}`);
      at += bytes.length;
    }
  };
  play(100);
  surefoot.graphSet(3, 1);
  play(100);
  surefoot.graphSet(0, 0);
  play(60);
  const [described, live] = native.subarray(at).toString().split('\n').map((line) => line && JSON.parse(line));
  assert.deepEqual(facts, described);
  assert.deepEqual(surefoot.graphLive(), live);
  assert.ok(live.events.length > 5 && live.events.every(({ event }) => facts.events[event].endsWith('_strike')));
});

await test('graphs have all that surefoot.d.mts declares, go on where they were after an edit, and a bad one changes nothing', () => {
  surefoot.openDefault();
  assert.throws(() => surefoot.graphLive(), /no graph yet/);
  const facts = surefoot.graphRead(graphText);
  surefoot.advance(90);
  const live = surefoot.graphLive();
  const [machine] = facts.machines;
  const names = {
    GraphFacts: facts, GraphLive: live, GraphParameter: facts.parameters[0], GraphNode: facts.nodes[0], GraphMachine: machine,
    GraphTransition: machine.transitions[0],
  };
  for (const [name, value] of Object.entries(names)) assert.deepEqual(Object.keys(value).sort(), keys(name), name);
  const state = () => machine.states[surefoot.graphLive().machines[0].state].name;
  assert.equal(state(), 'moving');
  assert.ok(Math.abs(live.weights.at(-1) - 1) < 1e-6, 'the root has all the weight');
  // A longer transition: the file differs in its number alone, and the character goes on.
  const { pointer } = machine.transitions.find((each) => each.name === 'pump_up');
  const edited = surefoot.jsonEdit(graphText, pointer + '/seconds', '2');
  assert.equal(edited, graphText.replace('"seconds": 0.6', '"seconds": 2'));
  const before = surefoot.array('frame').slice(0, 4);
  surefoot.graphRead(edited);
  assert.deepEqual(surefoot.array('frame').slice(0, 4), before);
  surefoot.graphSet(3, 1);
  surefoot.advance(60);
  const half = surefoot.graphLive();
  assert.equal(machine.transitions[half.machines[0].transition].name, 'pump_up');
  assert.ok(Math.abs(half.weights[machine.states[2].node] - 0.5) < 0.05, `${half.weights}`);
  // Errors name the place.
  assert.throws(() => surefoot.graphRead(graphText.replace('"to": "moving"', '"to": "flying"')), /set_off[^]*flying/);
  assert.throws(() => surefoot.graphRead('{'), /no JSON/);
  assert.throws(() => surefoot.jsonEdit(graphText, '/nowhere/x', '1'), /nothing of that name/);
  surefoot.advance(60);
  assert.equal(state(), 'pumping');
  // Another shape begins anew, and who stops goes by its own clips.
  surefoot.graphRead(graphText.replace('"initial": "standing"', '"initial": "pumping"').replace('"kind": "inertialize",', ''));
  surefoot.gaitStop();
  surefoot.setCourse('flat', 15);
  surefoot.graphSet(0, 1);
  surefoot.advance(10);
  surefoot.gaitRead(surefoot.gaitSource('bhatti2017'));
  surefoot.graphRead(graphText);
  surefoot.advance(10);
  surefoot.openDefault();
  surefoot.advance(10);
});

await test('a crowd has the same bits as natively, frame by frame, also where poses last', () => {
  const native = execFileSync(twinFile, ['crowd'], { maxBuffer: 1 << 28 });
  surefoot.openDefault();
  let at = 0;
  for (let all = 0; all < 180; ++all) {
    const f = all % 90;
    if (f === 0) surefoot.crowd(203, all === 0 ? 'flat' : 'hills');
    const posed = surefoot.crowdAdvance(1 / 60, 20, 5, f >= 30);
    assert.ok(f >= 30 ? posed < 203 && posed > 20 : posed === 203, `${posed} posed`);
    for (const name of ['crowdRoots', 'crowdMatrices']) {
      const array = surefoot.array(name);
      const bytes = Buffer.from(array.buffer, array.byteOffset, array.byteLength);
      assert.ok(bytes.equals(native.subarray(at, at + bytes.length)), `${name} of frame ${f}`);
      at += bytes.length;
    }
  }
  assert.equal(at, native.length);
});

await test('crowds go on uneven ground with their feet on it, and without feet their roots alone follow it', () => {
  surefoot.openDefault();
  const { joints } = surefoot.crowd(60, 'hills');
  const heightAt = (() => {
    // From the mesh that is shown: quads of 4 m, the rows after one another.
    const corners = surefoot.array('crowdTerrain').slice();
    return (x, z) => {
      let best = Infinity, height = 0;
      for (let i = 0; i < corners.length; i += 3) {
        const off = (corners[i] - x) ** 2 + (corners[i + 2] - z) ** 2;
        if (off < best) [best, height] = [off, corners[i + 1]];
      }
      return height;
    };
  })();
  const play = (frames, feet) => {
    for (let f = 0; f < frames; ++f) surefoot.crowdAdvance(1 / 60, 0, 0, false, feet);
    return { roots: surefoot.array('crowdRoots').slice(), matrices: surefoot.array('crowdMatrices').slice() };
  };
  const laid = play(120, true);
  // Near a corner of the ground a root is near that corner's height.
  for (let c = 0; c < 60; ++c) {
    const [x, y, z] = laid.roots.subarray(4 * c, 4 * c + 3);
    if (Math.hypot(x - 4 * Math.round(x / 4), z - 4 * Math.round(z / 4)) < 0.3) assert.ok(Math.abs(y - heightAt(x, z)) < 0.35, `${y} at ${x}, ${z}`);
  }
  assert.ok(Math.max(...laid.roots.filter((_, i) => i % 4 === 1)) > 0.15);
  // Gone the same way without feet: only the legs are others.
  surefoot.crowd(60, 'hills');
  const without = play(120, false);
  let apart = 0;
  for (let i = 0; i < 12 * joints * 60; ++i) apart = Math.max(apart, Math.abs(without.matrices[i] - laid.matrices[i]));
  assert.ok(apart > 0.1, `${apart}`);
  assert.deepEqual(without.roots.filter((_, i) => i % 4 !== 1), laid.roots.filter((_, i) => i % 4 !== 1));
  assert.throws(() => surefoot.crowd(5, 'lava'), /no such ground/);
  assert.equal(surefoot.crowdAdvance(1 / 60, 0, 0, false), 60, 'it is as it was');
  surefoot.crowd(5, 'kerbs');
  assert.equal(Math.max(...surefoot.array('crowdTerrain').filter((_, i) => i % 3 === 1)), Math.fround(0.12));
});

await test('crowds of one to ten thousand go round without meeting, in meshes of falling cost', () => {
  assert.ok(surefoot.crowdAdvance(1 / 60, 0, 0, false) > 0);
  surefoot.openDefault();
  assert.equal(surefoot.crowdAdvance(1 / 60, 0, 0, false), 0, 'another character has no crowd yet');
  assert.equal(surefoot.crowd(0).count, 1);
  assert.equal(surefoot.crowd(1e6).count, 10000);
  const facts = surefoot.crowd(300);
  assert.deepEqual(Object.keys(facts).sort(), keys('CrowdFacts'));
  const before = surefoot.array('crowdRoots').slice();
  for (let f = 0; f < 600; ++f) surefoot.crowdAdvance(1 / 60, 0, 0, true);
  const roots = surefoot.array('crowdRoots');
  let closest = Infinity;
  for (let a = 0; a < 300; ++a) {
    const radius = (from) => Math.hypot(from[4 * a], from[4 * a + 2]);
    assert.ok(Math.abs(radius(roots) - radius(before)) < 0.4, `${a} strayed from ${radius(before)} to ${radius(roots)} m`);
    assert.ok(Math.hypot(roots[4 * a] - before[4 * a], roots[4 * a + 2] - before[4 * a + 2]) > 0.01, `${a} stands`);
    for (let b = 0; b < a; ++b)
      closest = Math.min(closest, Math.hypot(roots[4 * a] - roots[4 * b], roots[4 * a + 2] - roots[4 * b + 2]));
  }
  assert.ok(closest > 0.8, `${closest} m from each other`);
  const vertices = surefoot.array('crowdPositions').length / 3, triangles = surefoot.array('crowdTriangles');
  assert.equal(surefoot.array('crowdMatrices').length, 12 * facts.joints * facts.count);
  assert.ok(surefoot.array('crowdNormals').length === 3 * vertices && surefoot.array('crowdWeights').length === 4 * vertices);
  assert.ok(triangles.every((corner) => corner < vertices));
  assert.ok(surefoot.array('crowdJoints').every((joint) => joint < facts.joints));
  const costs = facts.levels.map((level) => level.count / 3);
  assert.equal(facts.levels.at(-1).first + facts.levels.at(-1).count, triangles.length);
  assert.ok(costs.at(-1) <= 320 && costs.every((cost, i) => i === 0 || cost < costs[i - 1] / 1.9), `${costs}`);
});

await test('figures come after two seconds, and errors leave the stage as it was', () => {
  const facts = surefoot.openDefault();
  assert.equal(surefoot.metrics(), null);
  surefoot.advance(150);
  assert.equal(surefoot.metrics().length, facts.figures.length);
  assert.throws(() => surefoot.setCourse('moon', 15), /there is no course 'moon'/);
  surefoot.advance(1);
  assert.equal(surefoot.metrics().length, facts.figures.length);
});

console.log(`${passed} tests passed`);
