// The Blend space workspace, and projects: opened, mended, saved, kept.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { untilItMoves } from './browser.mjs';
import {
  bench, comeToRest, dragIn, filesIn, filesOf, idle, lackingProject, mendAll, nativeLint, openPage, program, realClips, scratch, site, startStudio, state, test, told, untilDrawn, untilKept, untilOpen, untilState,
} from './harness.mjs';

await test('blend space: the character goes as the puck says, and the weights are those of the place', async () => {
  const { page, complaints } = await openPage(site.url);
  await page.getByRole('tab', { name: 'Blend space' }).click();
  await page.locator('.map .samples text').first().waitFor();
  const box = await page.locator('.map svg').boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.4 * box.height, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelectorAll('.weights li').length > 1);
  const slider = page.getByRole('slider', { name: /Puck/ });
  await slider.focus();
  assert.ok(await page.evaluate(() => document.activeElement.closest('.map')), 'the puck takes the keyboard');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowUp');
  const words = await slider.getAttribute('aria-valuetext');
  const [, speed, turn] = words.match(/^speed (-?[\d.]+) m\/s, turn (-?[\d.]+) deg\/s$/).map(Number);
  assert.ok(speed > 1 && turn > 0, words);
  const { time } = await state(page);
  await untilState(page, 'time', '>', time + 3);
  const now = await page.evaluate(() => {
    const { session } = globalThis.studio, at = session.facts.value.layout;
    return { speed: session.frame[at.speed], turn: session.frame[at.turn] };
  });
  assert.ok(Math.abs(now.speed - speed) < 0.1 && Math.abs(now.turn - turn) < 2, JSON.stringify({ now, words }));
  const shares = await page.locator('.weights output').allTextContents();
  assert.ok(Math.abs(shares.map((each) => parseFloat(each)).reduce((sum, each) => sum + each, 0) - 100) <= 2, `${shares}`);
  await page.getByRole('tab', { name: 'Terrain' }).click();
  await page.getByLabel('Walk over').waitFor();
  const { root } = await state(page);
  await untilState(page, 'speed', '>', 1);
  assert.equal((await state(page)).steered, false, 'it patrols again');
  assert.ok(root);
  assert.deepEqual(complaints, []);
});

await test('blend space: findings are those of surefoot lint, and move with their thresholds', async () => {
  const project = path.join(scratch, 'linted');
  execFileSync(program, ['author', '--synthetic', '-o', project], { stdio: 'ignore' });
  let text;
  try {
    text = execFileSync(program, ['lint', project, '--json'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
  } catch (error) {
    text = error.stdout; // exit code 1: there are findings
  }
  const native = JSON.parse(text).findings.map(({ rule, message, clips }) => ({ rule, message, clips }));
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'space' } });
  await page.locator('input.folder').setInputFiles(project);
  await untilOpen(page, 'linted');
  const found = async () =>
    page.evaluate(async () => (await globalThis.studio.bench.ask('bench')).findings.map(({ rule, message, clips }) => ({ rule, message, clips })));
  assert.deepEqual(await found(), native);
  const shown = () => page.locator('.findings li').count();
  await page.waitForFunction(() => document.querySelector('.map .samples text'));
  const before = await shown();
  await page.getByLabel('Too close', { exact: true }).fill('40');
  await page.waitForFunction((count) => document.querySelectorAll('.findings li').length > count, before);
  await page.locator('.findings button').first().click();
  assert.ok((await page.locator('.findings p').first().textContent()).length > 40, 'it is explained');
  await page.getByRole('button', { name: 'Reset' }).click();
  await page.waitForFunction((count) => document.querySelectorAll('.findings li').length === count, before);
  console.log(`    ${native.length} findings, ${before} of this space`);
  assert.deepEqual(complaints, []);
});

