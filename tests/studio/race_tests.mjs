// Things that come together, or in another order than they were asked for: answers that are late, keys that are quick.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { untilItMoves } from './browser.mjs';
import {
  bench, comeToRest, lackingProject, mendAll, openPage, program, scratch, site, startStudio, state, test, untilKept, untilOpen,
} from './harness.mjs';

/** Answers of all engines to a call by this name wait, from now on, until `release`. */
const hold = (page, name) =>
  page.evaluate((name) => {
    const engine = Object.getPrototypeOf(globalThis.studio.engine), call = engine.call;
    const held = (globalThis.held = { asked: 0 });
    const released = new Promise((resolve) => (held.release = resolve));
    engine.call = async function (called, ...args) {
      const answer = call.call(this, called, ...args);
      if (called === name) {
        ++held.asked;
        await answer;
        await released;
      }
      return answer;
    };
  }, name);
const untilAsked = (page) => page.waitForFunction(() => globalThis.held.asked > 0);
/** Lets the answers go, and what they bring about happen. */
const release = (page) =>
  page.evaluate(async () => {
    globalThis.held.release();
    await new Promise((resolve) => setTimeout(resolve));
  });

await test('of two steps that are asked for at once both are made, one after the other', async () => {
  const { page, complaints } = await openPage(site.url);
  await comeToRest(page);
  const { time } = await state(page);
  await page.evaluate(() => Promise.all([globalThis.studio.session.step(1), globalThis.studio.session.step(1)]));
  assert.ok(Math.abs((await state(page)).time - time - 2 / 60) < 1e-4);
  assert.deepEqual(complaints, []);
});

await test('figures of the foot mode before, which come late, are not shown', async () => {
  const { page, complaints } = await openPage(site.url, { settings: { course: 'flat' } });
  await page.waitForFunction(() => globalThis.studio.session.figures.value !== null);
  await hold(page, 'metrics');
  await untilAsked(page);
  await page.keyboard.press('1');
  await comeToRest(page);
  await release(page);
  assert.equal(await page.evaluate(() => globalThis.studio.session.figures.value), null);
  assert.deepEqual(complaints, []);
});

await test('what is said again stays as long as what is said once', async () => {
  const { page } = await openPage(site.url);
  const stays = await page.evaluate(() => {
    const { setTimeout, clearTimeout } = globalThis, waiting = new Map();
    let timers = 0;
    globalThis.setTimeout = (run) => waiting.set(++timers, run) && timers;
    globalThis.clearTimeout = (timer) => waiting.delete(timer);
    const { session } = globalThis.studio;
    session.say('Saved.');
    session.say('Saved.');
    Object.assign(globalThis, { setTimeout, clearTimeout });
    waiting.get(1)?.();
    return session.notice.value;
  });
  assert.equal(stays, 'Saved.');
});

await test('gait: what was typed right before another workspace was chosen, or the page was left, is there again', async () => {
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'gait' } });
  const area = page.getByLabel(/^Expressions of/);
  const text = await area.inputValue();
  const type = (text, leave) =>
    page.evaluate(([text, leave]) => {
      const area = document.querySelector('#gait-text');
      area.focus();
      area.value = text;
      area.dispatchEvent(new Event('input', { bubbles: true }));
      if (leave) document.querySelector('#tab-terrain').click();
      else dispatchEvent(new PageTransitionEvent('pagehide'));
    }, [text, leave]);
  const kept = () => page.evaluate(() => JSON.parse(localStorage.getItem('surefoot.studio.gait')).text);
  await type(`${text}# one\n`, true);
  await page.getByLabel('Walk over').waitFor();
  assert.equal(await kept(), `${text}# one\n`);
  await page.getByRole('tab', { name: 'Gait' }).click();
  await page.waitForFunction(() => document.querySelector('#gait-text')?.value.endsWith('# one\n'));
  await type(`${text}# two\n`, false);
  assert.equal(await kept(), `${text}# two\n`);
  assert.deepEqual(complaints, []);
});

await test('gait: of two gaits that are chosen at once the later one goes, though the earlier one comes after it', async () => {
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'gait' } });
  await hold(page, 'gaitSource');
  await page.evaluate(() => void globalThis.studio.gait.choose('bhatti2017'));
  await untilAsked(page);
  await page.evaluate(() => globalThis.studio.gait.choose('walk'));
  await page.waitForFunction(() => globalThis.studio.gait.gait.value?.name === 'walk');
  await release(page);
  assert.equal(await page.evaluate(() => JSON.parse(localStorage.getItem('surefoot.studio.gait')).name), 'walk');
  assert.deepEqual(complaints, []);
});

