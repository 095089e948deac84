// The graph that the character plays: its text, which is all that is kept, what the engine makes of it, and what happens.
import { batch, computed, effect, signal } from '@preact/signals';
import type { GraphFacts, GraphLive, GraphMachine, GraphTransition } from './engine/messages';
import k_first_graph from './graphs/stroll.json?raw';
import { escaped, freeName, hasChanged, inLine, readFromFolder, valueAt, watchFile, whole, writeToFolder, type Json } from './graph_file';
import { engine, fail, frameCount, ownShow, problem, say, showNewGround, showsGraph, type Show } from './session';
import { graphFile, graphText } from './settings';
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
interface Work {
  text: string;
  file: typeof graphFile.value;
}
const undo = new Undo<Work>();
const now = (): Work => ({ text: graphText.value ?? k_first_graph, file: graphFile.value });
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

/** Why it cannot be edited; empty: it can. */
export const fixed = computed(() =>
  graphFile.value.extended === null ? '' : `It extends ${graphFile.value.extended}: what it is in the end is shown here, and edited in these two files.`);

/** A place in the file that gets a value, or, without one, goes. */
export interface Edit {
  at: string;
  value?: Json;
}

/** Other values in the file, and nothing else of it. What the graph cannot be with them is not taken. */
export const editAll = (edits: readonly Edit[], label: string) =>
  then(async () => {
    if (fixed.value) throw new Error(fixed.value);
    const before = now();
    let { text } = before;
    for (const { at, value } of edits)
      text = await (value === undefined ? engine.call('jsonRemove', text, at) : engine.call('jsonEdit', text, at, inLine(value)));
    await take(text);
    await tell();
    undo.keep(before, label);
  });
export const edit = (pointer: string, value: Json, label = pointer) => editAll([{ at: pointer, value }], label);

/** What the file has at a place. */
export const written = (pointer: string) => valueAt(graphText.value ?? k_first_graph, pointer);
const keysAt = (pointer: string) => Object.keys((written(pointer) as Record<string, Json> | undefined) ?? {});

/** A state that plays a node of the file, or a clip. */
export async function addState(machine: GraphMachine, plays: { node: string } | { clip: string }): Promise<void> {
  const wanted = 'node' in plays ? plays.node : plays.clip;
  const name = freeName(wanted, machine.states.map((each) => each.name));
  const value: Json = 'node' in plays ? plays.node : { type: 'clip', clip: plays.clip };
  undo.part();
  await editAll([{ at: `${machine.path}/states/${escaped(name)}`, value }], 'state');
}

/** With all transitions from it and to it. */
export async function removeState(machine: GraphMachine, state: number): Promise<void> {
  const { name } = machine.states[state]!;
  const edits: Edit[] = machine.transitions.filter(({ from, to }) => from === state || to === state).map(({ pointer }) => ({ at: pointer }));
  if (written(`${machine.path}/initial`) === name) edits.push({ at: `${machine.path}/initial`, value: machine.states.find((each) => each.name !== name)!.name });
  undo.part();
  await editAll([...edits, { at: `${machine.path}/states/${escaped(name)}` }], 'state');
}

/** After a second, until somebody says when. */
export async function addTransition(machine: GraphMachine, from: string, to: string): Promise<void> {
  const there = keysAt(`${machine.path}/transitions`), name = freeName(`${from}_to_${to}`, there);
  const value = { from, to, seconds: 0.3, when: [{ elapsed_s: 1 }] };
  const all = `${machine.path}/transitions`;
  undo.part();
  await editAll([written(all) === undefined ? { at: all, value: { [name]: value } } : { at: `${all}/${escaped(name)}`, value }], 'transition');
  const made = graph.value?.machines[shownMachine.value]?.transitions.findIndex((each) => each.name === name) ?? -1;
  if (made >= 0) shownTransition.value = made;
}

export async function removeTransition({ pointer }: GraphTransition): Promise<void> {
  undo.part();
  await editAll([{ at: pointer }], 'transition');
}

function go(step: (from: Work) => Work | undefined): Promise<void> {
  return then(async () => {
    const to = step(now());
    if (to === undefined) return;
    await take(to.text);
    graphFile.value = to.file;
    await tell();
  });
}
export const stepBack = () => go((from) => undo.undo(from));
export const stepAhead = () => go((from) => undo.redo(from));

/** Another graph altogether. `others`: files that it may extend, by name. */
export const openGraph = (given: string, name: string | null = null, others: ReadonlyMap<string, string> = new Map()) =>
  then(async () => {
    const before = now();
    const { text, extended } = await whole(given, others);
    await take(text);
    graphFile.value = { name, extended };
    undo.part();
    undo.keep(before, 'open');
    asked.value = {};
    forget();
    await tell();
    await showNewGround();
  });
export const openFirstGraph = () => openGraph(k_first_graph);

export const openFromFolder = async (name: string) => {
  try {
    await openGraph(await readFromFolder(name), name);
  } catch (error) {
    fail(`${name} cannot be opened`, error);
  }
};

let saving = false;
/** Into the served folder; asks first where another program has written the file. */
export async function saveInFolder(): Promise<void> {
  const name = graphFile.value.name ?? `${graph.value!.name}.json`;
  const put = async () => {
    problem.value = null;
    saving = true;
    try {
      await writeToFolder(name, graphText.value ?? k_first_graph);
      graphFile.value = { ...graphFile.value, name };
      say(`Saved as ${name}.`);
    } catch (error) {
      fail(`${name} could not be saved`, error);
    } finally {
      saving = false;
    }
  };
  try {
    if (!(await hasChanged(name))) return await put();
  } catch (error) {
    fail('The folder cannot be reached', error);
    return;
  }
  problem.value = {
    title: `${name} has changed on disk`,
    question: true,
    text: 'It was written since it was opened here, or it is another graph of that name. Saving puts what you see in its place.',
    actions: [
      { label: 'Save all the same', run: () => void put() },
      openOther(name),
      { label: 'Neither', run: () => (problem.value = null) },
    ],
  };
}

const openOther = (name: string) => ({ label: 'Open what is on disk', run: () => { problem.value = null; void openFromFolder(name); } });

watchFile(() => graphFile.value.name, (name) => {
  if (!showsGraph() || saving || problem.value) return false;
  problem.value = {
    title: `${name} has changed on disk`,
    question: true,
    text: 'Another program has written it. Opening it puts it in the place of what you see; undo brings that back.',
    actions: [openOther(name), { label: 'Go on with this', run: () => (problem.value = null) }],
  };
  return true;
});

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
