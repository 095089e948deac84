// The one character on the one stage, and the clock that makes it move.
import { batch, signal } from '@preact/signals';
import { EngineClient } from './engine/engine';
import type { CharacterFacts, CharacterMesh, FigureValue, FootMode, Shown, Steering, TerrainMesh } from './engine/messages';
import { course, gradeDeg, mode, patrolSpeed, slowness, workspace } from './settings';
import { History } from './history';

/** A failure in words, and what the user can do about it. */
export interface Problem {
  title: string;
  text: string;
  /** The studio cannot go on: it takes the whole window. */
  fatal?: boolean;
  /** Nothing went wrong: something is to be decided. */
  question?: boolean;
  actions: { label: string; run: () => void }[];
}

export const facts = signal<CharacterFacts | null>(null);
export const mesh = signal<CharacterMesh | null>(null);
export const terrain = signal<TerrainMesh | null>(null);
export const figures = signal<FigureValue[] | null>(null);
export const playing = signal(true);
/** False: it goes up and down the course by itself. */
export const steered = signal(false);
export const problem = signal<Problem | null>(null);
export const notice = signal('');
/** Changes with every frame that arrives. */
export const frameCount = signal(0);
export const history = new History();

export let frame = new Float32Array(0);

const k_frame_s = 1 / 60;
const k_most_frames = 6; // at a time: a page that was asleep does not catch up
const k_metrics_every_s = 0.5;
const k_said_ms = 5000;

const reload = { label: 'Reload the page', run: () => location.reload() };
const dismiss = { label: 'Dismiss', run: () => (problem.value = null) };

export function fail(title: string, error: unknown): void {
  const text = error instanceof Error ? error.message : String(error);
  problem.value = { title, text, actions: [dismiss] };
}

export function failForGood(title: string, text: string): void {
  problem.value = { title, text, fatal: true, actions: [reload] };
}

export const engine = new EngineClient((message) => {
  playing.value = false;
  failForGood('The engine stopped', `${message}. Your choices are kept; reloading starts it again.`);
});

let silence = 0;

export function say(text: string): void {
  notice.value = text;
  clearTimeout(silence);
  silence = window.setTimeout(() => (notice.value = ''), k_said_ms);
}

/** Frames of who was on the stage do not fit who is: while it changes nobody moves, and changes come one after the other. */
let staging = 0;
let lastChange: Promise<unknown> = Promise.resolve();

function onStage<Result>(change: () => Promise<Result>): Promise<Result> {
  ++staging;
  const changed = lastChange.then(change).finally(() => --staging);
  lastChange = changed.catch(() => undefined);
  return changed;
}

/** What has changed is shown with its first frame, not before. */
async function reveal(change: () => void): Promise<void> {
  const arrived = await engine.advance(0, 1, asked);
  batch(() => {
    change();
    take(arrived);
  });
}

/** Its walk begins anew: figures of the one before are not its own. */
function beginWalk(): void {
  history.clear();
  forgetFigures();
}

/** Changes with every character that is opened. */
export const opened = signal(0);

/** `goesOn`: on the ground that is shown, from where the one before is. */
const open = (load: () => Promise<Shown>, goesOn: () => boolean) =>
  onStage(async () => {
    const character = await load();
    if (!character.facts.courses.includes(course.value)) course.value = 'hills';
    await engine.call('setMode', mode.value);
    const name = goesOn() ? shown : course.value;
    const ground = goesOn() ? null : await engine.call('setCourse', name, gradeDeg.value);
    await reveal(() => {
      shown = name;
      facts.value = character.facts;
      mesh.value = character.mesh;
      if (ground) terrain.value = ground;
      beginWalk();
      opened.value++;
    });
  });

/** Does what may change whose body is seen. */
export const changeBody = <Result>(change: () => Promise<Result>, shownBy: (result: Result) => Shown | null) =>
  onStage(async () => {
    const result = await change(), next = shownBy(result);
    if (next)
      await reveal(() => {
        facts.value = next.facts;
        mesh.value = next.mesh;
      });
    return result;
  });

/** It goes by its own clips again, on its own body. */
export const stopGuests = () => changeBody(() => engine.call('gaitStop'), (shown) => shown);

export const openDefault = () => open(() => engine.call('openDefault'), () => false);
/** Who is to be on the stage from now on, in the place of who is there. */
export const openPack = (bytes: Uint8Array) => open(() => engine.call('openPack', bytes), () => shown !== '');

/** Kept at once, so that a reload finds it, and taken back where it cannot be walked. */
export async function setCourse(name: string, grade: number): Promise<void> {
  const before = { name: course.value, grade: gradeDeg.value };
  const keep = (chosen: typeof before) => batch(() => {
    course.value = chosen.name;
    gradeDeg.value = chosen.grade;
  });
  keep({ name, grade });
  const isStillWanted = () => course.value === name && gradeDeg.value === grade;
  if (!(await showCourse(name, grade)) && isStillWanted()) keep(before);
}

