// Gait: a character that goes as expressions or a fitted gait say, its parameters as sliders, its text, its curves, its body.
import { effect } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';
import {
  canRedo, canUndo, change, choose, complaint, curves, gait, gaits, part, personality, played, readDraft, rigs, setValues, shapesBody, stepAhead,
  stepBack, stepOf, typed,
} from '../gait';
import { engine, fail, frame, frameCount, facts as character } from '../session';
import { download } from '../download';
import type { GaitParameter, GaitPlayed } from '../engine/messages';
import { gaitWork, type GaitWork } from '../settings';
import { Choose, Section, Segmented, Slider } from '../ui/controls';
import { Curve } from '../ui/curve';

const k_most_slope = 25; // [deg]

const spoken = (name: string) => name.replaceAll('_', ' ');

async function save(format: 'bvh' | 'glb'): Promise<void> {
  try {
    const bytes = await engine.call('gaitFile', format);
    download(`${gait.value!.name}.${format}`, bytes);
  } catch (error) {
    fail('The gait could not be saved', error);
  }
}

const k_units: Record<string, string> = { '1': '', deg: '°' };
const unitOf = (unit: string) => k_units[unit] ?? unit;

/** "spine.lean_deg" of the group "spine" is "lean"; names of a text stay as they stand there. */
const labelOf = ({ name, group }: GaitParameter) =>
  name.startsWith(`${group}.`) || group === 'whole body' ? name.replace(`${group}.`, '').replace(/_(deg|m)$/, '') : name;

function Parameter(props: { parameter: GaitParameter; value: number; onInput: (value: number) => void }) {
  const { parameter, value } = props;
  return (
    <Slider
      label={labelOf(parameter)}
      hint={`${parameter.help ? `${parameter.help} ` : ''}(${parameter.low} to ${parameter.high}, default ${parameter.initial})`}
      unit={unitOf(parameter.unit)}
      value={value}
      low={parameter.low}
      high={parameter.high}
      step={stepOf(parameter)}
      initial={parameter.initial}
      onInput={props.onInput}
      onDone={part}
    />
  );
}

/** Sliders of one group, with a way back. */
function Group(props: { title: string; parameters: GaitParameter[]; values: Record<string, number>; onChange: (label: string, values: Record<string, number>) => void }) {
  const { title, parameters, values } = props;
  const isInitial = ({ name, initial }: GaitParameter) => (values[name] ?? initial) === initial;
  const reset = () => {
    part();
    props.onChange(`reset ${title}`, Object.fromEntries(Object.entries(values).filter(([name]) => !parameters.some((each) => each.name === name))));
  };
  return (
    <Section title={title} aside={<button type="button" class="small" aria-label={`Reset ${title}`} disabled={parameters.every(isInitial)} onClick={reset}>Reset</button>}>
      {parameters.map((each) => (
        <Parameter key={each.name} parameter={each} value={values[each.name] ?? each.initial} onInput={(value) => props.onChange(`value ${each.name}`, { ...values, [each.name]: value })} />
      ))}
    </Section>
  );
}

const groupsOf = (parameters: GaitParameter[]) => [...new Set(parameters.map((each) => each.group))];
const ofGroup = (parameters: GaitParameter[], group: string) => parameters.filter((each) => each.group === group);
const titled = (group: string) => (group === '' ? 'Parameters' : group[0]!.toUpperCase() + group.slice(1));

/** What the gait is asked for. */
function Asked({ work }: { work: GaitWork }) {
  const { speed, turn, slopes, fitted } = gait.value!;
  const low = fitted ? (speed?.low ?? 0) : 0, asked = work.speed ?? speed?.own ?? 0;
  return (
    <>
      {speed && <Slider label="Speed asked for" hint={fitted ? 'Along its way' : '0: the gait’s own'} unit={asked === 0 ? 'its own' : 'm/s'} value={asked} low={low} high={speed.high} step={0.1} initial={speed.own} onInput={(value) => change('speed', { speed: value })} onDone={part} />}
      {turn && <Slider label="Turn, to the left" hint="On level ground" unit="°/s" value={work.turn ?? turn.own} low={turn.low} high={turn.high} step={1} initial={turn.own} onInput={(value) => change('turn', { turn: value, slope: 0 })} onDone={part} />}
      {slopes && <Slider label="Slope, uphill" hint="Straight up or down it" unit="°" value={work.slope} low={-k_most_slope} high={k_most_slope} step={1} initial={0} onInput={(slope) => change('slope', { slope, ...(turn && { turn: 0 }) })} onDone={part} />}
      {!speed && !turn && <p class="note">It goes as it goes: no other speed was learnt.</p>}
    </>
  );
}

function Body({ work }: { work: GaitWork }) {
  const template = rigs.value.find((each) => each.name === work.rig?.name);
  const own = 'the character';
  const wear = (name: string) => {
    part();
    change(`body ${name}`, { rig: name === own ? null : { name, values: {} } });
  };
  return (
    <>
      <Section title="Body">
        <Choose label="Whose" choices={[own, ...rigs.value.map(({ name }) => name)].map((name) => ({ value: name, label: spoken(name) }))} value={work.rig?.name ?? own} onChange={wear} />
        <p class="note">{template ? `${template.help}. Pull its handles, or use the sliders.` : 'As it was opened. A template has a body that can be shaped.'}</p>
      </Section>
      {template && groupsOf(template.parameters).map((group) => (
        <Group key={group} title={titled(group)} parameters={ofGroup(template.parameters, group)} values={work.rig!.values} onChange={(label, values) => change(`rig ${label}`, { rig: { name: template.name, values } })} />
      ))}
    </>
  );
}

