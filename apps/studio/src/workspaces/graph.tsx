// Graph: what the character plays and why, while it plays; its parameters as controls, its transitions to be shaped.
import { useEffect, useRef, useState } from 'preact/hooks';
import {
  asked, canRedo, canUndo, complaint, edit, fixed, graph, live, openFirstGraph, openFromFolder, openGraph, part, saveInFolder,
  setParameter, shownMachine, shownTransition, stepAhead, stepBack,
} from '../graph';
import { graphsInFolder, isServed } from '../graph_file';
import { download } from '../download';
import { graphFile, graphText } from '../settings';
import type { GraphParameter } from '../engine/messages';
import { Choose, Section, Segmented, Slider, Toggle } from '../ui/controls';
import { Curve } from '../ui/curve';
import { EditField } from '../ui/edit_field';
import { BlendTree, MachineMap } from '../ui/graph_map';
import { Conditions, ShapeSection } from './graph_edit';

const k_kinds = [
  { value: 'feather' as const, label: 'Feather', hint: 'Both play, and one fades into the other' },
  { value: 'inertialize' as const, label: 'Inertialize', hint: 'The new one plays alone; what the old pose was ahead of it dies away' },
];
const spoken = (name: string) => name.replaceAll('_', ' ');

function Parameter({ parameter, index }: { parameter: GraphParameter; index: number }) {
  const { name, kind, low, high, initial, unit } = parameter;
  const value = asked.value[name] ?? initial, pointer = `/parameters/${name.replaceAll('~', '~0').replaceAll('/', '~1')}`;
  if (kind === 'trigger') return <button type="button" onClick={() => setParameter(index, 1)}>{spoken(name)}</button>;
  if (kind === 'flag') return <Toggle label={spoken(name)} on={value > 0.5} onChange={(on) => setParameter(index, on ? 1 : 0)} />;
  return (
    <div>
      <Slider label={spoken(name)} hint={`Now ${(live.value?.parameters[index] ?? value).toFixed(2)}`} unit={unit} value={value} low={low} high={high} step={10 ** Math.floor(Math.log10((high - low) / 100))} initial={initial} onInput={(wanted) => setParameter(index, wanted)} />
      <details>
        <summary>In the file</summary>
        <div class="fields">
          <EditField label="low" value={low} pointer={`${pointer}/low`} />
          <EditField label="high" value={high} pointer={`${pointer}/high`} />
          <EditField label="initial" value={initial} pointer={`${pointer}/initial`} />
          <EditField label="rate per s" value={parameter.rate} pointer={`${pointer}/rate_per_s`} />
        </div>
      </details>
    </div>
  );
}

function TransitionSection() {
  const machine = graph.value!.machines[shownMachine.value];
  const index = shownTransition.value, transition = machine?.transitions[index];
  if (!machine || !transition) return null;
  const state = (at: number) => (at < 0 ? 'any state' : spoken(machine.states[at]!.name));
  const now = live.value?.machines[shownMachine.value];
  const share = () => {
    const running = live.value?.machines[shownMachine.value];
    return running?.transition === index ? Math.min(running.elapsed / Math.max(transition.seconds, 1e-3), 1) : 0;
  };
  const curve = graph.value!.curves.find((each) => each.name === transition.curve);
  return (
    <Section title="Transition">
      <Choose
        label="Shown"
        choices={machine.transitions.map((each, i) => ({ value: String(i), label: spoken(each.name) }))}
        value={String(index)}
        onChange={(value) => (shownTransition.value = Number(value))}
      />
      <p class="note">
        From {state(transition.from)} to {state(transition.to)}, when {transition.when}.{now?.transition === index ? ' It runs.' : ''}
      </p>
      <Conditions transition={transition} />
      <Slider label="Takes" unit="s" value={transition.seconds} low={0} high={Math.max(3, transition.seconds)} step={0.05} initial={0.2} onInput={(seconds) => void edit(`${transition.pointer}/seconds`, seconds)} onDone={part} />
      <Segmented label="Kind" choices={k_kinds} value={transition.kind} onChange={(kind) => void edit(`${transition.pointer}/kind`, kind).then(part)} />
      {transition.kind === 'feather' && (
        <>
          <Choose
            label="Curve"
            choices={graph.value!.curves.map(({ name }) => ({ value: name, label: spoken(name) }))}
            value={transition.curve}
            onChange={(name) => void edit(`${transition.pointer}/curve`, name).then(part)}
          />
          {curve && <Curve values={curve.values} unit="" at={share} />}
        </>
      )}
    </Section>
  );
}

