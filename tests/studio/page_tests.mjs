// The page itself, and the Terrain workspace.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { untilItMoves } from './browser.mjs';
import { appFolder, comeToRest, openPage, site, state, test, twin, untilState } from './harness.mjs';

const k_most_bundle_bytes = 1.5e6;
const k_most_start_ms = 12000; // 3 s on a machine of its own; CI shares two cores and draws in software

await test('the whole bundle is small enough to send', async () => {
  let bytes = 0;
  for (const name of readdirSync(appFolder, { recursive: true })) {
    const file = path.join(appFolder, name);
    let content;
    try {
      content = readFileSync(file);
    } catch {
      continue; // a folder
    }
    const size = gzipSync(content, { level: 9 }).length;
    console.log(`    ${String(name).padEnd(34)} ${content.length} bytes, ${size} compressed`);
    bytes += size;
  }
  console.log(`    together ${(bytes / 1e6).toFixed(2)} MB compressed`);
  assert.ok(bytes > 100000 && bytes <= k_most_bundle_bytes, `${bytes} bytes`);
});

await test('the page loads without complaint, asks nobody else, and the character moves before any click', async () => {
  const begun = performance.now();
  const { page, complaints } = await openPage(site.url);
  const took = performance.now() - begun;
  console.log(`    first frames after ${Math.round(took)} ms`);
  const before = await state(page);
  await untilState(page, 'time', '>', before.time + 1);
  const after = await state(page);
  assert.ok(Math.hypot(after.root[0] - before.root[0], after.root[2] - before.root[2]) > 0.5);
  assert.equal(after.steered, false);
  // The picture shows it: the middle of the canvas is not of one colour.
  const colors = await page.evaluate(async () => {
    const canvas = document.querySelector('canvas');
    await new Promise(requestAnimationFrame);
    const copy = new OffscreenCanvas(64, 64), context = copy.getContext('2d');
    await new Promise((resolve) => requestAnimationFrame(() => { context.drawImage(canvas, 0, 0, 64, 64); resolve(); }));
    return new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size;
  });
  assert.ok(colors > 20, `${colors} colours`);
  assert.deepEqual(complaints, []);
  assert.ok(took < k_most_start_ms, `${took} ms`);
});

await test('poses have the same bits as natively, frame by frame', async () => {
  const native = execFileSync(twin, ['stage'], { maxBuffer: 1 << 28 });
  const { page } = await openPage(site.url);
  const { hash, bytes } = await page.evaluate(async () => {
    const { session, engine } = globalThis.studio;
    session.playing.value = false;
    while (engine.busy) await new Promise((resolve) => setTimeout(resolve, 5));
    const frames = [];
    const play = async (count, parts, steering) => {
      for (let f = 0; f < count; ++f) frames.push((await engine.advance(1, parts, steering)).slice());
    };
    // As tests/wasm/twin.cpp plays it.
    await engine.call('openDefault');
    await engine.call('setCourse', 'stairs_up', 15);
    await play(300, 1, { patrol: 1.2 });
    await play(120, 1, { speed: 1.4, lateral: 0, turn: 30 });
    await engine.call('setMode', 'colvin2013');
    await play(60, 2, { speed: 0.5, lateral: 0.25, turn: -20 });
    await engine.call('setMode', 'none');
    await play(60, 1, { speed: 0.5, lateral: 0.25, turn: -20 });
    const all = await new Blob(frames).arrayBuffer();
    let text = '';
    // crypto.subtle needs a secure context, which 127.0.0.1 is.
    for (const byte of new Uint8Array(await crypto.subtle.digest('SHA-256', all))) text += byte.toString(16).padStart(2, '0');
    return { hash: text, bytes: all.byteLength };
  });
  assert.equal(bytes, native.length);
  assert.equal(hash, createHash('sha256').update(native).digest('hex'));
});

await test('on stairs feet stand on the treads, and without foot placement they do not', async () => {
  const { page, complaints } = await openPage(site.url);
  const walked = await page.evaluate(async () => {
    const { session, engine } = globalThis.studio;
    session.playing.value = false;
    while (engine.busy) await new Promise((resolve) => setTimeout(resolve, 5));
    const at = session.facts.value.layout;
    const result = {};
    for (const mode of ['surefoot', 'none']) {
      await engine.call('setMode', mode);
      await engine.call('setCourse', 'stairs_up', 15);
      const heights = [];
      for (let f = 0; f < 900; ++f) {
        const frame = await engine.advance(1, 1, { patrol: 1 });
        for (const side of [0, 1]) {
          const foot = at.feet + side * at.footFloats, sole = foot + at.foot.sole;
          if (frame[foot + at.foot.contact] !== 3) continue;
          for (const point of [0, 6]) heights.push([frame[sole + point + 2], frame[sole + point + 1]]); // heel, ball
        }
      }
      result[mode] = heights;
    }
    return result;
  });
  const k_riser = 0.17, k_tread = 0.28, k_first = 3;
  const ground = (z) => Math.min(Math.max(Math.floor((z - k_first) / k_tread) + 1, 0), 20) * k_riser;
  const sunk = (feet) => Math.max(...feet.map(([z, height]) => ground(z) - height));
  // A ball may stand out over the edge of its tread: it is on one all the same.
  const off = (feet) => Math.max(...feet.map(([, height]) => Math.abs(height - Math.round(height / k_riser) * k_riser)));
  const treads = new Set(walked.surefoot.map(([, height]) => Math.round(height / k_riser)));
  const cm = (metres) => `${(100 * metres).toFixed(1)} cm`;
  console.log(`    ${treads.size} treads; flat soles off theirs by at most ${cm(off(walked.surefoot))}, sunk at most ` +
    `${cm(sunk(walked.surefoot))}; without placement sunk ${cm(sunk(walked.none))}`);
  assert.ok(treads.size > 8);
  assert.ok(off(walked.surefoot) < 0.03 && sunk(walked.surefoot) < 0.03);
  assert.ok(sunk(walked.none) > 0.1);
  assert.deepEqual(complaints, []);
});

