// The gait that is shaped: what is asked for, kept as plain data, and what the engine makes of it.
import { batch, signal } from '@preact/signals';
import { changeBody, engine, fail, showNewGround, showsGait, take, terrain } from './session';
import type { GaitFacts, GaitParameter, GaitPlayed, RigFacts } from './engine/messages';
import { gaitWork, type GaitWork } from './settings';
import { Undo } from './undo';

const k_first_gait = 'bhatti2017';
const k_measure_after_ms = 150; // without another change

export const gaits = signal<{ name: string; help: string; fitted: boolean }[]>([]);
export const rigs = signal<RigFacts[]>([]);
export const gait = signal<GaitFacts | null>(null);
export const played = signal<GaitPlayed | null>(null);
/** Of what it does, one after the other. */
export const curves = signal(new Float32Array(0));
/** What is wrong with what is asked for as it stands; empty: nothing. */
export const complaint = signal('');
const undo = new Undo<GaitWork>();
export const canUndo = undo.canUndo, canRedo = undo.canRedo;
export const part = () => undo.part();

/** What the engine plays. */
let read: Pick<GaitWork, 'name' | 'text'> | null = null;
let worn: GaitWork['rig'] = null;
/** Nothing is left of either: somebody else has come on the stage. */
let isAnew = false;

const words = (error: unknown) => (error instanceof Error ? error.message : String(error));

/** Values by name outlast a change of the text. */
const valuesOf = (known: { parameters: readonly { name: string; initial: number }[] }, values: Record<string, number>) =>
  known.parameters.map((each) => values[each.name] ?? each.initial);

let working = false;
let following = Promise.resolve();
/** Has the engine do what is in `gaitWork`. The last change wins: while one is on its way, others may have come. */
function follow(): Promise<void> {
  if (!working) following = catchUp();
  return following;
}

async function catchUp(): Promise<void> {
  working = true;
  for (let tried: GaitWork | null = null; (tried !== gaitWork.value || isAnew) && showsGait(); ) {
    tried = gaitWork.value;
    if (isAnew) read = worn = null;
    isAnew = false;
    try {
      if (tried) await make(tried);
      complaint.value = '';
    } catch (error) {
      complaint.value = words(error);
    }
  }
  working = false;
  clearTimeout(measuring);
  measuring = window.setTimeout(() => void measure(), k_measure_after_ms);
}

let measuring = 0;

/** A slider that is dragged moves the character at once; what it then does is measured when the hand rests. */
async function measure(): Promise<void> {
  if (working || !showsGait() || complaint.value !== '') return;
  try {
    played.value = await engine.call('gaitPlayed');
  } catch (error) {
    complaint.value = words(error);
  }
}

async function make(work: GaitWork): Promise<void> {
  const isNew = read === null || work.text !== read.text || (work.text === null && work.name !== read.name);
  if (isNew) {
    gait.value = await (work.text === null ? engine.call('gaitFitted', work.name) : engine.call('gaitRead', work.text));
    read = { name: work.name, text: work.text };
  }
  await wear(work.rig);
  await play(work);
  // Another gait may have other curves.
  if (isNew) played.value = await engine.call('gaitPlayed');
}

async function wear(rig: GaitWork['rig']): Promise<void> {
  if (rig === worn) return;
  const template = rigs.value.find((each) => each.name === rig?.name);
  const values = rig && template ? valuesOf(template, rig.values) : [];
  const made = await changeBody(() => engine.call('gaitRig', rig?.name ?? '', values), ({ shown }) => shown);
  gait.value = made.gait;
  worn = rig;
}

async function play(work: GaitWork): Promise<void> {
  const known = gait.value!;
  const speed = work.speed ?? known.speed?.own ?? 0, turn = work.turn ?? known.turn?.own ?? 0;
  const made = await engine.call('gaitPlay', valuesOf(known, work.values), speed, turn, work.slope);
  batch(() => {
    curves.value = made.curves as Float32Array<ArrayBuffer>;
    if (made.ground) terrain.value = made.ground;
    take(made.frame); // it is seen at once
  });
}

/** `label`: changes that follow each other under one are one step of undo. */
export function change(label: string, some: Partial<GaitWork>): void {
  const now = gaitWork.value;
  if (!now) return;
  undo.keep(now, label);
  gaitWork.value = { ...now, ...some };
  void follow();
}

/** The body is being shaped, not how it goes. */
export const shapesBody = signal(false);

/** A value of the body's template. */
export function shape(name: string, value: number): void {
  const rig = gaitWork.value?.rig;
  if (rig) change(`rig value ${name}`, { rig: { ...rig, values: { ...rig.values, [name]: value } } });
}