await test('work that is dropped while it is being kept is not there again', async () => {
  const project = lackingProject('dropped');
  const { page, complaints } = await openPage(site.url, { settings: { workspace: 'space' } });
  await page.locator('input.folder').setInputFiles(project);
  await untilOpen(page, 'dropped');
  await mendAll(page);
  await untilKept(page);
  await page.reload();
  await untilOpen(page, 'dropped');
  // Changed once more: it is about to be kept, and held up there until the storage is told to forget it.
  await hold(page, 'benchFiles');
  await page.getByLabel('Too close', { exact: true }).fill('12');
  await untilAsked(page);
  await page.evaluate(() => {
    const { delete: forget } = IDBObjectStore.prototype;
    IDBObjectStore.prototype.delete = function (...args) {
      const asked = forget.apply(this, args);
      globalThis.held.release();
      return asked;
    };
  });
  await page.getByRole('button', { name: 'Drop the changes' }).click();
  await untilOpen(page, 'Default character');
  assert.equal(await page.getByRole('alert').count(), 0);
  assert.deepEqual(complaints, []);
});

await test('what is changed while the project is being saved is not taken for saved', async () => {
  const project = lackingProject('saving');
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address, { settings: { workspace: 'space' } });
    await untilOpen(page, 'saving');
    const close = page.getByLabel('Too close', { exact: true });
    await close.fill('12');
    await page.waitForFunction(() => globalThis.studio.bench.project.value.unsaved);
    // The folder takes its time; meanwhile the threshold moves on.
    let write;
    const writing = new Promise((resolve) => (write = resolve));
    let asked;
    const isAsked = new Promise((resolve) => (asked = resolve));
    await page.route('**/api/files/**', async (route) => {
      if (route.request().method() === 'PUT') {
        asked();
        await writing;
      }
      await route.continue();
    });
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    await isAsked;
    await close.fill('14');
    write();
    await page.getByText('Saved in the folder').waitFor();
    await page.waitForFunction(() => globalThis.studio.bench.project.value.unsaved);
    const onDisk = () => JSON.parse(readFileSync(path.join(project, 'project.json'), 'utf8')).lint['too-close'].thresholds.distance;
    assert.equal(onDisk(), 12);
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    await page.waitForFunction(() => !globalThis.studio.bench.project.value.unsaved);
    assert.equal(onDisk(), 14);
    assert.deepEqual(complaints, []);
  } finally {
    studio.stop();
  }
});

await test('unsaved work is there again though its project was written meanwhile, and that is said', async () => {
  const project = lackingProject('both');
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address, { settings: { workspace: 'space' } });
    await untilOpen(page, 'both');
    await mendAll(page);
    await untilKept(page);
    const file = path.join(project, 'project.json');
    writeFileSync(file, `${readFileSync(file, 'utf8')}\n`);
    await page.reload();
    await page.getByRole('button', { name: 'Go on with it' }).click();
    assert.equal((await bench(page, 'repairs')).length, 1);
    await page.getByText('Another program has written project.json').waitFor();
    await page.getByRole('button', { name: 'Go on with this' }).click();
    assert.deepEqual(complaints, []);
  } finally {
    studio.stop();
  }
});

await test('graph: a file that another program writes meanwhile is offered, once a change, also after a reload', async () => {
  const project = path.join(scratch, 'watched');
  execFileSync(program, ['author', '--default', '-o', project], { stdio: 'ignore' });
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address, { settings: { workspace: 'graph' } });
    await page.getByRole('button', { name: 'Save in the folder' }).click();
    await page.getByText('Saved as stroll.json.').waitFor();
    const file = path.join(project, 'stroll.json');
    const write = (seconds) => writeFileSync(file, readFileSync(file, 'utf8').replace(/"seconds": 0\.\d+/, `"seconds": ${seconds}`));
    write(0.71);
    await page.getByText('stroll.json has changed on disk').waitFor();
    await page.getByRole('button', { name: 'Go on with this' }).click();
    for (let i = 0; i < 2; ++i) await page.waitForResponse((response) => response.url().endsWith('api/project'));
    assert.equal(await page.getByText('has changed on disk').count(), 0, 'it does not ask twice');
    await page.reload();
    await untilItMoves(page);
    await page.getByRole('button', { name: 'Open what is on disk' }).click();
    await page.waitForFunction(() => globalThis.studio.graph.text().includes('"seconds": 0.71'));
    assert.deepEqual(complaints, []);
  } finally {
    studio.stop();
  }
});
