// What the user chose, kept across reloads.
import { effect, signal, type Signal } from '@preact/signals';
import type { FootMode } from './engine/messages';

const k_prefix = 'surefoot.studio.';

function kept<T>(name: string, initial: T, valid: (value: unknown) => boolean): Signal<T> {
  let value = initial;
  try {
    const text = localStorage.getItem(k_prefix + name);
    const stored: unknown = text === null ? initial : JSON.parse(text);
    if (valid(stored)) value = stored as T;
  } catch {
    // Nothing is kept where storage is closed to us: the default stands.
  }
  const made = signal(value);
  effect(() => {
    try {
      localStorage.setItem(k_prefix + name, JSON.stringify(made.value));
    } catch {
      // As above.
    }
  });
  return made;
}

const isFlag = (value: unknown) => typeof value === 'boolean';
const isOneOf = (...values: unknown[]) => (value: unknown) => values.includes(value);
const isNumberIn = (low: number, high: number) => (value: unknown) =>
  typeof value === 'number' && value >= low && value <= high;

export type Theme = 'system' | 'light' | 'dark';
export type Workspace = 'terrain' | 'space' | 'gait' | 'graph' | 'crowd';
export type CameraView = 'follow' | 'side' | 'front' | 'feet';
export const k_rates = [1, 2, 4, 10] as const;

export const workspace = kept<Workspace>('workspace', 'terrain', isOneOf('terrain', 'space', 'gait', 'graph', 'crowd'));
export const theme = kept<Theme>('theme', 'system', isOneOf('system', 'light', 'dark'));
export const course = kept<string>('course', 'hills', (value) => typeof value === 'string');
export const gradeDeg = kept<number>('grade', 15, isNumberIn(0, 45));
export const mode = kept<FootMode>('mode', 'surefoot', isOneOf('none', 'colvin2013', 'surefoot'));
export const patrolSpeed = kept<number>('patrolSpeed', 1.4, isNumberIn(0, 10));
/** A second lasts so many times as long: slow motion. */
export const slowness = kept<number>('slowness', 1, isOneOf(...k_rates));
export const cameraView = kept<CameraView>('camera', 'follow', isOneOf('follow', 'side', 'front', 'feet'));

/** Whether the clips that are blended are shown beside the blend. */
export const ghosts = kept('ghosts', true, isFlag);

export const overlays = {
  axes: kept('overlay.axes', false, isFlag),
  hips: kept('overlay.hips', false, isFlag),
  contacts: kept('overlay.contacts', true, isFlag),
  footholds: kept('overlay.footholds', true, isFlag),
};

export const k_most_crowd = 10000;
export const crowdCount = kept<number>('crowd', 500, (value) => isNumberIn(1, k_most_crowd)(value) && Number.isInteger(value));
/** Poses of who is far away last for several frames. */
export const lastingPoses = kept('crowd.lasting', false, isFlag);
export const crowdGround = kept<string>('crowd.ground', 'hills', (value) => typeof value === 'string');
/** Feet are laid on the ground. */
export const crowdFeet = kept('crowd.feet', true, isFlag);
export const crowdView = kept<'above' | 'among'>('crowd.view', 'above', isOneOf('above', 'among'));

/** What was made of a gait: kept, so that it survives a reload. */
export interface GaitWork {
  /** Of the bundled gait that it is, or began as. */
  name: string;
  /** Of expressions; null: it was fitted to motion and has no text. */
  text: string | null;
  /** Of its parameters that are not at their defaults. */
  values: Record<string, number>;
  /** [m/s], [deg/s] asked for; null: its own */
  speed: number | null;
  turn: number | null;
  /** [deg] uphill */
  slope: number;
  /** On whose body: that of a template, with parameters that are not at their defaults; null: the character's. */
  rig: { name: string; values: Record<string, number> } | null;
}
const isNumbers = (value: unknown) =>
  typeof value === 'object' && value !== null && Object.values(value).every(Number.isFinite);
const isAsked = (value: unknown) => value === null || Number.isFinite(value);
const isGaitWork = (value: unknown) => {
  const work = value as GaitWork | null;
  return work === null || (typeof work === 'object' && typeof work.name === 'string' &&
    (work.text === null || typeof work.text === 'string') && isNumbers(work.values) &&
    isAsked(work.speed) && isAsked(work.turn) && Number.isFinite(work.slope) &&
    (work.rig === null || (typeof work.rig === 'object' && typeof work.rig.name === 'string' && isNumbers(work.rig.values))));
};
export const gaitWork = kept<GaitWork | null>('gait', null, isGaitWork);

/** Its file in the served folder, if there is one, and what that extends. */
export const graphFile = kept<{ name: string | null; extended: string | null }>('graph.file', { name: null, extended: null }, (value) => {
  const file = value as { name?: unknown; extended?: unknown } | null;
  const isName = (each: unknown) => each === null || typeof each === 'string';
  return typeof file === 'object' && file !== null && isName(file.name) && isName(file.extended);
});

/** When files of graphs in the served folder were written last, as far as we know. */
export const graphStamps = kept<Record<string, string>>('graph.stamps', {}, (value) =>
  typeof value === 'object' && value !== null && Object.values(value).every((each) => typeof each === 'string'));

/** The graph that was worked on, as text; null: the first one. */
export const graphText = kept<string | null>('graph', null, (value) => value === null || typeof value === 'string');
