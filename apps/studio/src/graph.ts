// The graph that the character plays: its text, which is all that is kept, what the engine makes of it, and what happens.
import { batch, effect, signal } from '@preact/signals';
import type { GraphFacts, GraphLive } from './engine/messages';
import k_first_graph from './graphs/stroll.json?raw';
import { engine, fail, frameCount, ownShow, showNewGround, showsGraph, type Show } from './session';
import { graphText } from './settings';
import { Undo } from './undo';

const k_look_ms = 80;
export const k_graph_history_s = 8;
export { k_first_graph };

export const graph = signal<GraphFacts | null>(null);
export const live = signal<GraphLive | null>(null);
/** What is asked of the parameters, by name: they outlast an edit. */
export const asked = signal<Record<string, number>>({});
/** Why the last edit was not taken; empty: it was. */
export const complaint = signal('');
/** The machine that is looked at: an index. */
export const shownMachine = signal(0);
export const shownTransition = signal(0);
const undo = new Undo<string>();
export const canUndo = undo.canUndo, canRedo = undo.canRedo;
export const part = () => undo.part();

/** The last seconds: all weights, and what happened. */
export const past = { moments: [] as GraphLive[], events: [] as { name: string; time: number }[] };

function forget(): void {
  past.moments.length = past.events.length = 0;
}

/** Has the engine play a text, which becomes the graph's if it can. */
async function take(text: string): Promise<void> {
  const facts = await engine.call('graphRead', text);
  batch(() => {
    graph.value = facts;
    graphText.value = text;
    complaint.value = '';
    shownMachine.value = Math.min(shownMachine.value, Math.max(facts.machines.length - 1, 0));
    shownTransition.value = Math.min(shownTransition.value, Math.max((facts.machines[shownMachine.value]?.transitions.length ?? 0) - 1, 0));
  });
}

/** Sets all parameters to what is asked for, or is their initial value: a graph that has got other nodes begins anew. */
async function tell(): Promise<void> {
  const { parameters } = graph.value!;
  const wanted = Object.fromEntries(parameters.filter((each) => each.kind !== 'trigger').map((each) => [each.name, asked.value[each.name] ?? each.initial]));
  asked.value = wanted;
  for (const [index, { name }] of parameters.entries()) if (name in wanted) await engine.call('graphSet', index, wanted[name]!);
}

let chain = Promise.resolve();
/** One change after the other, each upon what the last one left. */
function then(change: () => Promise<void>): Promise<void> {
  chain = chain.then(change).catch((error: unknown) => {
    complaint.value = error instanceof Error ? error.message : String(error);
  });
  return chain;
}

/** Another value in the file, and nothing else of it. What the graph cannot be with it is not taken. */
export const edit = (pointer: string, value: unknown, label = pointer) =>
  then(async () => {
    const before = graphText.value ?? k_first_graph;
    await take(await engine.call('jsonEdit', before, pointer, JSON.stringify(value)));
    await tell();
    undo.keep(before, label);
  });

function go(step: (now: string) => string | undefined): Promise<void> {
  return then(async () => {
    const text = step(graphText.value ?? k_first_graph);
    if (text === undefined) return;
    await take(text);
    await tell();
  });
}
export const stepBack = () => go((now) => undo.undo(now));
export const stepAhead = () => go((now) => undo.redo(now));

/** Another graph altogether. */
export const openGraph = (text: string) =>
  then(async () => {
    const before = graphText.value ?? k_first_graph;
    await take(text);
    undo.part();
    undo.keep(before, 'open');
    asked.value = {};
    forget();
    await tell();
    await showNewGround();
  });
export const openFirstGraph = () => openGraph(k_first_graph);

export function setParameter(index: number, value: number): void {
  const parameter = graph.value?.parameters[index];
  if (!parameter) return;
  if (parameter.kind !== 'trigger') asked.value = { ...asked.value, [parameter.name]: value };
  void engine.call('graphSet', index, value);
}

/** Puts the graph that was worked on last on the stage, or the first one. */
export const loadGraph = () =>
  then(async () => {
    try {
      try {
        await take(graphText.value ?? k_first_graph);
      } catch (error) {
        if (graphText.value === null) throw error;
        // What was kept is of another character, say: there is something to see meanwhile.
        await take(k_first_graph);
        complaint.value = `The graph that was here cannot be played by this character: ${error instanceof Error ? error.message : String(error)}`;
      }
      forget();
      await tell();
      await showNewGround();
      await look();
    } catch (error) {
      fail('The character cannot play a graph', error);
    }
  });

/** Undo by keys. */
export function graphKeys(event: KeyboardEvent): void {
  if (!(event.ctrlKey || event.metaKey) || (event.target as HTMLElement).closest('textarea, input[type=number]')) return;
  const key = event.key.toLowerCase();
  if (key !== 'z' && key !== 'y') return;
  event.preventDefault();
  void (key === 'y' || event.shiftKey ? stepAhead() : stepBack());
}

let looking = false;
async function look(): Promise<void> {
  if (looking || !graph.value) return;
  looking = true;
  try {
    const now = await engine.call('graphLive');
    if (now.time < (past.moments.at(-1)?.time ?? 0)) forget();
    past.moments.push(now);
    for (const { event, time } of now.events) past.events.push({ name: graph.value.events[event] ?? '', time });
    while (past.moments[0]!.time < now.time - k_graph_history_s) past.moments.shift();
    while (past.events.length > 0 && past.events[0]!.time < now.time - k_graph_history_s) past.events.shift();
    live.value = now;
  } catch {
    // Another character is on the stage and has no graph yet.
  }
  looking = false;
}

let last = 0;
effect(() => {
  void frameCount.value;
  const now = performance.now();
  if (!showsGraph() || now - last < k_look_ms) return;
  last = now;
  void look();
});

export const graphShow: Show = {
  ...ownShow,
  async restart() {
    forget();
    await ownShow.restart();
    await look();
  },
  async step(frames, parts) {
    await ownShow.step(frames, parts);
    await look();
  },
};