await test('a folder of .bvh and .glb that is dragged in gives the very files that surefoot author writes, and the page stays alive', async () => {
  const folder = realClips();
  if (!folder) {
    console.log('    skipped: no real motion at ../shared/motion (SUREFOOT_MOTION names its folder)');
    return;
  }
  writeFileSync(path.join(folder, 'bad.bvh'), 'HIERARCHY nonsense');
  const native = path.join(scratch, 'mixed_native');
  execFileSync(program, ['author', 'mixed', '-o', native, '--name', 'mixed'], { cwd: scratch, stdio: 'ignore' });
  const { page, complaints } = await openPage(site.url);
  // While it is measured the character goes on, and how far it is can be seen.
  await page.evaluate(() => {
    const seen = (globalThis.seen = { frames: new Set(), words: new Set() });
    setInterval(() => {
      const card = document.querySelector('.work');
      if (!card) return;
      seen.frames.add(globalThis.studio.session.frameCount.value);
      seen.words.add(card.textContent);
    }, 15);
  });
  const begun = performance.now();
  await dragIn(page, [folder]);
  await untilOpen(page, 'mixed');
  const seen = await page.evaluate(() => ({ frames: globalThis.seen.frames.size, words: [...globalThis.seen.words] }));
  console.log(`    53 clips in three files, analysed in ${((performance.now() - begun) / 1000).toFixed(1)} s; ${seen.frames} frames meanwhile`);
  assert.ok(seen.frames > 4, 'the character goes on meanwhile');
  assert.ok(seen.words.filter((each) => /Measuring clips \d+ of \d+/.test(each)).length > 2, `${seen.words}`);
  await page.getByRole('tab', { name: 'Blend space', selected: true }).waitFor();
  assert.deepEqual(await filesOf(page), filesIn(native));
  assert.match((await bench(page, 'failed')).join(), /bad\.bvh/);
  await page.locator('.unread').getByText(/bad\.bvh/).waitFor();
  const names = (await bench(page, 'spaces'))[0].samples.map(({ clip }) => clip);
  assert.ok(names.includes('Walk_Loop') && names.some((each) => /^walk_1/.test(each)), `${names}`);
  assert.ok(await page.locator('.map .samples text').count() > 4, 'names that have room are in the map');
  const before = await state(page);
  await untilState(page, 'time', '>', before.time + 0.5);
  assert.deepEqual(complaints, []);
});

await test('one .bvh that is chosen becomes a blend space; stopping, bad files and FBX leave what was there', async () => {
  const folder = realClips();
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'space' } });
  await page.locator('.map .samples text').first().waitFor();
  const clips = (await bench(page, 'spaces')).length;
  const bad = (name, text) => ({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(text) });
  const alert = page.getByRole('alert');
  for (const [file, words] of [
    [bad('noise.bvh', 'HIERARCHY nonsense'), /noise\.bvh/],
    [bad('empty.glb', ''), /empty\.glb/],
    [bad('scene.fbx', 'Kaydara FBX'), /not read in a browser/],
    [bad('story.txt', 'once upon a time'), /neither a project\.json nor a clip/],
    [bad('work.zip', 'PK nonsense'), /zip/],
  ]) {
    await page.locator('input.files').setInputFiles([file]);
    await alert.getByText(words).waitFor();
    await page.getByRole('button', { name: 'Dismiss' }).click();
  }
  assert.equal((await bench(page, 'spaces')).length, clips);
  if (folder) {
    await page.locator('input.files').setInputFiles([path.join(folder, 'UAL1_50clips_mannequin.glb')]);
    await page.waitForFunction(() => {
      const stop = document.querySelector('.work button');
      stop?.click();
      return stop !== null;
    });
    await idle(page);
    assert.equal(await bench(page, 'name'), 'Default character');
    await page.locator('input.files').setInputFiles([path.join(folder, 'Walk1.bvh')]);
    await untilOpen(page, 'Walk1');
    const facts = await bench(page, 'spaces');
    assert.ok(facts[0].samples.length > 1, 'a take has several cycles');
  }
  const { time } = await state(page);
  await untilState(page, 'time', '>', time + 0.3);
  assert.deepEqual(complaints, []);
});

