// The project that is worked on. It lies in an engine of its own, so that the character goes on while that one thinks.
import { batch, computed, signal } from '@preact/signals';
import { EngineClient, Stopped } from './engine/engine';
import type { BenchFacts, CallName, Calls, FixAttempt, Heat } from './engine/messages';
import { fail, openPack, say } from './session';

export type Files = [string, Uint8Array][];

/** Work that takes long enough to be shown. */
export interface Work {
  title: string;
  /** "measuring", 3 of 20; nothing is known of it where total is 0. */
  label: string;
  done: number;
  total: number;
  /** Where it can be left. */
  stop?: () => void;
}

export const project = signal<BenchFacts | null>(null);
export const work = signal<Work | null>(null);
/** What became of the last repairs that were asked for. */
export const attempts = signal<FixAttempt[]>([]);
/** Empty where nobody probed the spaces as they are. */
export const heat = signal<Heat[]>([]);
/** Which figure the map is coloured by; empty: by none. */
export const shownHeat = signal('');
export const busy = computed(() => work.value !== null);

let client: EngineClient | null = null;
/** Of the project that is being opened. */
let opening: EngineClient | null = null;
/** The spaces of who is on the stage. */
let staged = '';
/** What works on the project comes one after the other, and so does what puts another in its place. */
let last: Promise<unknown> = Promise.resolve();

function inTurn<Result>(body: () => Promise<Result>): Promise<Result> {
  const done = last.then(body);
  last = done.catch(() => undefined);
  return done;
}

const k_words: Record<string, string> = { reading: 'Reading files', measuring: 'Measuring clips', probing: 'Playing blends' };

function begin(title: string, stop?: () => void): void {
  work.value = { title, label: '', done: 0, total: 0, ...(stop && { stop }) };
}

function newClient(): EngineClient {
  const made: EngineClient = new EngineClient(
    (message) => {
      const wasOpen = made === client;
      made.stop();
      if (wasOpen) {
        work.value = null;
        client = null;
        project.value = null;
      }
      fail('The project’s engine stopped', `${message}. Open the project again; what was saved is safe.`);
    },
    (label, done, total) => {
      if (work.value) work.value = { ...work.value, label: k_words[label] ?? label, done, total };
    },
  );
  return made;
}

const spacesOf = (facts: BenchFacts): string => JSON.stringify(facts.spaces);

/** Shows what the bench has, and puts it on the stage where it plays otherwise than before. */
async function show(from: EngineClient, facts: BenchFacts): Promise<void> {
  if (spacesOf(facts) !== staged) {
    await openPack(await from.call('benchPack'));
    staged = spacesOf(facts);
  }
  const found = facts.probed ? await from.call('benchHeat') : [];
  if (from.stopped) throw new Stopped();
  batch(() => {
    project.value = facts;
    heat.value = found;
    if (!facts.probed) shownHeat.value = '';
  });
}

/**
 * Another project: until it is there, the one that is here stays. False where somebody stopped it, or asked for another
 * one meanwhile: the last one that is asked for is the one that is opened.
 */
export async function open(title: string, load: (client: EngineClient) => Promise<BenchFacts>): Promise<boolean> {
  opening?.stop();
  const next = (opening = newClient());
  begin(title, () => next.stop());
  try {
    await next.call('start');
    const facts = await load(next);
    await inTurn(async () => {
      staged = '';
      await show(next, facts);
      client?.stop();
      client = next;
      attempts.value = [];
    });
    return true;
  } catch (error) {
    next.stop();
    if (error instanceof Stopped) return false;
    throw error;
  } finally {
    if (opening === next) {
      opening = null;
      work.value = null;
    }
  }
}

/** `onDisk`: else they are work that was kept elsewhere. */
export const openFiles = (files: Files, onDisk = true) => open('Opening the project', (next) => next.call('benchOpen', files, onDisk));
export const author = (files: Files, name: string) =>
  open(`Making a blend space of ${name}`, (next) => next.call('benchAuthor', files, name));
/** The bundled gaits' clips, where nothing else is open. */
export async function openDefaultBench(): Promise<void> {
  if (client || busy.value) return;
  try {
    await open('Opening the default character’s clips', (next) => next.call('benchDefault'));
  } catch (error) {
    fail('The blend spaces could not be shown', error);
  }
}

const k_look_every_ms = 30;

/** Nothing is going on any more: what comes next waits for it. */
export async function settled(): Promise<void> {
  while (busy.value) await new Promise((resolve) => setTimeout(resolve, k_look_every_ms));
}

