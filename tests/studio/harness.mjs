// What the studio's tests share: the browser, pages that must not complain, projects to work on. See studio_test.mjs.
import { execFileSync, spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { findBrowser, serveStatic, untilItMoves } from './browser.mjs';

export const [appFolder, program, twin] = process.argv.slice(2, 5).map((each) => path.resolve(each));
const wanted = process.argv[5] ?? '';
if (!twin) throw new Error('usage: studio_test.mjs BUILD/studio PROGRAM NATIVE_TWIN');

const browserOrNot = await findBrowser();
if (browserOrNot.missing) {
  console.log(`skipped: ${browserOrNot.missing}`);
  process.exit(process.env.SUREFOOT_NEED_JUDGES ? 1 : 0);
}
export const site = await serveStatic(appFolder);
export const browser = await browserOrNot.launch();
export const scratch = mkdtempSync(path.join(tmpdir(), 'surefoot-studio-'));

const k_patience_ms = 180000; // nothing is late before: the machine may be slow, and others at work on it
let passed = 0;
const failed = [];
export const open_ = [];

/** A page of its own that must neither complain nor ask anybody else. */
export async function openPage(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options.context });
  context.setDefaultTimeout(k_patience_ms);
  open_.push(context);
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  const origin = new URL(url).origin;
  page.on('request', (request) => {
    const to = request.url();
    if (!to.startsWith(`${origin}/`) && !to.startsWith('blob:') && !to.startsWith('data:')) complaints.push(`asked ${to}`);
  });
  if (options.settings)
    await page.addInitScript((settings) => {
      for (const [name, value] of Object.entries(settings))
        if (localStorage.getItem(`surefoot.studio.${name}`) === null)
          localStorage.setItem(`surefoot.studio.${name}`, JSON.stringify(value));
    }, options.settings);
  await page.goto(url);
  if (!options.broken) await untilItMoves(page);
  return { page, complaints };
}

