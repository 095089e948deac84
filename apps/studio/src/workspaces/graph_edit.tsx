// What of a graph's shape can be changed: conditions of transitions, transitions, states.
import { useState } from 'preact/hooks';
import { addState, addTransition, edit, editAll, fixed, graph, part, removeState, removeTransition, shownMachine, written } from '../graph';
import { facts as character } from '../session';
import type { Json } from '../graph_file';
import type { GraphMachine, GraphTransition } from '../engine/messages';
import { Choose, Section } from '../ui/controls';
import { EditField } from '../ui/edit_field';

const k_operators = ['>', '>=', '<', '<=', '==', '!='];
const spoken = (name: string) => name.replaceAll('_', ' ');
type Condition = Record<string, Json>;

const k_kinds = [
  { value: 'parameter', label: 'a parameter is' },
  { value: 'trigger', label: 'a trigger is pulled' },
  { value: 'elapsed_s', label: 'it has lasted' },
  { value: 'remaining_s', label: 'its clip ends in' },
];

/** One of a kind as it begins; null where the graph has nothing for it. */
function fresh(kind: string): Condition | null {
  const { parameters } = graph.value!;
  if (kind === 'elapsed_s' || kind === 'remaining_s') return { [kind]: kind === 'elapsed_s' ? 1 : 0.2 };
  const fits = parameters.find((each) => (each.kind === 'trigger') === (kind === 'trigger'));
  if (!fits) return null;
  return kind === 'trigger' ? { trigger: fits.name } : { parameter: fits.name, '>': (fits.low + fits.high) / 2 };
}

function ConditionRow({ condition, place }: { condition: Condition; place: string }) {
  const kind = Object.keys(condition).find((key) => k_kinds.some((each) => each.value === key));
  const { parameters } = graph.value!;
  const replace = (next: Condition) => void edit(place, next).then(part);
  const names = (triggers: boolean) =>
    parameters.filter((each) => (each.kind === 'trigger') === triggers).map(({ name }) => ({ value: name, label: spoken(name) }));
  const operator = k_operators.find((each) => each in condition);
  return (
    <li class="condition">
      {kind === undefined ? <span>{JSON.stringify(condition)}</span> : (
        <Choose label="When" choices={k_kinds.filter(({ value }) => value === kind || fresh(value))} value={kind} onChange={(next) => replace(fresh(next)!)} />
      )}
      {kind === 'parameter' && (
        <>
          <Choose label="Parameter" choices={names(false)} value={String(condition['parameter'])} onChange={(name) => replace({ ...condition, parameter: name })} />
          <Choose label="Is" choices={k_operators.map((each) => ({ value: each, label: each }))} value={operator ?? '>'} onChange={(next) => replace({ parameter: condition['parameter']!, [next]: condition[operator ?? '>'] ?? 0 })} />
          {operator && <EditField label="than" value={Number(condition[operator])} pointer={`${place}/${operator}`} />}
        </>
      )}
      {kind === 'trigger' && <Choose label="Trigger" choices={names(true)} value={String(condition['trigger'])} onChange={(name) => replace({ trigger: name })} />}
      {(kind === 'elapsed_s' || kind === 'remaining_s') && <EditField label="seconds" value={Number(condition[kind])} pointer={`${place}/${kind}`} />}
      <button type="button" class="small" aria-label="Remove this condition" title="Remove this condition" onClick={() => void editAll([{ at: place }], place).then(part)}>×</button>
    </li>
  );
}

/** Conditions, which must all hold. */
export function Conditions({ transition }: { transition: GraphTransition }) {
  const place = `${transition.pointer}/when`, all = written(place) as Condition[] | undefined;
  if (fixed.value) return null;
  const add = () => {
    const next = fresh('elapsed_s')!;
    void (all ? edit(`${place}/-`, next) : edit(place, [next])).then(part);
  };
  return (
    <fieldset class="conditions">
      <legend>It runs when {(all?.length ?? 0) > 1 ? 'all of these hold' : 'this holds'}</legend>
      <ul>{(all ?? []).map((condition, i) => <ConditionRow key={`${transition.name}${i}`} condition={condition} place={`${place}/${i}`} />)}</ul>
      <span class="pair">
        <button type="button" class="small" onClick={add}>Add a condition</button>
        <button type="button" class="small" onClick={() => void removeTransition(transition)}>Remove the transition</button>
      </span>
    </fieldset>
  );
}

/** What a state can play: "node:NAME" or "clip:NAME". */
function playable(): { label: string; choices: { value: string; label: string }[] }[] {
  const nodes = Object.keys((written('/nodes') ?? {}) as object).filter((name) => `/nodes/${name}` !== graph.value!.machines[shownMachine.value]?.path);
  const listed = (kind: string, names: string[]) => names.map((name) => ({ value: `${kind}:${name}`, label: spoken(name) }));
  return [
    { label: 'Nodes of the graph', choices: listed('node', nodes) },
    { label: 'Clips', choices: listed('clip', character.value?.clipNames ?? []) },
  ];
}

export function ShapeSection({ machine }: { machine: GraphMachine }) {
  const [from, setFrom] = useState(''), [to, setTo] = useState(''), [plays, setPlays] = useState(''), [gone, setGone] = useState('');
  if (fixed.value) return <Section title="States"><p class="note">{fixed.value}</p></Section>;
  const names = machine.states.map(({ name }) => name), states = names.map((name) => ({ value: name, label: spoken(name) }));
  const first = names.includes(from) ? from : names[0]!, last = names.includes(to) ? to : (names.find((name) => name !== first) ?? names[0]!);
  const choices = playable(), all = choices.flatMap((each) => each.choices.map(({ value }) => value));
  const chosen = all.includes(plays) ? plays : (all[0] ?? '');
  const state = names.includes(gone) ? gone : names.at(-1)!;
  const [kind, ...rest] = chosen.split(':');
  const wanted = rest.join(':');
  return (
    <Section title="States and transitions">
      <div class="shape">
        <Choose label="From" choices={[...states, { value: 'any', label: 'any' }]} value={from === 'any' ? from : first} onChange={setFrom} />
        <Choose label="To" choices={states} value={last} onChange={setTo} />
        <button type="button" class="small" disabled={from !== 'any' && first === last} onClick={() => void addTransition(machine, from === 'any' ? from : first, last)}>Add transition</button>
      </div>
      <div class="shape">
        <Choose label="New state plays" groups={choices} value={chosen} onChange={setPlays} />
        <button type="button" class="small" disabled={chosen === ''} onClick={() => void addState(machine, kind === 'node' ? { node: wanted } : { clip: wanted })}>Add state</button>
      </div>
      <div class="shape">
        <Choose label="State" choices={states} value={state} onChange={setGone} />
        <button type="button" class="small" disabled={names.length < 2} title="With its transitions" onClick={() => void removeState(machine, names.indexOf(state))}>Remove state</button>
      </div>
    </Section>
  );
}