await test('it is steered by keys: ahead, to the left, and it stands where nobody asks', async () => {
  const { page } = await openPage(site.url, { settings: { course: 'flat' } });
  await page.keyboard.down('w');
  await untilState(page, 'speed', '>', 1.2);
  assert.equal((await state(page)).steered, true);
  const { root } = await state(page);
  await page.keyboard.down('a');
  await untilState(page, 'yaw', '>', root[3] + 0.5);
  await page.keyboard.up('a');
  await page.keyboard.up('w');
  await untilState(page, 'speed', '<', 0.05);
  await page.keyboard.press('p');
  await untilState(page, 'speed', '>', 1);
  assert.equal((await state(page)).steered, false);
});

await test('it is steered by the stick on the screen of a phone', async () => {
  const { page, complaints } = await openPage(site.url, {
    settings: { course: 'flat' },
    context: { viewport: { width: 844, height: 390 }, hasTouch: true, isMobile: true },
  });
  const stick = await page.locator('.stick').boundingBox();
  assert.ok(stick.y + stick.height <= 390 - 40 && stick.x >= 0, 'the stick is in sight');
  const x = stick.x + stick.width / 2, y = stick.y + stick.height / 2;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 30, y - 30, { steps: 3 });
  const { root } = await state(page);
  await untilState(page, 'yaw', '>', root[3] + 0.5);
  await page.mouse.up();
  await untilState(page, 'speed', '<', 0.05);
  const overflow = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
  assert.deepEqual(overflow, [844, 390], 'nothing hangs over');
  assert.deepEqual(complaints, []);
});

await test('everything is reached by keyboard alone: course, placement, pause, one step, slow motion', async () => {
  const { page, complaints } = await openPage(site.url);
  const tabTo = async (selector) => {
    for (let i = 0; i < 60; ++i) {
      if (await page.evaluate((wanted) => document.activeElement.matches(wanted), selector)) return;
      await page.keyboard.press('Tab');
    }
    assert.fail(`Tab does not lead to ${selector}`);
  };
  await tabTo('.panel select');
  await page.keyboard.press('ArrowDown');
  await page.waitForFunction(() => globalThis.studio.session.terrain.value && document.querySelector('select').value === 'slope_up');
  await tabTo('.panel input[type=radio]');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.evaluate(() => localStorage.getItem('surefoot.studio.mode')), '"colvin2013"');
  await tabTo('.transport .play');
  await page.keyboard.press('Enter');
  assert.equal((await state(page)).playing, false);
  await comeToRest(page);
  const { time } = await state(page);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  await untilState(page, 'time', '>', time);
  assert.ok(Math.abs((await state(page)).time - time - 1 / 60) < 1e-4, 'one step is one frame');
  await page.keyboard.press('Tab');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('ArrowRight');
  const slow = (await state(page)).time;
  await page.keyboard.press('.');
  await untilState(page, 'time', '>', slow);
  assert.ok(Math.abs((await state(page)).time - slow - 1 / 600) < 1e-4, 'a tenth of a frame');
  assert.deepEqual(complaints, []);
});

await test('choices survive a reload, light and dark are kept', async () => {
  const { page } = await openPage(site.url, { context: { colorScheme: 'dark' } });
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await page.getByLabel('Walk over').selectOption('rubble');
  await page.getByLabel('Ankle axes').check();
  await page.getByRole('button', { name: 'Colours' }).click();
  await page.reload();
  await untilItMoves(page);
  assert.equal(await page.getByLabel('Walk over').inputValue(), 'rubble');
  assert.equal(await page.getByLabel('Ankle axes').isChecked(), true);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'light');
});

await test('live figures: foot placement meets marks on stairs that walking without it misses', async () => {
  const { page } = await openPage(site.url, { settings: { course: 'stairs_up' } });
  const missed = async () => {
    await page.waitForFunction(() => globalThis.studio.session.figures.value !== null);
    return page.locator('.figures tr.missed').count();
  };
  await untilState(page, 'time', '>', 5);
  const ours = await missed();
  await page.keyboard.press('1');
  await page.waitForFunction(() => globalThis.studio.session.figures.value === null);
  const { time } = await state(page);
  await untilState(page, 'time', '>', time + 4);
  const without = await missed();
  console.log(`    marks missed: surefoot ${ours}, none ${without}`);
  assert.ok(without > ours && without >= 2);
});