/** One graph, which may extend others of them. */
async function openFiles(files: File[]): Promise<void> {
  const texts = new Map(await Promise.all(files.map(async (file): Promise<[string, string]> => [file.name, await file.text()])));
  const extended = new Set([...texts.values()].map((text) => /"extends"\s*:\s*"(?:[^"]*\/)?([^"/]*)"/.exec(text)?.[1]));
  const first = [...texts].find(([name]) => !extended.has(name)) ?? [...texts][0];
  if (first) await openGraph(first[1], null, texts);
}

/** Graphs of the folder that is served. */
function FolderGraphs() {
  const [names, setNames] = useState<string[]>([]);
  const look = () => void graphsInFolder().then(setNames, () => setNames([]));
  useEffect(look, [graphFile.value.name]);
  return (
    <>
      {names.length > 0 && (
        <Choose label="In the folder" choices={[{ value: '', label: 'choose one' }, ...names.map((name) => ({ value: name, label: name }))]} value={graphFile.value.name ?? ''} onChange={(name) => void (name && openFromFolder(name))} />
      )}
      <button type="button" disabled={fixed.value !== ''} title={fixed.value} onClick={() => void saveInFolder()}>Save in the folder</button>
    </>
  );
}

function OpenGraph() {
  const input = useRef<HTMLInputElement>(null);
  return (
    <>
      <button type="button" onClick={() => input.current!.click()} title="A graph file (docs/graphs.md) for this character">Open…</button>
      <input
        ref={input}
        class="hidden"
        type="file"
        multiple
        accept=".json,application/json"
        tabIndex={-1}
        aria-hidden="true"
        aria-label="Graph file"
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          event.currentTarget.value = '';
          void openFiles(files);
        }}
      />
    </>
  );
}

export function GraphPanel() {
  const known = graph.value;
  if (!known) return <Section title="Graph">{<p>{complaint.value || 'One moment…'}</p>}</Section>;
  return (
    <>
      <Section
        title="Parameters"
        aside={
          <span class="pair">
            <button type="button" class="small" disabled={!canUndo.value} onClick={() => void stepBack()} title="Ctrl+Z">Undo</button>
            <button type="button" class="small" disabled={!canRedo.value} onClick={() => void stepAhead()} title="Ctrl+Shift+Z">Redo</button>
          </span>
        }
      >
        {known.parameters.map((parameter, i) => <Parameter key={parameter.name} parameter={parameter} index={i} />)}
      </Section>
      <TransitionSection />
      {known.machines[shownMachine.value] && <ShapeSection machine={known.machines[shownMachine.value]!} />}
      <Section title="File">
        <p class="note">{fixed.value || 'An edit changes its place in the file and no other byte.'}</p>
        {isServed && <FolderGraphs />}
        <span class="pair">
          <OpenGraph />
          <button type="button" onClick={() => download(`${known.name}.json`, graphText.value ?? '')}>{isServed ? 'Download' : 'Save'}</button>
          <button type="button" onClick={() => void openFirstGraph()} title="The graph that the studio begins with">First one</button>
        </span>
      </Section>
    </>
  );
}

export function GraphDesk() {
  const known = graph.value;
  if (!known) return <div class="graph-desk" />;
  const machine = known.machines[shownMachine.value];
  return (
    <div class="graph-desk">
      {machine && (
        <div class="map-box">
          {known.machines.length > 1 && (
            <Choose label="Machine" choices={known.machines.map(({ path }, i) => ({ value: String(i), label: path.split('/').at(-1)! }))} value={String(shownMachine.value)} onChange={(value) => { shownMachine.value = Number(value); shownTransition.value = 0; }} />
          )}
          <MachineMap machine={machine} live={live.value} index={shownMachine.value} chosen={shownTransition.value} onChoose={(i) => (shownTransition.value = i)} />
        </div>
      )}
      <div class="tree-box" tabIndex={0} aria-label="Blend tree"><BlendTree graph={known} live={live.value} /></div>
      <p id="graph-complaint" role="status" class={complaint.value ? 'bad' : ''}>
        {complaint.value || known.warnings[0] || 'Arrows are transitions; choose one to shape it. Thick branches have weight.'}
      </p>
    </div>
  );
}
