// Projects come and go: from the folder that `surefoot studio` serves, chosen or dragged in; saved there, or downloaded.
import { computed, effect, signal } from '@preact/signals';
import { unzipSync, zipSync } from 'fflate';
import * as bench from './bench';
import * as folder from './folder';
import { forgetWork, keepWork, keptWork } from './kept_work';
import { fail, openDefault, problem, say } from './session';
import { workspace } from './settings';

/** A file with where it was under what was chosen. */
export interface Given {
  path: string;
  file: File;
}

const isOfProject = (file: string) => file === 'project.json' || /^clips\/[^/]+\.(glb|gltf|bvh)$/i.test(file);
const isClip = (file: string) => /\.(bvh|glb|gltf|fbx|dae)$/i.test(file);
const isSidecar = (file: string) => /\.surefoot\.json$/i.test(file);

/** It came from the served folder, or may go there: that was empty. */
const inFolder = signal(false);
export const savesInFolder = inFolder;

/** When project.json was written last, as far as we know; empty: it is not there. */
let known = '';
const stampOf = ({ files }: folder.Listing) => files.find(({ path }) => path === 'project.json')?.changed ?? '';

async function openServed(listing: folder.Listing): Promise<void> {
  known = stampOf(listing);
  const wanted = listing.files.map(({ path }) => path).filter(isOfProject);
  const files = await Promise.all(wanted.map(async (file): Promise<[string, Uint8Array]> => [file, await folder.read(file)]));
  if (!(await bench.openFiles(files))) return;
  analysed.value = false;
  inFolder.value = true;
}

const k_keep_after_ms = 700;
let home: string | null = null; // the served folder's name
let keeping = 0;
/** Clips that were analysed here are worth keeping even before anything is done to them. */
const analysed = signal(false);
export const worthSaving = computed(() => {
  const now = bench.project.value;
  return now !== null && now.unsaved && (now.undo !== null || analysed.value);
});

/** After every change the work is kept; once it is saved there is nothing to keep. */
effect(() => {
  const now = bench.project.value;
  clearTimeout(keeping);
  if (!now) return;
  if (!now.unsaved) void forgetWork();
  else if (worthSaving.value)
    keeping = window.setTimeout(() => {
      void bench.ask('benchFiles', true)
        .then(({ files }) => keepWork({ files, folder: inFolder.value ? home : null, known }))
        .catch(() => undefined);
    }, k_keep_after_ms);
});

/** What was not saved before the page went away, if it belongs here. */
async function openKept(listing?: folder.Listing): Promise<boolean> {
  const kept = await keptWork();
  if (!kept || (kept.folder !== null && (kept.folder !== home || !listing || kept.known !== stampOf(listing)))) return false;
  try {
    if (!(await bench.openFiles(kept.files, false))) return false;
  } catch {
    await forgetWork(); // of another version
    return false;
  }
  analysed.value = true;
  known = kept.known;
  inFolder.value = kept.folder !== null;
  problem.value = {
    title: 'Your unsaved work is here again',
    text: `“${bench.project.value!.name}” had changes when this page was left. They are kept in this browser until they are saved.`,
    question: true,
    actions: [
      { label: 'Go on with it', run: () => (problem.value = null) },
      { label: 'Drop the changes', run: () => void forgetWork().then(() => location.reload()) },
    ],
  };
  return true;
}

/** What the studio begins with. */
export async function openFirst(): Promise<void> {
  if (!folder.isServed && (await openKept())) return;
  if (folder.isServed) {
    try {
      const listing = await folder.list();
      home = listing.folder;
      if (await openKept(listing)) return;
      if (stampOf(listing) !== '') {
        await openServed(listing);
        return;
      }
      inFolder.value = listing.folder !== null;
    } catch (error) {
      fail('The project could not be opened; here is the default character', error);
    }
  }
  await openDefault();
}

const bytesOf = async ({ path, file }: Given): Promise<[string, Uint8Array]> => [path, new Uint8Array(await file.arrayBuffer())];

/** A project that was downloaded. */
function unzipped(given: [string, Uint8Array][]): [string, Uint8Array][] {
  const [only] = given;
  if (given.length !== 1 || !only || !/\.zip$/i.test(only[0])) return given;
  return Object.entries(unzipSync(only[1])).map(([path, bytes]) => [`${only[0].slice(0, -4)}/${path}`, bytes]);
}

/** The folder that everything is in, or the one file's own name. */
function nameOf(paths: string[]): string {
  const first = paths[0]!.split('/')[0]!;
  if (paths.every((path) => path.startsWith(`${first}/`))) return first;
  return paths.length === 1 ? first.replace(/\.[^.]*$/, '') : 'Clips';
}