let shown = '';
export const shownCourse = () => shown;

/** Walks another course for now; what the user chose stays chosen. */
export async function showCourse(name: string, grade: number): Promise<boolean> {
  try {
    await onStage(async () => showGround(await engine.call('setCourse', name, grade), name));
    return true;
  } catch (error) {
    fail('This course cannot be walked', error);
    return false;
  }
}

export const showsGait = () => workspace.value === 'gait';
export const showsGraph = () => workspace.value === 'graph';
export const showsCrowd = () => workspace.value === 'crowd';

/** The engine has gone to another ground by itself: that of a gait. */
export const showNewGround = () => onStage(async () => showGround(await engine.call('ground'), ''));

const showGround = (ground: TerrainMesh, name: string) =>
  reveal(() => {
    shown = name;
    terrain.value = ground;
    beginWalk();
  });

export function setMode(wanted: FootMode): void {
  mode.value = wanted;
  forgetFigures();
  void engine.call('setMode', wanted);
}

/** What the timeline's buttons work on. */
export interface Show {
  restart: () => Promise<void>;
  /** So many frames of 1/60 s, or of a `parts`th of that, on. */
  step: (frames: number, parts: number) => Promise<void>;
  /** [s] since its start */
  seconds: () => number;
}

export const ownShow: Show = {
  restart: () =>
    onStage(async () => {
      await engine.call('restart');
      await reveal(beginWalk);
    }),
  step: (frames, parts) => onStage(async () => take(await engine.advance(frames, parts, asked))),
  seconds: () => (facts.value ? (frame[facts.value.layout.time] ?? 0) : 0),
};
let show = ownShow;

/** Another show than that of the one character; null: that again. */
export function present(other: Show | null): void {
  show = other ?? ownShow;
}

export const restart = () => show.restart();
/** On, whether it plays or not. */
export const step = (frames: number, parts = 1) => show.step(frames, parts);
export const shownSeconds = () => show.seconds();

let asked: Steering = { patrol: patrolSpeed.value };
/** What is asked for while nobody steers: that of a puck; null: it patrols, or stands. */
let held: Steering | null = null;

export function hold(request: Steering | null): void {
  held = request;
}

/** What somebody asks for now; null: nobody does. */
export function steer(request: { speed: number; lateral: number; turn: number } | null): void {
  if (request) {
    asked = request;
    steered.value = true;
  } else asked = held ?? (steered.value ? { speed: 0, lateral: 0, turn: 0 } : { patrol: patrolSpeed.value });
}

export function take(arrived: Float32Array): void {
  frame = arrived as Float32Array<ArrayBuffer>;
  if (facts.value) history.add(arrived, facts.value.layout);
  frameCount.value++;
}

let owed = 0;
let sinceMetrics = 0;
let measuring = false;

/** Called once a picture, `seconds` after the last. */
export function tick(seconds: number): void {
  if (!facts.value || !playing.value || staging > 0) return;
  // A display of sixty pictures a second, give or take, shows one frame a picture: no frame is doubled or left out.
  owed += Math.abs(seconds - k_frame_s) < 0.25 * k_frame_s ? 1 : Math.min(seconds / k_frame_s, k_most_frames);
  const frames = Math.min(Math.floor(owed + 1e-6), k_most_frames);
  if (frames < 1 || engine.busy) {
    owed = Math.min(owed, k_most_frames);
    return;
  }
  owed -= frames;
  void engine.advance(frames, slowness.value, asked).then(take);
  sinceMetrics += (frames * k_frame_s) / slowness.value;
  if (sinceMetrics < k_metrics_every_s || measuring) return;
  sinceMetrics = 0;
  void measure();
}

/** Of which walk the figures are: a measuring under way may be of the one before. */
let walk = 0;

function forgetFigures(): void {
  ++walk;
  figures.value = null;
}

async function measure(): Promise<void> {
  measuring = true;
  const measured = walk;
  try {
    const found = await engine.call('metrics');
    if (measured === walk) figures.value = found;
  } catch (error) {
    fail('The walk could not be measured', error);
  }
  measuring = false;
}

export async function boot(open: () => Promise<void>): Promise<void> {
  try {
    await engine.call('start');
  } catch (error) {
    failForGood(
      'The engine cannot run here',
      `It needs a browser with WebAssembly SIMD and exceptions: Chrome or Edge from 95, Firefox from 100, Safari from ` +
        `16.4. (${error instanceof Error ? error.message : String(error)})`,
    );
    return;
  }
  await open();
}