await test('a finding is mended at a click as surefoot fix does it; undo, redo and taking back; saved into the served folder', async () => {
  const project = lackingProject('lacking'), twinProject = lackingProject('lacking_twin');
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address, { settings: { workspace: 'space' } });
    await untilOpen(page, 'lacking');
    const findings = async () => told(await bench(page, 'findings'));
    const before = await findings();
    assert.deepEqual(before, told(nativeLint(project).findings));
    await page.getByLabel('Sideways').check();
    const lacking = page.locator('.findings button', { hasText: 'Missing axis end' });
    await lacking.click();
    const walked = await state(page);
    await page.getByRole('button', { name: 'Mend it' }).click();
    await page.locator('.rows').getByText('made by mirroring "strafe_right"').waitFor();
    await idle(page);
    assert.equal(await lacking.count(), 0, 'the finding is gone');
    assert.ok((await state(page)).time >= walked.time, 'it goes on from where it was');
    await page.locator('.map .samples text', { hasText: 'strafe left' }).waitFor();
    const mended = await findings();
    // What no clip at hand can give stays, with the reason.
    await page.getByLabel('Speed and turn').check();
    await page.locator('.findings button', { hasText: 'Missing axis end' }).click();
    await page.getByRole('button', { name: 'Mend all' }).click();
    await page.locator('.findings .failed').getByText(/Not mended/).waitFor();
    await idle(page);
    assert.deepEqual(await findings(), mended);
    // The character goes sideways in the clip that was made.
    await page.getByLabel('Sideways').check();
    const { time } = await state(page);
    await untilState(page, 'time', '>', time + 0.3);
    const step = async (name, wanted) => {
      await page.getByRole('button', { name, exact: true }).click();
      await idle(page);
      assert.deepEqual(await findings(), wanted, name);
    };
    await step('Undo', before);
    await step('Redo', mended);
    await step('Take back', before);
    await step('Undo', mended);
    // Saved: the same project as surefoot fix writes, and as surefoot lint sees it.
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    await page.getByText('Saved in the folder').waitFor();
    assert.equal(await bench(page, 'unsaved'), false);
    try {
      execFileSync(program, ['fix', twinProject, '--no-mannequin'], { stdio: 'ignore' });
    } catch {
      // exit code 1: errors are left
    }
    const parsed = (folder) => JSON.parse(readFileSync(path.join(folder, 'project.json'), 'utf8').replaceAll('lacking_twin', 'lacking'));
    assert.deepEqual(parsed(project), parsed(twinProject));
    assert.deepEqual(told(nativeLint(project).findings), mended);
    assert.match(execFileSync(program, ['fix', project, '--list'], { encoding: 'utf8' }), /made by mirroring/);
    // Without the repair its clip goes from the folder, too.
    const made = path.join(project, 'clips/strafe_left.glb');
    assert.ok(existsSync(made));
    await page.keyboard.press('Control+z');
    await idle(page);
    await page.waitForFunction(() => globalThis.studio.bench.project.value.repairs.length === 0);
    await page.keyboard.press('Control+s');
    await page.waitForFunction(() => !globalThis.studio.bench.project.value.unsaved);
    assert.ok(!existsSync(made));
    // Somebody else writes the project meanwhile: nothing is lost without a question.
    writeFileSync(path.join(project, 'project.json'), `${readFileSync(path.join(project, 'project.json'), 'utf8')}\n`);
    const file = readFileSync(path.join(project, 'project.json'), 'utf8');
    await page.getByLabel('Too close', { exact: true }).fill('12');
    await page.waitForFunction(() => globalThis.studio.bench.project.value.unsaved);
    // By key: whoever looks at the folder may have asked already, and that card be over the button.
    await page.getByRole('button', { name: 'Save', exact: true }).press('Enter');
    await page.getByRole('alert').getByText('has changed on disk').waitFor();
    assert.equal(readFileSync(path.join(project, 'project.json'), 'utf8'), file);
    await page.getByRole('button', { name: 'Save all the same' }).click();
    await page.waitForFunction(() => !globalThis.studio.bench.project.value.unsaved);
    assert.equal(JSON.parse(readFileSync(path.join(project, 'project.json'), 'utf8')).lint['too-close'].thresholds.distance, 12);
    assert.deepEqual(complaints, []);
  } finally {
    studio.stop();
  }
});

await test('without a server a mended project is downloaded, and opens again as it was', async () => {
  const project = lackingProject('apart');
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'space' } });
  await page.locator('input.folder').setInputFiles(project);
  await untilOpen(page, 'apart');
  await mendAll(page);
  const mended = told(await bench(page, 'findings'));
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Download', exact: true }).click();
  const zip = { name: 'apart.zip', mimeType: 'application/zip', buffer: readFileSync(await (await download).path()) };
  assert.equal((await download).suggestedFilename(), 'apart.zip');
  await page.waitForFunction(() => !globalThis.studio.bench.project.value.unsaved);
  await untilKept(page);
  await page.reload();
  await untilItMoves(page);
  await page.locator('input.files').setInputFiles([zip]);
  await untilOpen(page, 'apart');
  assert.deepEqual(told(await bench(page, 'findings')), mended);
  assert.equal((await bench(page, 'repairs')).length, 1);
  assert.deepEqual(complaints, []);
});

await test('unsaved work survives a reload, until it is dropped', async () => {
  const project = lackingProject('kept');
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'space' } });
  await page.locator('input.folder').setInputFiles(project);
  await untilOpen(page, 'kept');
  const before = told(await bench(page, 'findings'));
  await mendAll(page);
  const mended = told(await bench(page, 'findings'));
  await untilKept(page);
  await page.reload();
  await untilOpen(page, 'kept');
  await page.getByRole('button', { name: 'Go on with it' }).click();
  assert.deepEqual(told(await bench(page, 'findings')), mended);
  assert.notDeepEqual(mended, before);
  assert.equal(await bench(page, 'unsaved'), true);
  await page.reload();
  await page.getByRole('button', { name: 'Drop the changes' }).click();
  await untilOpen(page, 'Default character');
  await page.reload();
  await untilOpen(page, 'Default character');
  assert.equal(await page.getByRole('alert').count(), 0);
  assert.deepEqual(complaints, []);
});