/** A project, or clips to make one of: nothing leaves the machine. */
export async function openGiven(given: Given[]): Promise<void> {
  await bench.settled();
  try {
    const files = unzipped(await Promise.all(given.map(bytesOf)));
    const project = files.map(([path]) => path).filter((path) => /(^|\/)project\.json$/.test(path)).sort((a, b) => a.length - b.length)[0];
    if (project !== undefined) {
      const home = project.slice(0, -'project.json'.length);
      const own = files.map(([path, bytes]): [string, Uint8Array] => [path.slice(path.startsWith(home) ? home.length : path.length), bytes]);
      if (!(await bench.openFiles(own.filter(([path]) => isOfProject(path))))) return;
      analysed.value = false;
      inFolder.value = false;
      say('Opened. Nothing left this machine.');
      return;
    }
    const clips = files.filter(([path]) => isClip(path));
    if (clips.length === 0)
      throw new Error('There is neither a project.json nor a clip in it. Clips are .bvh, .glb and .gltf files.');
    await authorClips([...clips, ...files.filter(([path]) => isSidecar(path))], nameOf(clips.map(([path]) => path)));
  } catch (error) {
    fail('This cannot be opened', error);
  }
}

async function authorClips(files: [string, Uint8Array][], name: string): Promise<void> {
  const before = analysed.value;
  analysed.value = true;
  let made = false;
  try {
    made = await bench.author(files, name);
  } finally {
    if (!made) analysed.value = before;
  }
  if (!made) return;
  // A served folder that holds another project is not written over.
  inFolder.value = folder.isServed && known === '' && (await folder.list()).folder !== null;
  workspace.value = 'space';
  const now = bench.project.value!;
  const placed = new Set(now.spaces.flatMap((space) => space.samples.map(({ clip }) => clip))).size;
  const parts = [`${placed} ${placed === 1 ? 'clip is' : 'clips are'} in the blend space`];
  if (now.leftOut.length > 0) parts.push(`${now.leftOut.length} left out`);
  if (now.failed.length > 0) parts.push(`${now.failed.length} could not be read`);
  say(`${parts.join(', ')}. Nothing left this machine.`);
}

async function* filesIn(entry: FileSystemEntry, path = ''): AsyncGenerator<Given> {
  const here = path + entry.name;
  if (entry.isFile) {
    yield { path: here, file: await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)) };
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return;
    for (const each of some) yield* filesIn(each, `${here}/`);
  }
}

export async function openDropped(items: DataTransferItemList): Promise<void> {
  const entries = [...items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  // Only files have entries; all of them must be asked for before anything is awaited.
  const given: Given[] = [];
  try {
    for (const entry of entries) for await (const each of filesIn(entry)) given.push(each);
  } catch (error) {
    fail('What was dragged in cannot be read', error);
    return;
  }
  if (given.length > 0) await openGiven(given);
}

/** Saves what is new into the served folder, project.json last. */
async function saveInFolder(): Promise<void> {
  saving = true;
  try {
    await writeFiles();
  } finally {
    saving = false;
  }
}

async function writeFiles(): Promise<void> {
  const { files, gone } = await bench.ask('benchFiles', false);
  const order = [...files].sort(([a], [b]) => Number(a === 'project.json') - Number(b === 'project.json'));
  for (const [file, bytes] of order) await folder.write(file, bytes);
  const listing = await folder.list();
  const there = new Set(listing.files.map(({ path }) => path));
  for (const file of gone) if (there.has(file)) await folder.remove(file);
  known = stampOf(listing);
  await bench.markSaved();
  say(`Saved in the folder ${listing.folder ?? ''}.`);
}

/** Asks first where somebody else has written the project meanwhile. */
async function saveUnlessChanged(): Promise<void> {
  const listing = await folder.list();
  if (stampOf(listing) === known) return saveInFolder();
  problem.value = {
    title: 'The project has changed on disk',
    question: true,
    text: 'Another program has written project.json since it was opened here. Saving puts what you see in its place.',
    actions: [
      { label: 'Save all the same', run: () => settle(saveInFolder()) },
      { label: 'Open what is on disk', run: () => settle(openServed(listing)) },
      { label: 'Neither', run: () => (problem.value = null) },
    ],
  };
}

const k_look_every_ms = 3000;
let told = ''; // of which change the user was asked
let saving = false;

/** Asks once a change where another program has written the project that is open here. */
async function lookAtFolder(): Promise<void> {
  if (document.hidden || !inFolder.value || known === '' || saving || problem.value || bench.busy.value) return;
  const listing = await folder.list(), now = stampOf(listing);
  if (now === '' || now === known || now === told || saving || problem.value) return;
  told = now;
  problem.value = {
    title: 'The project has changed on disk',
    question: true,
    text: `Another program has written project.json.${bench.project.value?.unsaved ? ' What you have not saved here is dropped where you open it.' : ''}`,
    actions: [
      { label: 'Open what is on disk', run: () => settle(openServed(listing)) },
      { label: 'Go on with this', run: () => (problem.value = null) },
    ],
  };
}
if (folder.isServed) setInterval(() => void lookAtFolder().catch(() => undefined), k_look_every_ms); // a server that has gone is told of when it is needed

function settle(work: Promise<void>): void {
  problem.value = null;
  void work.catch((error: unknown) => fail('This did not work', error));
}

async function download(): Promise<void> {
  const { files } = await bench.ask('benchFiles', true);
  const name = bench.project.value!.name;
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([zipSync(Object.fromEntries(files), { level: 6 })]));
  link.download = `${name.replace(/[^\p{L}\p{N} ._-]/gu, '_')}.zip`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  await bench.markSaved();
}

export async function save(): Promise<void> {
  try {
    await (inFolder.value ? saveUnlessChanged() : download());
  } catch (error) {
    fail('The project could not be saved', error);
  }
}