export function GaitPanel() {
  const known = gait.value, work = gaitWork.value, now = played.value;
  if (!known || !work) return <Section title="Gait">{<p>One moment…</p>}</Section>;
  const named = (fitted: boolean) => gaits.value.filter((each) => each.fitted === fitted);
  return (
    <>
      <Section
        title="Gait"
        aside={
          <span class="pair">
            <button type="button" class="small" disabled={!canUndo.value} onClick={stepBack} title="Ctrl+Z">Undo</button>
            <button type="button" class="small" disabled={!canRedo.value} onClick={stepAhead} title="Ctrl+Shift+Z">Redo</button>
          </span>
        }
      >
        <Choose
          label="Gait"
          groups={[
            { label: 'Learnt from motion', choices: named(true).map(({ name }) => ({ value: name, label: spoken(name) })) },
            { label: 'Expressions', choices: named(false).map(({ name }) => ({ value: name, label: spoken(name) })) },
          ]}
          value={work.name}
          onChange={(name) => void choose(name)}
        />
        {known.presets.length > 0 && (
          <Choose
            label={known.fitted ? 'Personality' : 'Preset'}
            choices={[{ value: '', label: 'choose one' }, ...known.presets.map(({ name }) => ({ value: name, label: spoken(name) }))]}
            value=""
            onChange={(name) => {
              const preset = known.presets.find((each) => each.name === name);
              part();
              if (preset) setValues(`preset ${name}`, preset.values);
            }}
          />
        )}
        {now && (
          <p class="keys">
            {now.speed.toFixed(2)} m/s · {now.duration.toFixed(2)} s a cycle · stride {now.stride.toFixed(2)} m
            {now.skate !== null && <> · planted feet slide at {(100 * now.skate).toFixed(1)} cm/s</>}
          </p>
        )}
        <Asked work={work} />
        <Segmented label="Shape" choices={[{ value: 'gait' as const, label: known.fitted ? 'How it goes' : 'The gait' }, { value: 'body' as const, label: 'The body' }]} value={shapesBody.value ? 'body' : 'gait'} onChange={(shows) => (shapesBody.value = shows === 'body')} />
      </Section>
      {shapesBody.value ? <Body work={work} /> : groupsOf(known.parameters).map((group) => (
        <Group key={group} title={titled(group)} parameters={ofGroup(known.parameters, group)} values={work.values} onChange={(label, values) => change(label, { values })} />
      ))}
      <Section title="Save">
        <span class="pair">
          <button type="button" onClick={() => void save('glb')}>GLB</button>
          <button type="button" onClick={() => void save('bvh')}>BVH</button>
          {work.text === null
            ? <button type="button" title="surefoot gait … --personality FILE.json#mine" onClick={() => download(`${known.name}.personality.json`, personality(work))}>Personality</button>
            : <button type="button" onClick={() => download(`${known.name}.gait`, work.text!)}>Text</button>}
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

const k_first_curves = ['LeftFoot.tY', 'left_foot.tY'];

export function GaitDesk() {
  const work = gaitWork.value, now = played.value, known = gait.value;
  const area = useRef<HTMLTextAreaElement>(null);
  const [shown, setShown] = useState('');
  // The text is the user's while it is typed; from outside it changes by undo, sliders or another gait.
  useEffect(() => effect(() => {
    const work = gaitWork.value, field = area.current;
    const text = !work ? '' : (work.text ?? (gait.value?.fitted ? personality(work) : ''));
    if (!field || field.value === text || (work?.text === null && document.activeElement === field)) return;
    field.value = text;
  }), []);
  useEffect(() => readDraft, []);
  const leave = () => {
    readDraft();
    part();
  };
  const curve = now?.curves.find((each) => each.name === shown) ?? now?.curves.find((each) => k_first_curves.includes(each.name)) ?? now?.curves[0];
  const bad = complaint.value !== '';
  const fine = work?.text === null ? `${work.name}: ${known?.help ?? ''}. The text is its personality.` : 'The character goes as this says.';
  return (
    <div class="gait-desk">
      <label class="hidden" for="gait-text">{work?.text === null ? 'Personality of' : 'Expressions of'} {work?.name ?? 'the gait'}</label>
      <textarea id="gait-text" ref={area} spellcheck={false} autocapitalize="off" wrap="off" aria-invalid={bad} aria-describedby="gait-complaint" onInput={(event) => typed(event.currentTarget.value)} onBlur={leave} />
      <pre id="gait-complaint" role="status" class={bad ? 'bad' : ''}>{bad ? complaint.value : (known?.warnings[0] ?? fine)}</pre>
      {now && curve && (
        <div class="curves">
          <Choose
            label="Curve"
            choices={now.curves.map(({ name, unit }) => ({ value: name, label: unit === '1' ? name : `${name} [${unit}]` }))}
            value={curve.name}
            onChange={setShown}
          />
          <Curve values={curveOf(now, curve.name)} unit={unitOf(curve.unit)} at={phase} />
        </div>
      )}
    </div>
  );
}