/** Does something with the bench, after what was asked before and with nothing else between. It must not `ask` itself. */
export function withBench<Result>(body: (bench: EngineClient) => Promise<Result>): Promise<Result> {
  const meant = client;
  return inTurn(() => {
    if (!meant) throw new Error('There is no project.');
    if (meant !== client) throw new Stopped(); // another project has come: this was not meant for it
    return body(meant);
  });
}

export const ask = <Name extends CallName>(name: Name, ...args: Parameters<Calls[Name]>): Promise<ReturnType<Calls[Name]>> =>
  withBench((bench) => bench.call(name, ...args));

type Step = 'benchThreshold' | 'benchResetThresholds' | 'benchTakeBack' | 'benchLeaveOut' | 'benchUndo' | 'benchRedo' | 'benchProbe';

/** A step, and what the project is then. Where it fails, nothing has changed. */
async function step<Name extends Step>(failure: string, name: Name, ...args: Parameters<Calls[Name]>): Promise<void> {
  try {
    await withBench(async (bench) => show(bench, (await bench.call(name, ...args)) as BenchFacts));
  } catch (error) {
    if (!(error instanceof Stopped)) fail(failure, error);
  }
}

async function long(title: string, body: () => Promise<void>): Promise<void> {
  if (busy.value) return;
  begin(title);
  try {
    await body();
  } finally {
    work.value = null;
  }
}

/** Where a colour map is shown it stays true. */
async function probeAgain(figure: string): Promise<void> {
  if (figure === '') return;
  await step('The spaces could not be probed', 'benchProbe');
  shownHeat.value = figure;
}

const changing = (title: string, body: () => Promise<void>) =>
  long(title, async () => {
    const figure = shownHeat.value;
    await body();
    if (project.value && !project.value.probed) await probeAgain(figure);
  });

let wanted: [rule: string, name: string, value: number] | null = null;
let setting = false;

/** The last value wins: while one is being set, a slider may have moved on. */
export async function setThreshold(rule: string, name: string, value: number): Promise<void> {
  wanted = [rule, name, value];
  if (setting) return;
  setting = true;
  while (wanted) {
    const now = wanted;
    wanted = null;
    await step('This threshold cannot be set', 'benchThreshold', ...now);
  }
  setting = false;
}

export const resetThresholds = () => step('The thresholds could not be reset', 'benchResetThresholds');

/** Mends one finding, or all that can be mended, and says how it went. */
export const mend = (id = '') =>
  changing(id === '' ? 'Mending what can be mended' : 'Mending', async () => {
    try {
      const tried = await withBench(async (bench) => {
        const tried = await bench.call('benchFix', id);
        await show(bench, await bench.call('bench'));
        return tried;
      });
      attempts.value = tried;
      const done = tried.filter((each) => each.done).length;
      say(done === 0 ? 'Nothing could be mended here: the reasons stand with the findings.' : `${done} ${done === 1 ? 'repair was' : 'repairs were'} made. Undo takes ${done === 1 ? 'it' : 'them'} back.`);
    } catch (error) {
      if (!(error instanceof Stopped)) fail('This could not be mended', error);
    }
  });

const fresh = (title: string, body: () => Promise<void>) =>
  changing(title, async () => {
    attempts.value = [];
    await body();
  });
export const takeBack = (repair: string) => fresh('Taking back a repair', () => step('This repair cannot be taken back', 'benchTakeBack', repair));
export const leaveOut = (clip: string, out: boolean) =>
  fresh(out ? 'Leaving out a clip' : 'Taking in a clip', () => step('This clip cannot be left out', 'benchLeaveOut', clip, out));
export const undo = () => fresh('Undoing', () => step('This cannot be undone', 'benchUndo'));
export const redo = () => fresh('Doing it again', () => step('This cannot be done again', 'benchRedo'));

/** Colours the map by a figure of the probe; played and measured where that was not done yet. */
export async function showHeat(figure: string): Promise<void> {
  if (figure === '' || project.value?.probed) {
    shownHeat.value = figure;
    return;
  }
  await long('Playing blends and measuring them', () => probeAgain(figure));
}

/** Writes its files, all or only those that are not saved, and the names of those that have gone; then it is saved as it is. */
export const saveBy = (all: boolean, write: (made: ReturnType<Calls['benchFiles']>) => Promise<void>) =>
  withBench(async (bench) => {
    await write(await bench.call('benchFiles', all));
    await bench.call('benchSaved');
    project.value = await bench.call('bench');
  });
