// What is looked at of the blend spaces: which of them, where the puck is, which finding.
import { batch, computed, effect, signal, untracked } from '@preact/signals';
import { project } from '../bench';
import type { Finding, Heat, SpaceFacts } from '../engine/messages';
import { heat, shownHeat } from '../bench';
import { engine, facts, fail, hold } from '../session';
import { workspace } from '../settings';
import { k_told_apart } from '../view/theme';

/** By name, so that it stays the same one when the project changes. */
const chosen = signal('');
export const puck = signal<number[]>([]);
export const weights = signal<{ clip: string; weight: number }[]>([]);
/** Id of the finding that is looked at. */
export const looked = signal('');

export const space = computed<SpaceFacts | null>(() => {
  const spaces = project.value?.spaces ?? [];
  return spaces.find(({ name }) => name === chosen.value) ?? spaces[0] ?? null;
});
export const findings = computed<Finding[]>(() =>
  (project.value?.findings ?? []).filter((each) => each.space === '' || each.space === space.value?.name),
);
export const shownMap = computed<Heat | null>(
  () => heat.value.find((each) => each.space === space.value?.name && each.title === shownHeat.value) ?? null,
);

/** A colour for every clip on the stage; clips that are blended with each other have different ones. */
export const clipColors = computed<string[]>(() => {
  const taken = new Map<string, number>();
  for (const { cells, samples } of project.value?.spaces ?? [])
    for (const { clip } of samples) {
      if (taken.has(clip)) continue;
      const beside = cells.map((cell) => cell.map((corner) => samples[corner]!.clip)).filter((clips) => clips.includes(clip)).flat();
      const used = new Set(beside.map((each) => taken.get(each)));
      const free = k_told_apart.findIndex((_, color) => !used.has(color));
      taken.set(clip, free < 0 ? taken.size % k_told_apart.length : free);
    }
  return (facts.value?.clipNames ?? []).map((clip) => k_told_apart[taken.get(clip) ?? 0]!);
});
export const colorOf = (clip: string): string => clipColors.value[facts.value?.clipNames.indexOf(clip) ?? -1] ?? 'none';

/** Somewhere inside, where more than one clip plays. */
const restingPlace = (shown: SpaceFacts): number[] =>
  shown.axes.map(({ name, low, high }) => (name === 'turn' ? 0.2 * high : low + 0.45 * (high - low)));

export function choose(name: string): void {
  batch(() => {
    chosen.value = name;
    looked.value = '';
    if (space.value) puck.value = restingPlace(space.value);
  });
}

export function place(at: number[]): void {
  puck.value = at;
}

export function look(finding: Finding): void {
  batch(() => {
    looked.value = looked.value === finding.id ? '' : finding.id;
    if (looked.value !== '' && finding.at.length === space.value?.axes.length) place(finding.at);
  });
}

/** A space that has changed keeps its puck where that still is a place. */
effect(() => {
  const shown = space.value;
  untracked(() => {
    const inside = shown?.axes.every(({ low, high }, k) => (puck.value[k] ?? Infinity) >= low && puck.value[k]! <= high);
    if (shown && !(inside && puck.value.length === shown.axes.length)) puck.value = restingPlace(shown);
  });
});

let asking = false;
/** The character goes as the puck says. Weights are those of who is on the stage: `facts` changes with it. */
effect(() => {
  const at = puck.value, shown = space.value;
  if (!facts.value || workspace.value !== 'space' || !shown || at.length !== shown.axes.length) return;
  hold({ space: shown.name, at });
  if (asking) return;
  asking = true;
  // The last place wins: while one answer is on its way, the puck may have moved on.
  void engine.call('blend', shown.name, at).then((now) => {
    weights.value = now;
    asking = false;
    if (puck.value !== at) puck.value = [...puck.value];
  }, (error: unknown) => {
    asking = false;
    fail('The weights could not be computed', error);
  });
});
