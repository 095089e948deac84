// The Graph workspace.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { untilItMoves } from './browser.mjs';
import { openPage, program, scratch, site, startStudio, state, test, twin, untilState } from './harness.mjs';

const graphFile = fileURLToPath(new URL('../../apps/studio/src/graphs/stroll.json', import.meta.url));

await test('graph: the same bits as natively, frame by frame', async () => {
  const native = execFileSync(twin, ['graph', graphFile], { maxBuffer: 1 << 28 });
  const { page, complaints } = await openPage(site.url, { context: { viewport: { width: 400, height: 300 } } });
  const { hash, bytes } = await page.evaluate(async (text) => {
    const { session, engine } = globalThis.studio;
    session.playing.value = false;
    while (engine.busy) await new Promise((resolve) => setTimeout(resolve, 5));
    await engine.call('graphRead', text);
    const frames = [];
    const play = async (count) => {
      for (let f = 0; f < count; ++f) frames.push((await engine.advance(1, 1, { patrol: 1 })).slice());
    };
    // As tests/wasm/twin.cpp plays it.
    await play(100);
    await engine.call('graphSet', 3, 1);
    await play(100);
    await engine.call('graphSet', 0, 0);
    await play(60);
    const all = await new Blob(frames).arrayBuffer();
    const hash = [...new Uint8Array(await crypto.subtle.digest('SHA-256', all))].map((byte) => byte.toString(16).padStart(2, '0')).join('');
    return { hash, bytes: all.byteLength };
  }, readFileSync(graphFile, 'utf8'));
  assert.equal(hash, createHash('sha256').update(native.subarray(0, bytes)).digest('hex'));
  assert.deepEqual(complaints, []);
});

await test('graph: states, triggers and transitions are seen to run, and every edit changes its value alone', async () => {
  const original = readFileSync(graphFile, 'utf8');
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'graph' } });
  const untilPlays = (state) =>
    page.waitForFunction(
      (state) => {
        const { graph } = globalThis.studio, machine = graph.graph.value?.machines[0];
        return machine && machine.states[graph.live.value?.machines[0].state]?.name === state;
      },
      state,
    );
  const text = () => page.evaluate(() => globalThis.studio.graph.text() ?? '');
  const untilText = (wanted) => page.waitForFunction((wanted) => globalThis.studio.graph.text() === wanted, wanted);
  await untilPlays('moving');
  const map = page.getByRole('group', { name: 'State machine /nodes/hero' });
  assert.equal(await map.locator('.state').count(), 3);
  await page.waitForFunction(() => document.querySelector('.state.on .share')?.textContent === '100 %');
  assert.match(await map.locator('.state.on').textContent(), /moving/);
  await page.waitForFunction(() => globalThis.studio.graph.past.events.some((each) => each.name === 'left_strike'));
  // A transition is chosen by keyboard and made longer; then it is seen to run.
  await untilState(page, 'time', '>', 0.5);
  const arrow = page.getByRole('button', { name: /^Transition pump_up/ });
  await arrow.focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('Takes').press('End');
  await untilText(original.replace('"seconds": 0.6', '"seconds": 3'));
  const before = await state(page);
  assert.ok(before.time > 0.5, 'an edit does not begin anew');
  await page.getByRole('button', { name: 'pump', exact: true }).click();
  await page.getByRole('button', { name: /^Transition pump_up.*running/ }).waitFor();
  await page.locator('.transition.runs circle').waitFor();
  await untilPlays('pumping');
  // Curves, one that is there and one that is not yet; undone and done again.
  await page.getByLabel('Curve').selectOption('linear');
  await untilText(original.replace('"seconds": 0.6', '"seconds": 3').replace('cubic_in_out', 'linear'));
  await page.getByLabel('Shown').selectOption({ label: 'set off' });
  await page.getByLabel('Curve').selectOption('cubic_out');
  const last = original.replace('"seconds": 0.6', '"seconds": 3').replace('"cubic_in_out"', '"linear"')
    .replace('[{"parameter": "speed", ">": 0.15}]', '[{"parameter": "speed", ">": 0.15}], "curve": "cubic_out"');
  await untilText(last);
  const changed = original.split('\n').filter((line, i) => line !== last.split('\n')[i]).length;
  assert.equal(changed, 3, 'three lines for three edits');
  for (let i = 0; i < 3; ++i) await page.getByRole('button', { name: 'Undo' }).click();
  await untilText(original);
  await page.locator('.panel h2').first().click();
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Control+Shift+Z');
  await untilText(last);
  // What cannot be is said and not taken.
  await page.getByText('In the file').first().click();
  const low = page.getByLabel('low', { exact: true }).first();
  await low.fill('9');
  await low.press('Enter');
  await page.locator('#graph-complaint.bad').getByText('/parameters/speed').waitFor();
  assert.equal(await text(), last);
  const initial = page.getByLabel('initial', { exact: true }).first();
  await initial.fill('1.2');
  await initial.press('Enter');
  const final = last.replace('"initial": 1.4', '"initial": 1.2');
  await untilText(final);
  assert.equal(await page.locator('#graph-complaint.bad').count(), 0);
  // Parameters steer it.
  await page.getByRole('slider', { name: 'speed' }).press('Home');
  await untilPlays('standing');
  await page.reload();
  await untilItMoves(page);
  await untilText(final);
  await untilPlays('moving');
  // The saved file is what is here, and the program walks by it.
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save' }).click();
  const saved = readFileSync(await (await download).path(), 'utf8');
  assert.equal(saved, final);
  const project = path.join(scratch, 'graph');
  execFileSync(program, ['author', '--synthetic', '-o', project], { stdio: 'ignore' });
  writeFileSync(path.join(project, 'stroll.json'), saved);
  execFileSync(program, ['walk', path.join(project, 'stroll.json'), '--seconds', '1', '-o', path.join(project, 'walk.glb')], { stdio: 'ignore' });
  // Another file, a broken one, and away.
  const file = page.locator('input[aria-label="Graph file"]');
  await file.setInputFiles({ name: 'broken.json', mimeType: 'application/json', buffer: Buffer.from('{"surefoot_graph": 1,') });
  await page.locator('#graph-complaint.bad').getByText('no JSON').waitFor();
  await file.setInputFiles({ name: 'other.json', mimeType: 'application/json', buffer: Buffer.from(original.replace('"initial": "standing"', '"initial": "pumping"')) });
  await untilText(original.replace('"initial": "standing"', '"initial": "pumping"'));
  await page.getByRole('tab', { name: 'Terrain' }).click();
  await page.waitForFunction(() => globalThis.studio.session.shownCourse() === 'hills');
  await untilState(page, 'speed', '>', 1.2);
  assert.deepEqual(complaints, []);
});

