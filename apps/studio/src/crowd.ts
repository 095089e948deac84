// The crowd of the character: how many there are, their clock, and what they cost.
import { batch, signal } from '@preact/signals';
import type { CrowdFacts, CrowdFrame, CrowdMesh, TerrainMesh } from './engine/messages';
import { engine, fail, frameCount, playing, type Show } from './session';
import { crowdCount, crowdFeet, crowdGround, lastingPoses, slowness } from './settings';

const k_longest_s = 0.1; // of a frame: a page that was asleep does not catch up
const k_frame_s = 1 / 60;
export const k_cost_history_s = 6;

export const crowd = signal<{ facts: CrowdFacts; mesh: CrowdMesh; ground: TerrainMesh } | null>(null);
export let texels = new Float32Array(0);
/** [s] since the start */
let clock = 0;

/** What the last seconds cost: times [s] of the page's clock, and [ms]. */
export const costs = { time: [] as number[], animation: [] as number[], rendering: [] as (number | null)[] };
export const posed = signal(0);

let made = '', making = false;
const wish = () => `${crowdCount.value} on ${crowdGround.value}`;
/** As many as were asked for, where they were. The last wish wins: while one is on its way, others may have come. */
export async function makeCrowd(anew = true): Promise<void> {
  if (anew) made = '';
  if (making) return;
  making = true;
  try {
    while (made !== wish()) {
      made = wish(); // before it is there: whoever wants it anew meanwhile is heard
      const next = await engine.call('crowd', crowdCount.value, crowdGround.value);
      clock = 0;
      texels = new Float32Array(0);
      batch(() => (crowd.value = next));
      await stepCrowd(0);
    }
  } catch (error) {
    crowdGround.value = 'flat'; // what was kept may be of another version
    fail('There is no crowd', error);
  }
  making = false;
}

let eye: [number, number] = [0, 0];
export const lookFrom = (from: [number, number]) => (eye = from);

function take(frame: CrowdFrame, seconds: number, renderingMs: number | null): void {
  texels = frame.texels as Float32Array<ArrayBuffer>;
  clock += seconds;
  const now = performance.now() / 1000;
  costs.time.push(now);
  costs.animation.push(frame.animationMs);
  costs.rendering.push(renderingMs);
  let old = 0;
  while (costs.time[old]! < now - k_cost_history_s) ++old;
  if (old > 0) for (const list of [costs.time, costs.animation, costs.rendering]) list.splice(0, old);
  batch(() => {
    posed.value = frame.posed;
    frameCount.value++;
  });
}

/** So many seconds on, whether it plays or not. */
async function stepCrowd(seconds: number): Promise<void> {
  take(await engine.advanceCrowd(seconds, eye, lastingPoses.value, crowdFeet.value), seconds, null);
}

/** Called once a picture, `seconds` after the last; `renderingMs` is what drawing cost when it was last measured. */
export function tickCrowd(seconds: number, renderingMs: number): void {
  if (!crowd.value || !playing.value || engine.crowdBusy || making) return;
  const dt = Math.min(seconds, k_longest_s) / slowness.value;
  void engine.advanceCrowd(dt, eye, lastingPoses.value, crowdFeet.value).then((frame) => take(frame, dt, renderingMs));
}

export const crowdShow: Show = {
  restart: () => makeCrowd(true),
  async step(frames, parts) {
    for (let f = 0; f < frames; ++f) await stepCrowd(k_frame_s / parts);
  },
  seconds: () => clock,
};

/** Of the last half second. */
export function medianAnimation(): number {
  const recent = costs.animation.slice(-30).sort((a, b) => a - b);
  return recent[Math.floor(recent.length / 2)] ?? 0;
}