export async function test(name, body) {
  if (!name.includes(wanted)) return;
  const begun = performance.now();
  try {
    await body();
    ++passed;
    console.log(`ok  ${name} (${Math.round(performance.now() - begun)} ms)`);
  } catch (error) {
    failed.push(name);
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
  for (const context of open_.splice(0)) await context.close();
}

export const state = (page) =>
  page.evaluate(() => {
    const { session } = globalThis.studio;
    const facts = session.facts.value, frame = session.frame, at = facts.layout;
    return {
      time: frame[at.time],
      root: [...frame.slice(at.root, at.root + 4)],
      speed: frame[at.speed],
      steered: session.steered.value,
      playing: session.playing.value,
      problem: session.problem.value?.text ?? null,
    };
  });
/** Until time, z, yaw or speed is above or below a value. */
export const untilState = (page, name, sign, value) =>
  page.waitForFunction(
    ([name, sign, value]) => {
      const { session } = globalThis.studio;
      const at = session.facts.value.layout, frame = session.frame;
      const now = { time: frame[at.time], z: frame[at.root + 2], yaw: frame[at.root + 3], speed: frame[at.speed] }[name];
      return sign === '>' ? now > value : now < value;
    },
    [name, sign, value],
  );
/** Paused, and nothing is under way any more: what is read now is what it is. */
export const comeToRest = (page) =>
  page.evaluate(async () => {
    const { session, engine, entered } = globalThis.studio;
    session.playing.value = false;
    await entered();
    while (engine.crowdBusy) await new Promise((resolve) => setTimeout(resolve, 1));
    await session.step(0);
  });
/** Until what was done before is in the picture. */
export const untilDrawn = (page) =>
  page.evaluate(async () => {
    for (let i = 0; i < 3; ++i) await new Promise(requestAnimationFrame);
  });

/** `surefoot studio` on a project; what it printed first is the address. */
export async function startStudio(project) {
  const process_ = spawn(program, ['studio', project, '--no-open', '--app', appFolder], { stdio: ['ignore', 'pipe', 'ignore'] });
  const address = await new Promise((resolve, reject) => {
    let text = '';
    process_.stdout.on('data', (some) => {
      text += some;
      if (text.includes('\n')) resolve(text.slice(0, text.indexOf('\n')));
    });
    process_.on('exit', (code) => reject(new Error(`surefoot studio ended with code ${code}`)));
  });
  return { address, stop: () => process_.kill('SIGTERM') };
}

/** Files and folders of this machine, dragged into the page as a hand would. */
export async function dragIn(page, paths) {
  const session = await page.context().newCDPSession(page);
  const data = { items: [], files: paths, dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop']) await session.send('Input.dispatchDragEvent', { type, x: 400, y: 300, data });
}

/** What the page would save, as text by name. */
export const filesOf = (page) =>
  page.evaluate(async () => {
    const { files } = await globalThis.studio.bench.ask('benchFiles', true);
    const hex = async (bytes) => [...new Uint8Array(await crypto.subtle.digest('SHA-256', bytes))].map((each) => each.toString(16).padStart(2, '0')).join('');
    return Object.fromEntries(await Promise.all(files.map(async ([name, bytes]) => [name, await hex(bytes)])));
  });
export const filesIn = (folder) =>
  Object.fromEntries(
    readdirSync(folder, { recursive: true, withFileTypes: true })
      .filter((each) => each.isFile() && !each.parentPath.includes('.cache'))
      .map((each) => path.join(each.parentPath, each.name))
      .map((file) => [path.relative(folder, file).replaceAll(path.sep, '/'), createHash('sha256').update(readFileSync(file)).digest('hex')]),
  );
export const idle = (page) => page.waitForFunction(() => !globalThis.studio.bench.busy.value);
/** Where there is one thing to mend. */
export async function mendAll(page) {
  await page.getByRole('button', { name: 'Mend all' }).click();
  await page.waitForFunction(() => globalThis.studio.bench.project.value.repairs.length === 1);
  await idle(page);
}
/** Until a project is on the stage, on the bench, and the workspace has taken it. */
export async function untilOpen(page, name) {
  await page.getByText(new RegExp(`^${name}, \\d+ clips?$`)).waitFor();
  await page.waitForFunction((name) => globalThis.studio.bench.project.value?.name === name && !globalThis.studio.bench.busy.value, name);
  await page.evaluate(() => globalThis.studio.entered());
}
/** Until the browser's storage has what a reload is to find. */
export const untilKept = (page) => page.waitForFunction(() => globalThis.studio.isKept.value);
export const bench = (page, name) => page.evaluate((name) => globalThis.studio.bench.project.value?.[name], name);

/** Two takes of one person as .bvh and fifty clips of a game's character as .glb, all in one folder. */
export function realClips() {
  const motion = process.env.SUREFOOT_MOTION ?? path.join(import.meta.dirname, '../../../shared/motion');
  if (!existsSync(motion)) return null;
  const folder = path.join(scratch, 'mixed');
  mkdirSync(folder, { recursive: true });
  for (const file of ['o3de_mocap_bvh/Walk1.bvh', 'o3de_mocap_bvh/Run1.bvh', 'ual1_locomotion_glb/UAL1_50clips_mannequin.glb']) {
    const to = path.join(folder, path.basename(file));
    if (!existsSync(to)) writeFileSync(to, readFileSync(path.join(motion, file)));
  }
  return folder;
}

/** A project with something to mend: the built-in clips without those that step or turn on the spot to the left. */
export function lackingProject(name) {
  const whole = path.join(scratch, 'whole'), some = path.join(scratch, 'some');
  if (!existsSync(some)) {
    execFileSync(program, ['author', '--synthetic', '-o', whole], { stdio: 'ignore' });
    mkdirSync(some);
    for (const clip of readdirSync(path.join(whole, 'clips')))
      if (!/^(turn|run|jog|strafe)_left\.glb$/.test(clip)) copyFileSync(path.join(whole, 'clips', clip), path.join(some, clip));
  }
  const project = path.join(scratch, name);
  execFileSync(program, ['author', some, '-o', project, '--no-mannequin'], { stdio: 'ignore' });
  return project;
}
export const nativeLint = (project, ...options) => {
  try {
    return JSON.parse(execFileSync(program, ['lint', project, '--json', ...options], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  } catch (error) {
    return JSON.parse(error.stdout); // exit code 1: there are findings
  }
};
export const told = (findings) => findings.map(({ rule, message, clips }) => ({ rule, message, clips }));

/** Closes everything and says how it went. */
export async function finish() {
  await browser.close();
  site.close();
  rmSync(scratch, { recursive: true, force: true });
  console.log(`${passed} tests passed${failed.length ? `, ${failed.length} failed: ${failed.join('; ')}` : ''}`);
  process.exit(failed.length ? 1 : 0);
}
