// The Crowd workspace.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { comeToRest, openPage, site, state, test, twin, untilDrawn, untilState } from './harness.mjs';

await test('crowd: the same bits as natively, and 500 characters cost at most 3 ms of animation a frame', async () => {
  const native = execFileSync(twin, ['crowd'], { maxBuffer: 1 << 28 });
  const { page, complaints } = await openPage(site.url, { context: { viewport: { width: 400, height: 300 } } });
  const { hash, milliseconds } = await page.evaluate(async () => {
    const { session, engine } = globalThis.studio;
    session.playing.value = false;
    while (engine.busy) await new Promise((resolve) => setTimeout(resolve, 5));
    // As tests/wasm/twin.cpp plays it.
    const frames = [];
    for (const ground of ['flat', 'hills']) {
      const { facts } = await engine.call('crowd', 203, ground);
      for (let f = 0; f < 90; ++f) {
        const { texels } = await engine.advanceCrowd(1 / 60, [20, 5], f >= 30);
        frames.push(texels.slice(0, facts.count * (4 + 12 * facts.joints)));
      }
    }
    const all = await crypto.subtle.digest('SHA-256', await new Blob(frames).arrayBuffer());
    const cost = async (ground, feet) => {
      await engine.call('crowd', 500, ground);
      const costs = [];
      for (let f = 0; f < 300; ++f) {
        const { posed, animationMs } = await engine.advanceCrowd(1 / 60, [0, 0], false, feet);
        if (posed !== 500) throw new Error(`only ${posed} were posed`);
        costs.push(animationMs);
      }
      return costs.sort((a, b) => a - b)[150];
    };
    const hash = [...new Uint8Array(all)].map((byte) => byte.toString(16).padStart(2, '0')).join('');
    return { hash, milliseconds: { flat: await cost('flat', true), hills: await cost('hills', true), without: await cost('hills', false) } };
  });
  assert.equal(hash, createHash('sha256').update(native).digest('hex'));
  const { flat, hills, without } = milliseconds;
  console.log(`    500 characters, all posed: ${flat.toFixed(2)} ms of animation a frame on flat ground (the middle of 300), ${hills.toFixed(2)} with feet on hills, ${without.toFixed(2)} there without`);
  assert.ok(flat > 0.05 && flat <= 3 && hills <= 3, JSON.stringify(milliseconds));
  assert.deepEqual(complaints, []);
});

await test('crowd: from one to ten thousand, animation told apart from drawing, kept over a reload, and left again', async () => {
  const { page, complaints } = await openPage(site.url);
  await page.getByRole('tab', { name: 'Crowd' }).click();
  const until = (count, animated) =>
    page.waitForFunction(
      ([count, animated]) => {
        const { facts, posed, costs, texels } = globalThis.studio.crowd();
        return facts?.count === count && texels >= count * 4 && costs.animation.filter((each) => each > 0).length > animated &&
          costs.rendering.some((each) => each > 0) && posed <= count && posed > 0;
      },
      [count, animated],
    );
  await until(500, 3);
  await page.waitForFunction(() =>
    /animation\s+[\d.]+ ms a frame[^]*500 posed[^]*drawing\s+[\d.]+ ms a picture/.test(document.querySelector('.readout.costs')?.innerText));
  // Everybody is drawn once, and the picture is not of one colour.
  const drawn = async () => (await page.locator('.panel .figures td').allInnerTexts()).reduce((sum, text) => sum + Number(text.replace(' ', '')), 0);
  assert.ok((await drawn()) > 300 && (await drawn()) <= 500, `${await drawn()} in sight`);
  const picture = await page.locator('.viewport canvas').screenshot();
  assert.ok(picture.length > 60000, `a picture of ${picture.length} bytes`);
  // On a slope it stands at other heights than on flat ground, and the picture is another one.
  const heights = () => page.evaluate(() => globalThis.studio.crowd().heights);
  await page.getByLabel('They go on').selectOption('flat');
  await page.waitForFunction(() => Math.max(...globalThis.studio.crowd().heights) === 0);
  await page.getByLabel('They go on').selectOption('slope');
  await page.waitForFunction(() => Math.max(...globalThis.studio.crowd().heights) > 1);
  assert.ok(Math.min(...(await heights())) < -1);
  await page.getByLabel('Feet are laid on it').uncheck();
  const { frames } = await page.evaluate(() => ({ frames: globalThis.studio.session.frameCount.value }));
  await page.waitForFunction((frames) => globalThis.studio.session.frameCount.value > frames + 2, frames);
  await until(500, 3);
  await page.getByLabel('Feet are laid on it').check();
  await page.getByLabel('Poses last longer far away').check();
  await page.waitForFunction(() => globalThis.studio.crowd().posed < 400);
  // Ten thousand are a lot for a browser that draws in software: a few pictures are enough.
  await page.getByRole('button', { name: '10 000', exact: true }).click();
  await until(10000, 0);
  await page.getByRole('button', { name: '10', exact: true }).click();
  await until(10, 3);
  // Paused it stands still, and one step is one frame.
  await page.getByRole('button', { name: 'Pause' }).click();
  await comeToRest(page);
  const seconds = () => page.evaluate(() => globalThis.studio.session.shownSeconds());
  const before = await seconds();
  await untilDrawn(page);
  assert.equal(await seconds(), before);
  await page.getByRole('button', { name: 'One step' }).click();
  await page.waitForFunction((before) => globalThis.studio.session.shownSeconds() > before, before);
  assert.ok(Math.abs((await seconds()) - before - 1 / 60) < 1e-6);
  await page.reload();
  await until(10, 2);
  await page.getByRole('slider', { name: 'Characters' }).press('Home');
  await until(1, 2);
  await page.getByRole('tab', { name: 'Terrain' }).click();
  const { time } = await state(page);
  await untilState(page, 'time', '>', time + 0.3);
  assert.deepEqual(complaints, []);
});