await test('graph: conditions, transitions and states are added and removed, in these lines alone, and undone to the byte', async () => {
  const original = readFileSync(graphFile, 'utf8');
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'graph' }, context: { viewport: { width: 1000, height: 560 } } });
  const text = () => page.evaluate(() => globalThis.studio.graph.text());
  const untilText = (wanted) => page.waitForFunction((wanted) => globalThis.studio.graph.text() === wanted, wanted);
  await page.getByRole('button', { name: /^Transition set_off/ }).press('Enter');
  // A condition's value, its kind, one more, and gone again.
  await page.getByLabel('than').fill('0.5');
  await page.getByLabel('than').press('Enter');
  await untilText(original.replace('">": 0.15', '">": 0.5'));
  await page.getByLabel('Is', { exact: true }).selectOption('>=');
  await untilText(original.replace('">": 0.15', '">=": 0.5'));
  await page.getByRole('button', { name: 'Add a condition' }).click();
  await untilText(original.replace('">": 0.15}]', '">=": 0.5}, {"elapsed_s": 1}]'));
  await page.getByLabel('When', { exact: true }).nth(1).selectOption('trigger');
  await untilText(original.replace('">": 0.15}]', '">=": 0.5}, {"trigger": "pump"}]'));
  await page.getByRole('button', { name: 'Remove this condition' }).first().click();
  await untilText(original.replace('{"parameter": "speed", ">": 0.15}]', '{"trigger": "pump"}]'));
  // A state of a clip, a way into it and out of it; it is seen to be there and to play.
  await page.getByLabel('New state plays').selectOption('clip:run');
  await page.getByRole('button', { name: 'Add state' }).click();
  const map = page.getByRole('group', { name: 'State machine /nodes/hero' });
  await map.locator('.state').nth(3).waitFor();
  await page.getByLabel('From', { exact: true }).selectOption('moving');
  await page.getByLabel('To', { exact: true }).selectOption('run');
  await page.getByRole('button', { name: 'Add transition' }).click();
  await page.getByRole('button', { name: /^Transition moving_to_run/ }).waitFor();
  const grown = await text();
  assert.ok(grown.includes('"pumping": "pumped", "run": {"type": "clip", "clip": "run"}}'), grown);
  assert.ok(grown.includes('"moving_to_run": {"from": "moving", "to": "run", "seconds": 0.3, "when": [{"elapsed_s": 1}]}'));
  const lines = original.split('\n');
  assert.equal(lines.filter((line) => !grown.split('\n').includes(line)).length, 3, 'three lines of the file are others');
  await page.getByRole('button', { name: 'pump', exact: true }).click(); // sets off, from now on
  await page.waitForFunction(() => {
    const { graph } = globalThis.studio, machine = graph.graph.value.machines[0];
    return machine.states[graph.live.value?.machines[0].state]?.name === 'run';
  });
  // The program takes it.
  const project = path.join(scratch, 'grown');
  execFileSync(program, ['author', '--default', '-o', project], { stdio: 'ignore' });
  writeFileSync(path.join(project, 'grown.json'), grown);
  execFileSync(program, ['walk', path.join(project, 'grown.json'), '--seconds', '1', '-o', path.join(project, 'walk.glb')], { stdio: 'ignore' });
  // The state goes with its transition, the one that plays first too; what cannot be is refused in words.
  await page.getByLabel('State', { exact: true }).selectOption('standing');
  await page.getByRole('button', { name: 'Remove state' }).click();
  await map.locator('.state').nth(2).waitFor();
  await page.waitForFunction(() => globalThis.studio.graph.graph.value.machines[0].states.length === 3);
  const shrunk = JSON.parse(await text()).nodes.hero;
  assert.deepEqual([shrunk.initial, Object.keys(shrunk.transitions)], ['moving', ['pump_up', 'calm_down', 'moving_to_run']]);
  for (let steps = 0; steps < 20 && (await page.getByRole('button', { name: 'Undo' }).isEnabled()); ++steps) {
    const before = await text();
    await page.getByRole('button', { name: 'Undo' }).click();
    await page.waitForFunction((before) => globalThis.studio.graph.text() !== before, before);
  }
  assert.equal(await text(), original);
  // One that extends another is shown as it is in the end, and not edited.
  const files = page.locator('input[aria-label="Graph file"]');
  const patch = JSON.stringify({ surefoot_graph: 1, extends: 'stroll.json', name: 'quick', parameters: { speed: { initial: 2.5 } } });
  await files.setInputFiles({ name: 'quick.json', mimeType: 'application/json', buffer: Buffer.from(patch) });
  await page.locator('#graph-complaint.bad').getByText('extends stroll.json: choose both files').waitFor();
  await files.setInputFiles([['quick.json', patch], ['stroll.json', original]].map(([name, each]) => ({ name, mimeType: 'application/json', buffer: Buffer.from(each) })));
  await page.waitForFunction(() => globalThis.studio.graph.graph.value.name === 'quick');
  assert.equal(await page.evaluate(() => globalThis.studio.graph.graph.value.parameters[0].initial), 2.5);
  await page.locator('.panel').getByText('It extends stroll.json').first().waitFor();
  assert.equal(await page.getByRole('button', { name: 'Add state' }).count(), 0);
  assert.deepEqual(complaints, []);
});