await test('of two projects that are asked for at once the later one is opened, though it is there first', async () => {
  const project = lackingProject('later');
  const files = readdirSync(path.join(project, 'clips')).map((clip) => `clips/${clip}`).concat('project.json')
    .map((file) => [file, readFileSync(path.join(project, file)).toString('base64')]);
  const { page, complaints } = await openPage(site.url);
  const opened = await page.evaluate((files) => {
    const { bench } = globalThis.studio;
    const bytes = (text) => Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
    const slow = bench.open('The default', (client) => client.call('benchDefault').then(() => client.call('benchProbe')));
    const quick = bench.openFiles(files.map(([file, text]) => [file, bytes(text)]));
    return Promise.all([slow, quick]);
  }, files);
  assert.deepEqual(opened, [false, true]);
  assert.equal(await bench(page, 'name'), 'later');
  assert.equal(await page.evaluate(() => globalThis.studio.bench.busy.value), false);
  assert.deepEqual(complaints, []);
});

await test('the map is coloured by what surefoot lint --probe measures, and ghosts are the clips that play', async () => {
  const project = lackingProject('probed');
  const native = nativeLint(project, '--probe').probe.spaces.find((each) => each.name === 'facing');
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'space' } });
  await page.locator('input.folder').setInputFiles(project);
  await untilOpen(page, 'probed');
  await page.getByLabel('Colour by').selectOption('Foot skate');
  await page.locator('.map .heat rect').first().waitFor();
  assert.equal(await page.locator('.map .heat rect').count(), native.cells.length);
  const map = await page.evaluate(() => globalThis.studio.bench.heat.value.find((each) => each.title === 'Foot skate' && each.space === 'facing'));
  assert.deepEqual(map.cells.map(({ value }) => value && Number(value.toFixed(4))), native.cells.map((cell) => cell.blend.skate_cm_s ?? null));
  assert.match(await page.locator('.map .heat title').first().textContent(), /cm\/s/);
  const fills = new Set(await page.locator('.map .heat rect').evaluateAll((all) => all.map((each) => each.getAttribute('fill'))));
  assert.equal(fills.size, new Set(native.cells.map((cell) => Math.floor((10 * cell.blend.skate_cm_s) / map.full))).size);
  assert.ok(fills.size > 1);
  // Two clips half and half are two ghosts, each with its own weight; one clip alone is none.
  const ghosts = () => page.evaluate(() => {
    const { session } = globalThis.studio, { layout, clipNames } = session.facts.value;
    return Array.from({ length: layout.mostGhosts }, (_, g) => layout.ghosts + g * layout.ghostFloats)
      .map((at) => ({ clip: clipNames[session.frame[at + layout.ghost.clip]], weight: session.frame[at + layout.ghost.weight] }))
      .filter(({ weight }) => weight > 0);
  });
  const weights = await page.locator('.weights li').count();
  const { time } = await state(page);
  await untilState(page, 'time', '>', time + 3);
  const shown = await ghosts();
  assert.ok(shown.length > 1 && Math.abs(shown.length - weights) <= 1, JSON.stringify(shown));
  assert.ok(await page.locator('.weights .swatch').count() > 0);
  await comeToRest(page);
  const pictured = async () => {
    await untilDrawn(page);
    const png = (await page.locator('.viewport canvas').screenshot()).toString('base64');
    return page.evaluate(async (png) => {
      const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (each) => each.charCodeAt(0))]));
      const context = new OffscreenCanvas(160, 160).getContext('2d');
      context.drawImage(image, 0, 0, 160, 160);
      return [...context.getImageData(0, 0, 160, 160).data];
    }, png);
  };
  const withGhosts = await pictured();
  await page.getByLabel('Ghosts of these clips').uncheck();
  const without = await pictured();
  const changed = withGhosts.filter((value, i) => Math.abs(value - without[i]) > 24).length;
  console.log(`    ${shown.map(({ clip, weight }) => `${clip} ${weight.toFixed(2)}`).join(', ')}; ${changed} values of the picture differ`);
  assert.ok(changed > 60, 'they are in the picture');
  assert.deepEqual(complaints, []);
});
