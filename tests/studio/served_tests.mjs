// What is broken or missing, and the folder that `surefoot studio` serves.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import {
  browser, open_, openPage, program, scratch, site, startStudio, state, test, untilDrawn, untilOpen, untilState,
} from './harness.mjs';

await test('a folder without a project, and a broken one, are refused in words and the character walks on', async () => {
  const { page, complaints } = await openPage(site.url);
  const folder = path.join(scratch, 'broken');
  mkdirSync(folder, { recursive: true });
  writeFileSync(path.join(folder, 'notes.txt'), 'nothing here');
  const choose = (which) => page.locator('input.folder').setInputFiles(which);
  await choose(folder);
  await page.getByText('neither a project.json nor a clip').waitFor();
  await page.getByRole('button', { name: 'Dismiss' }).click();
  writeFileSync(path.join(folder, 'project.json'), '{"version": 1, ');
  await choose(folder);
  await page.getByRole('alert').getByText('project.json').waitFor();
  await page.getByRole('button', { name: 'Dismiss' }).click();
  const { time } = await state(page);
  await untilState(page, 'time', '>', time + 0.3);
  assert.deepEqual(complaints, []);
});

await test('where the engine is missing the page says so', async () => {
  const context = await browser.newContext();
  open_.push(context);
  const page = await context.newPage();
  await page.route('**/*.wasm', (route) => route.fulfill({ status: 404, body: '' }));
  await page.goto(site.url);
  await page.getByRole('alert').getByText('could not be fetched').waitFor();
  await page.getByRole('button', { name: 'Reload the page' }).waitFor();
});

await test('surefoot studio: a project that another program writes meanwhile is offered, once a change', async () => {
  const project = path.join(scratch, 'written');
  execFileSync(program, ['author', '--default', '-o', project], { stdio: 'ignore' });
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address);
    await untilOpen(page, 'written');
    const file = path.join(project, 'project.json');
    const write = (name) => writeFileSync(file, readFileSync(file, 'utf8').replace(/"name": "[^"]*"/, `"name": "${name}"`));
    write('first');
    await page.getByText('Another program has written project.json').waitFor();
    await page.getByRole('button', { name: 'Go on with this' }).click();
    for (let i = 0; i < 2; ++i) await page.waitForResponse((response) => response.url().endsWith('api/project'));
    await untilDrawn(page);
    assert.equal(await page.getByText('Another program').count(), 0, 'it does not ask twice');
    write('second');
    await page.getByRole('button', { name: 'Open what is on disk' }).click();
    await untilOpen(page, 'second');
    assert.deepEqual(complaints, []);
  } finally {
    studio.stop();
  }
});

await test('surefoot studio shows the project that it serves, in isolation, also after a reload', async () => {
  const project = path.join(scratch, 'biped');
  execFileSync(program, ['author', '--synthetic', '-o', project], { stdio: 'ignore' });
  const studio = await startStudio(project);
  try {
    const { page, complaints } = await openPage(studio.address);
    await untilOpen(page, 'biped');
    assert.equal(new URL(page.url()).hash, '', 'the token does not stay in the address');
    assert.equal(await page.evaluate(() => crossOriginIsolated), true);
    const before = await state(page);
    await untilState(page, 'time', '>', before.time + 0.5);
    await page.reload();
    await untilOpen(page, 'biped');
    assert.deepEqual(complaints, []);
    // The same folder by hand, without a server: the same character.
    const { page: alone } = await openPage(site.url);
    await alone.locator('input.folder').setInputFiles(project);
    await untilOpen(alone, 'biped');
  } finally {
    studio.stop();
  }
});