/** Of what changes a parameter by hand. */
export const stepOf = ({ low, high, group }: GaitParameter) =>
  group === 'Joints' ? 1 : 10 ** Math.floor(Math.log10(Math.max(high - low, 1e-6) / 100));

function go(to: GaitWork | undefined): void {
  if (!to) return;
  gaitWork.value = to;
  void follow();
}

export const stepBack = () => gaitWork.value && go(undo.undo(gaitWork.value));
export const stepAhead = () => gaitWork.value && go(undo.redo(gaitWork.value));

/** Undo by keys, but where a text has its own. */
export function gaitKeys(event: KeyboardEvent): void {
  if (!(event.ctrlKey || event.metaKey) || (event.target as HTMLElement).closest('textarea')) return;
  const key = event.key.toLowerCase();
  if (key !== 'z' && key !== 'y') return;
  event.preventDefault();
  if (key === 'y' || event.shiftKey) stepAhead();
  else stepBack();
}

const isFitted = (name: string) => gaits.value.some((each) => each.name === name && each.fitted);

let chosen = '';
/** Another gait on the same body. Between fitted gaits a personality stays: they have the same sliders. */
export async function choose(name: string): Promise<void> {
  chosen = name;
  try {
    const text = isFitted(name) ? null : await engine.call('gaitSource', name);
    if (name !== chosen) return; // meanwhile another one is
    const before = gaitWork.value;
    const values = text === null && before?.text === null ? before.values : {};
    const next: GaitWork = { name, text, values, speed: null, turn: null, slope: 0, rig: before?.rig ?? null };
    undo.part();
    if (before) change(`gait ${name}`, next);
    else gaitWork.value = next;
  } catch (error) {
    fail('This gait cannot be shown', error);
  }
}

/** All parameters at once. */
export function setValues(label: string, values: readonly number[]): void {
  const { parameters } = gait.value!;
  const changed = parameters.flatMap(({ name, initial }, i) => (values[i] === initial ? [] : [[name, values[i]!] as const]));
  change(label, { values: Object.fromEntries(changed) });
}

/** The sliders that are not at their defaults, as a file of personalities has them. */
export function personality(work: GaitWork): string {
  const mine: Record<string, number | Record<string, number>> = {};
  for (const { name, initial } of gait.value?.parameters ?? []) {
    const value = work.values[name] ?? initial, dot = name.indexOf('.');
    if (value === initial) continue;
    if (dot < 0) mine[name] = value;
    else ((mine[name.slice(0, dot)] ??= {}) as Record<string, number>)[name.slice(dot + 1)] = value;
  }
  return `${JSON.stringify({ mine }, null, 2)}\n`;
}

const k_type_pause_ms = 250;
/** What is being written and not read yet. */
let draft: string | null = null;
let pausing = 0;

/** A text is read when its writer pauses, or goes. */
export function typed(text: string): void {
  draft = text;
  clearTimeout(pausing);
  pausing = window.setTimeout(readDraft, k_type_pause_ms);
}

export function readDraft(): void {
  if (draft === null) return;
  const text = draft;
  draft = null;
  void write(text);
}
addEventListener('pagehide', readDraft);

let writes = 0;
/** What was written: expressions, or a personality. */
async function write(text: string): Promise<void> {
  const before = gaitWork.value, mine = ++writes;
  if (before?.text !== null) {
    change('text', { text });
    return;
  }
  try {
    const values = await engine.call('gaitPersonality', text);
    // What was changed meanwhile is newer.
    if (mine === writes && gaitWork.value === before) setValues('text', values);
  } catch (error) {
    if (mine === writes) complaint.value = words(error);
  }
}

/** Puts the gait that was worked on last on the stage, or the first one. */
export async function loadGait(): Promise<void> {
  try {
    if (gaits.value.length === 0) [gaits.value, rigs.value] = await Promise.all([engine.call('gaits'), engine.call('rigs')]);
    if (!gaitWork.value) await choose(k_first_gait);
    isAnew = true;
    await follow();
    if (!gait.value || complaint.value !== '') {
      // What was kept cannot be done as it stands: there is something to see meanwhile.
      gait.value = await engine.call('gaitRead', await engine.call('gaitSource', k_first_gait));
      await play({ name: k_first_gait, text: '', values: {}, speed: null, turn: null, slope: 0, rig: null });
    }
    played.value = await engine.call('gaitPlayed');
    await showNewGround();
  } catch (error) {
    fail('The character cannot go in gaits', error);
  }
}
