// Projects come and go: from the folder that `surefoot studio` serves, chosen or dragged in; saved there, or downloaded.
import { computed, effect, signal } from '@preact/signals';
import { unzipSync, zipSync } from 'fflate';
import * as bench from './bench';
import { download } from './download';
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
/** Counts what there was to keep: what is kept late must not take the place of what came after. */
let wish = 0;
/** This browser keeps what is unsaved as it is now, and nothing else. */
export const isKept = signal(false);
/** Clips that were analysed here are worth keeping even before anything is done to them. */
const analysed = signal(false);
export const worthSaving = computed(() => {
  const now = bench.project.value;
  return now !== null && now.unsaved && (now.undo !== null || analysed.value);
});

/** After every change the work is kept; once it is saved there is nothing to keep. */
effect(() => {
  const now = bench.project.value, mine = unkept();
  if (!now) return;
  if (!now.unsaved) void forgetWork().then((isGone) => mine === wish && (isKept.value = isGone));
  else if (worthSaving.value) keeping = window.setTimeout(() => void keep(mine).catch(() => undefined), k_keep_after_ms);
});

/** What was about to be kept no longer is; the number of what comes next. */
function unkept(): number {
  clearTimeout(keeping);
  isKept.value = false;
  return ++wish;
}

async function keep(mine: number): Promise<void> {
  const { files } = await bench.ask('benchFiles', true);
  if (mine !== wish) return;
  const isStored = await keepWork({ files, folder: inFolder.value ? home : null, known });
  if (mine === wish) isKept.value = isStored;
}

/** Who leaves sooner than work can be kept is asked by the browser. */
addEventListener('beforeunload', (event) => worthSaving.value && !isKept.value && !leaving && event.preventDefault());
let leaving = false;

async function dropWork(): Promise<void> {
  unkept();
  leaving = true;
  await forgetWork();
  location.reload();
}

/** What was not saved before the page went away, if it belongs here. */
async function openKept(listing?: folder.Listing): Promise<boolean> {
  const kept = await keptWork();
  // Where the folder's project has changed meanwhile that is said next: see folder.watch below.
  if (!kept || (kept.folder !== null && (kept.folder !== home || !listing))) return false;
  try {
    if (!(await bench.openFiles(kept.files, false))) return false;
  } catch {
    await forgetWork(); // of another version
    return false;
  }
  analysed.value = true;
  known = kept.known;
  inFolder.value = kept.folder !== null;
  unkept();
  isKept.value = true;
  problem.value = {
    title: 'Your unsaved work is here again',
    text: `“${bench.project.value!.name}” had changes when this page was left. They are kept in this browser until they are saved.`,
    question: true,
    actions: [
      { label: 'Go on with it', run: () => (problem.value = null) },
      { label: 'Drop the changes', run: () => void dropWork() },
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

let saving = false;
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
  let name = '';
  await bench.saveBy(false, async ({ files, gone }) => {
    const order = [...files].sort(([a], [b]) => Number(a === 'project.json') - Number(b === 'project.json'));
    for (const [file, bytes] of order) await folder.write(file, bytes);
    const listing = await folder.list();
    const there = new Set(listing.files.map(({ path }) => path));
    for (const file of gone) if (there.has(file)) await folder.remove(file);
    known = stampOf(listing);
    name = listing.folder ?? '';
  });
  say(`Saved in the folder ${name}.`);
}

let told = ''; // of which change the user was asked
/** Asks first where somebody else has written the project meanwhile. */
async function saveUnlessChanged(): Promise<void> {
  const listing = await folder.list();
  if (stampOf(listing) === known) return saveInFolder();
  told = stampOf(listing);
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


/** Asks once a change where another program has written the project that is open here. */
folder.watch((listing) => {
  if (!inFolder.value || known === '' || saving || problem.value || bench.busy.value) return;
  const now = stampOf(listing);
  if (now === '' || now === known || now === told) return;
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
});

function settle(work: Promise<void>): void {
  problem.value = null;
  void work.catch((error: unknown) => fail('This did not work', error));
}

const saveAsDownload = () =>
  bench.saveBy(true, async ({ files }) => {
    const name = bench.project.value!.name.replace(/[^\p{L}\p{N} ._-]/gu, '_');
    download(`${name}.zip`, zipSync(Object.fromEntries(files), { level: 6 }));
  });

export async function save(): Promise<void> {
  try {
    await (inFolder.value ? saveUnlessChanged() : saveAsDownload());
  } catch (error) {
    fail('The project could not be saved', error);
  }
}
