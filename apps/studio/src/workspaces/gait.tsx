// Gait: a character that goes as expressions say, its parameters as sliders, its text to edit, its curves to see.
import { batch, effect, signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { engine, fail, frame, frameCount, facts as character, showNewGround, showsGait } from '../session';
import { download } from '../download';
import type { GaitFacts, GaitParameter, GaitPlayed } from '../engine/messages';
import { gaitWork, type GaitWork } from '../settings';
import { Choose, Section, Slider } from '../ui/controls';
import { Curve } from '../ui/curve';
import { Undo } from '../undo';

const k_first_gait = 'bhatti2017';
const k_type_pause_ms = 250; // a text is read when its writer pauses
const k_measure_after_ms = 150; // without another change
const k_most_speed = 5, k_most_turn = 90;

const gaits = signal<{ name: string; help: string }[]>([]);
const gait = signal<GaitFacts | null>(null);
const played = signal<GaitPlayed | null>(null);
/** Of its controls, one after the other. */
const curves = signal(new Float32Array(0));
/** What is wrong with the text as it stands; empty: nothing. */
const complaint = signal('');
const shownCurve = signal('');
const undo = new Undo<GaitWork>();
/** The text that the engine has read. */
let readText = '';

const initialValues = (known: GaitFacts) => known.parameters.map((each) => each.initial);

/** Values by name outlast a change of the text. */
const valuesOf = (known: GaitFacts, work: GaitWork) => known.parameters.map((each) => work.values[each.name] ?? each.initial);

let working = false;
/** Has the engine do what is in `gaitWork`. The last change wins: while one is on its way, others may have come. */
async function follow(): Promise<void> {
  if (working) return;
  working = true;
  for (let tried: GaitWork | null = null; tried !== gaitWork.value && showsGait(); ) {
    tried = gaitWork.value;
    try {
      if (tried) await make(tried);
      complaint.value = '';
    } catch (error) {
      complaint.value = error instanceof Error ? error.message : String(error);
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
    complaint.value = error instanceof Error ? error.message : String(error);
  }
}

async function make(work: GaitWork): Promise<void> {
  const isNew = work.text !== readText;
  if (isNew) {
    const known = await engine.call('gaitRead', work.text);
    readText = work.text;
    gait.value = known;
  }
  const drawn = (await engine.call('gaitPlay', valuesOf(gait.value!, work), work.speed, work.turn)) as Float32Array<ArrayBuffer>;
  // Another text may have other controls.
  const measured = isNew ? await engine.call('gaitPlayed') : played.value;
  batch(() => {
    curves.value = drawn;
    played.value = measured;
  });
}

function change(label: string, part: Partial<GaitWork>): void {
  const now = gaitWork.value;
  if (!now) return;
  undo.keep(now, label);
  gaitWork.value = { ...now, ...part };
  void follow();
}

function go(to: GaitWork | undefined): void {
  if (!to) return;
  gaitWork.value = to;
  void follow();
}

const stepBack = () => gaitWork.value && go(undo.undo(gaitWork.value));
const stepAhead = () => gaitWork.value && go(undo.redo(gaitWork.value));

/** Undo by keys, but where a text has its own. */
export function gaitKeys(event: KeyboardEvent): void {
  if (!(event.ctrlKey || event.metaKey) || (event.target as HTMLElement).closest('textarea')) return;
  const key = event.key.toLowerCase();
  if (key !== 'z' && key !== 'y') return;
  event.preventDefault();
  if (key === 'y' || event.shiftKey) stepAhead();
  else stepBack();
}

async function choose(name: string): Promise<void> {
  try {
    const text = await engine.call('gaitSource', name);
    undo.part();
    if (gaitWork.value) change(`gait ${name}`, { name, text, values: {}, speed: 0, turn: 0 });
    else gaitWork.value = { name, text, values: {}, speed: 0, turn: 0 };
  } catch (error) {
    fail('This gait cannot be shown', error);
  }
}

/** Puts the gait that was worked on last on the stage, or the first one. */
export async function loadGait(): Promise<void> {
  try {
    if (gaits.value.length === 0) gaits.value = await engine.call('gaits');
    if (!gaitWork.value) await choose(k_first_gait);
    readText = '';
    await follow();
    if (!gait.value || complaint.value !== '') {
      // What was kept cannot be read as it stands: there is something to see meanwhile.
      gait.value = await engine.call('gaitRead', await engine.call('gaitSource', k_first_gait));
      curves.value = (await engine.call('gaitPlay', initialValues(gait.value), 0, 0)) as Float32Array<ArrayBuffer>;
    }
    played.value = await engine.call('gaitPlayed');
    await showNewGround();
  } catch (error) {
    fail('The character cannot go in gaits', error);
  }
}

async function save(format: 'bvh' | 'glb'): Promise<void> {
  try {
    const bytes = await engine.call('gaitFile', format);
    download(`${gait.value!.name}.${format}`, bytes);
  } catch (error) {
    fail('The gait could not be saved', error);
  }
}

const stepOf = ({ low, high }: GaitParameter) => 10 ** Math.floor(Math.log10(Math.max(high - low, 1e-6) / 100));

function Parameter({ parameter, work }: { parameter: GaitParameter; work: GaitWork }) {
  const { name, initial } = parameter;
  return (
    <Slider
      label={name}
      hint={`${parameter.help} (${parameter.low} to ${parameter.high}, default ${initial})`}
      unit={parameter.unit === '1' ? '' : parameter.unit}
      value={work.values[name] ?? initial}
      low={parameter.low}
      high={parameter.high}
      step={stepOf(parameter)}
      initial={initial}
      onInput={(value) => change(`value ${name}`, { values: { ...work.values, [name]: value } })}
      onDone={() => undo.part()}
    />
  );
}

export function GaitPanel() {
  const known = gait.value, work = gaitWork.value, now = played.value;
  if (!known || !work) return <Section title="Gait">{<p>One moment…</p>}</Section>;
  const groups = [...new Set(known.parameters.map((each) => each.group))];
  return (
    <>
      <Section
        title="Gait"
        aside={
          <span class="pair">
            <button type="button" class="small" disabled={!undo.canUndo.value} onClick={stepBack} title="Ctrl+Z">Undo</button>
            <button type="button" class="small" disabled={!undo.canRedo.value} onClick={stepAhead} title="Ctrl+Shift+Z">Redo</button>
          </span>
        }
      >
        <Choose label="Gait" choices={gaits.value.map(({ name }) => ({ value: name, label: name.replaceAll('_', ' ') }))} value={work.name} onChange={(name) => void choose(name)} />
        {known.presets.length > 0 && (
          <Choose
            label="Preset"
            choices={[{ value: '', label: 'choose one' }, ...known.presets.map(({ name }) => ({ value: name, label: name.replaceAll('_', ' ') }))]}
            value=""
            onChange={(name) => {
              const preset = known.presets.find((each) => each.name === name);
              undo.part();
              if (preset) change(`preset ${name}`, { values: Object.fromEntries(known.parameters.map((each, i) => [each.name, preset.values[i]!])) });
            }}
          />
        )}
        {now && (
          <p class="keys">
            {now.speed.toFixed(2)} m/s · {now.duration.toFixed(2)} s a cycle · stride {now.stride.toFixed(2)} m
            {now.skate !== null && <> · planted feet slide at {(100 * now.skate).toFixed(1)} cm/s</>}
          </p>
        )}
        <Slider label="Speed asked for" hint="0: the gait's own" unit={work.speed === 0 ? 'its own' : 'm/s'} value={work.speed} low={0} high={k_most_speed} step={0.1} initial={0} onInput={(speed) => change('speed', { speed })} onDone={() => undo.part()} />
        <Slider label="Turn, to the left" unit="°/s" value={work.turn} low={-k_most_turn} high={k_most_turn} step={1} initial={0} onInput={(turn) => change('turn', { turn })} onDone={() => undo.part()} />
      </Section>
      {groups.map((group) => {
        const own = known.parameters.filter((each) => each.group === group);
        const reset = () => {
          undo.part();
          change(`reset ${group}`, { values: Object.fromEntries(Object.entries(work.values).filter(([name]) => !own.some((each) => each.name === name))) });
        };
        return (
          <Section
            key={group}
            title={group || 'Parameters'}
            aside={<button type="button" class="small" aria-label={`Reset ${group}`} disabled={own.every(({ name, initial }) => (work.values[name] ?? initial) === initial)} onClick={reset}>Reset</button>}
          >
            {own.map((parameter) => <Parameter key={parameter.name} parameter={parameter} work={work} />)}
          </Section>
        );
      })}
      <Section title="Save">
        <span class="pair">
          <button type="button" onClick={() => void save('glb')}>GLB</button>
          <button type="button" onClick={() => void save('bvh')}>BVH</button>
          <button type="button" onClick={() => download(`${known.name}.gait`, work.text)}>Text</button>
        </span>
      </Section>
    </>
  );
}

function curveOf({ curves: all }: GaitPlayed, name: string): Float32Array {
  const points = Math.floor(curves.value.length / all.length), at = all.findIndex((each) => each.name === name);
  return curves.value.subarray(at * points, (at + 1) * points);
}

/** Share of the cycle that the character is at: what the plot marks. */
function phase(): number {
  void frameCount.value;
  const layout = character.value?.layout, cycle = played.value?.duration;
  return layout && cycle ? (frame[layout.phase] ?? 0) : 0;
}

export function GaitDesk() {
  const work = gaitWork.value, now = played.value;
  const area = useRef<HTMLTextAreaElement>(null);
  const timer = useRef(0);
  // The text is the user's while it is typed; from outside it changes by undo or another gait.
  useEffect(() => effect(() => {
    const text = gaitWork.value?.text ?? '';
    if (area.current && area.current.value !== text) area.current.value = text;
  }), []);
  useEffect(() => () => clearTimeout(timer.current), []);
  const write = () => {
    clearTimeout(timer.current);
    timer.current = window.setTimeout(() => area.current && change('text', { text: area.current.value }), k_type_pause_ms);
  };
  const curve = now?.curves.find((each) => each.name === shownCurve.value) ?? now?.curves.find((each) => each.name === 'LeftFoot.tY') ?? now?.curves[0];
  const bad = complaint.value !== '';
  return (
    <div class="gait-desk">
      <label class="hidden" for="gait-text">Expressions of {work?.name ?? 'the gait'}</label>
      <textarea id="gait-text" ref={area} spellcheck={false} autocapitalize="off" wrap="off" aria-invalid={bad} aria-describedby="gait-complaint" onInput={write} onBlur={() => undo.part()} />
      <pre id="gait-complaint" role="status" class={bad ? 'bad' : ''}>
        {bad ? complaint.value : (gait.value?.warnings[0] ?? 'The character goes as this says.')}
      </pre>
      {now && curve && (
        <div class="curves">
          <Choose
            label="Curve"
            choices={now.curves.map(({ name, unit }) => ({ value: name, label: unit === '1' ? name : `${name} [${unit}]` }))}
            value={curve.name}
            onChange={(name) => batch(() => (shownCurve.value = name))}
          />
          <Curve values={curveOf(now, curve.name)} unit={curve.unit === '1' ? '' : curve.unit} at={phase} />
        </div>
      )}
    </div>
  );
}
