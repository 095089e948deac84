#!/usr/bin/env node
// Pictures of the studio for the documentation, light and dark, desktop and phone. For developers; needs chromium and
// the packages of tests/studio.
//
//   node scripts/studio_pictures.mjs BUILD/studio OUT_FOLDER
import { mkdirSync } from 'node:fs';
import path from 'node:path';
import { findBrowser, serveStatic, untilItMoves } from '../tests/studio/browser.mjs';

const [app, out] = process.argv.slice(2);
if (!out) throw new Error('usage: studio_pictures.mjs BUILD/studio OUT_FOLDER');
const desktop = { width: 1280, height: 720 }, phone = { width: 844, height: 390 };
const pictures = [
  { name: 'studio_terrain', viewport: desktop, colorScheme: 'light', settings: { course: 'stairs_up', camera: 'follow' } },
  { name: 'studio_terrain_dark', viewport: desktop, colorScheme: 'dark',
    settings: { course: 'hills', camera: 'feet', 'overlay.axes': true, 'overlay.hips': true } },
  { name: 'studio_space', viewport: desktop, colorScheme: 'light', settings: { workspace: 'space' } },
  { name: 'studio_space_dark', viewport: desktop, colorScheme: 'dark', settings: { workspace: 'space' }, colored: 'Foot skate' },
  { name: 'studio_gait', viewport: desktop, colorScheme: 'light', settings: { workspace: 'gait', camera: 'side' } },
  { name: 'studio_gait_dark', viewport: desktop, colorScheme: 'dark', settings: { workspace: 'gait', camera: 'side' } },
  { name: 'studio_gait_phone', viewport: phone, colorScheme: 'light', settings: { workspace: 'gait', camera: 'side' } },
  { name: 'studio_graph', viewport: desktop, colorScheme: 'light', settings: { workspace: 'graph', camera: 'side' } },
  { name: 'studio_crowd', viewport: desktop, colorScheme: 'light', settings: { workspace: 'crowd' } },
  { name: 'studio_crowd_dark', viewport: desktop, colorScheme: 'dark', settings: { workspace: 'crowd', crowd: 2000, 'crowd.view': 'among' } },
  { name: 'studio_phone', viewport: phone, colorScheme: 'light', settings: { course: 'rubble' } },
];

const found = await findBrowser();
if (found.missing) throw new Error(found.missing);
mkdirSync(out, { recursive: true });
const site = await serveStatic(app);
const browser = await found.launch();
for (const { name, viewport, colorScheme, settings, colored } of pictures) {
  const context = await browser.newContext({ viewport, colorScheme });
  const page = await context.newPage();
  await page.addInitScript((kept) => {
    for (const [key, value] of Object.entries(kept)) localStorage.setItem(`surefoot.studio.${key}`, JSON.stringify(value));
  }, settings);
  await page.goto(site.url);
  await untilItMoves(page);
  if (settings.workspace === 'space') await page.waitForFunction(() => globalThis.studio.bench.project.value && !globalThis.studio.bench.busy.value);
  if (colored) {
    await page.getByLabel('Colour by').selectOption(colored);
    await page.waitForFunction(() => globalThis.studio.bench.shownHeat.value !== '', null, { timeout: 60000 });
  }
  // Paused, then stepped by hand: the same moment every time, however slow the machine.
  await page.evaluate(async () => {
    const { session, engine } = globalThis.studio;
    session.playing.value = false;
    while (engine.busy) await new Promise((resolve) => setTimeout(resolve, 5));
    await session.restart();
    for (let f = 0; f < 430; ++f) await session.step(1);
    session.figures.value = await engine.call('metrics');
  });
  await page.waitForTimeout(2500); // the camera comes to rest
  await page.screenshot({ path: path.join(out, `${name}.jpg`), type: 'jpeg', quality: 82 });
  await context.close();
}
await browser.close();
site.close();