await test('graph: saved into the served folder, which asks where the file has changed on disk, and opened from it', async () => {
  const project = path.join(scratch, 'graphs');
  execFileSync(program, ['author', '--default', '-o', project], { stdio: 'ignore' });
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address, { settings: { workspace: 'graph' }, context: { viewport: { width: 1000, height: 560 } } });
    const onDisk = (name) => readFileSync(path.join(project, name), 'utf8');
    const text = () => page.evaluate(() => globalThis.studio.graph.text());
    await page.getByRole('button', { name: 'Save in the folder' }).click();
    await page.getByText('Saved as stroll.json.').waitFor();
    assert.equal(onDisk('stroll.json'), readFileSync(graphFile, 'utf8'));
    await page.getByRole('button', { name: /^Transition pump_up/ }).press('Enter');
    await page.getByLabel('Takes').press('End');
    await page.waitForFunction(() => globalThis.studio.graph.text().includes('"seconds": 3'));
    const ours = await text(), theirs = onDisk('stroll.json').replace('"seconds": 0.6', '"seconds": 0.7');
    writeFileSync(path.join(project, 'stroll.json'), theirs);
    // By key: whoever looks at the folder may have asked already, and that card be over the button.
    await page.getByRole('button', { name: 'Save in the folder' }).press('Enter');
    await page.getByRole('button', { name: 'Neither' }).click();
    assert.equal(onDisk('stroll.json'), theirs);
    await page.getByRole('button', { name: 'Save in the folder' }).press('Enter');
    await page.getByRole('button', { name: 'Save all the same' }).click();
    await page.getByText('Saved as stroll.json.').waitFor();
    assert.equal(onDisk('stroll.json'), ours);
    writeFileSync(path.join(project, 'other.json'), theirs.replace('"stroll"', '"other"'));
    await page.reload();
    await untilItMoves(page);
    await page.getByLabel('In the folder').selectOption('other.json');
    await page.waitForFunction(() => globalThis.studio.graph.graph.value?.name === 'other');
    assert.deepEqual(complaints, []);
  } finally {
    studio.stop();
  }
});
