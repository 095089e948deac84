// Blend space: what plays, what is wrong, what mends it, and how the blends turn out.
import {
  attempts, busy, leaveOut, mend, project, redo, resetThresholds, setThreshold, showHeat, shownHeat, takeBack, undo, heat,
} from '../bench';
import type { BenchFacts, Finding, SpaceFacts } from '../engine/messages';
import { save, savesInFolder, worthSaving } from '../project';
import { ghosts } from '../settings';
import { Choose, Section, Segmented, Slider, Toggle } from '../ui/controls';
import { HeatKey } from './space_map';
import { choose, colorOf, findings, look, looked, place, puck, space, weights } from './space_state';

/** Thresholds of the paper's own problems, and how far their sliders go. */
const k_highest: Record<string, number> = {
  'crossing-axis': 30, 'acute-triangle': 45, 'too-close': 40, uncovered: 50,
};
const k_marks: Record<Finding['severity'], string> = { error: '▲', warning: '◆', info: '●' };
const k_space_names: Record<string, string> = { facing: 'Speed and turn', lateral: 'Sideways' };
/** What can be shown before anybody has probed; the names are those of the probe's figures. */
const k_heats = ['Speed error', 'Turn error', 'Foot skate', 'Knee jerk against the clips alone', 'Legs inside each other'];

const readable = (clip: string) => clip.replaceAll('_', ' ');

function Steps({ all }: { all: BenchFacts }) {
  const place = savesInFolder.value ? 'Save' : 'Download';
  return (
    <span class="pair">
      <button type="button" class="small" disabled={all.undo === null || busy.value} onClick={() => void undo()} title={all.undo ? `Undo ${all.undo} (Ctrl+Z)` : 'Ctrl+Z'}>Undo</button>
      <button type="button" class="small" disabled={all.redo === null || busy.value} onClick={() => void redo()} title={all.redo ? `Redo ${all.redo} (Ctrl+Shift+Z)` : 'Ctrl+Shift+Z'}>Redo</button>
      <button type="button" class={worthSaving.value ? 'small unsaved' : 'small'} disabled={busy.value} onClick={() => void save()} title={`${savesInFolder.value ? 'Into the served folder' : 'As a .zip of the project’s folder'}${worthSaving.value ? '; there are changes' : ''} (Ctrl+S)`}>{place}</button>
    </span>
  );
}

/** Keys of this workspace; those of texts and sliders stay theirs. */
export function spaceKeys(event: KeyboardEvent): void {
  if (!(event.ctrlKey || event.metaKey) || event.altKey || !project.value || busy.value) return;
  const key = event.key.toLowerCase();
  if (key === 'z') void (event.shiftKey ? redo() : undo());
  else if (key === 'y') void redo();
  else if (key === 's') void save();
  else return;
  event.preventDefault();
}

function Weights() {
  return (
    <ul class="weights">
      {weights.value.map((each) => (
        <li key={each.clip}>
          <span>
            {ghosts.value && <i class="swatch" style={{ background: colorOf(each.clip) }} />}
            {readable(each.clip)}
          </span>
          <meter min={0} max={1} value={each.weight} aria-label={`${each.clip}: weight`} />
          <output>{(100 * each.weight).toFixed(0)} %</output>
        </li>
      ))}
    </ul>
  );
}

/** The axes that the map does not show. */
function Slices({ shown }: { shown: SpaceFacts }) {
  return (
    <>
      {shown.axes.slice(2).map((axis, i) => (
        <Slider
          key={axis.name}
          label={axis.name}
          unit={axis.unit}
          value={puck.value[i + 2] ?? axis.low}
          low={axis.low}
          high={axis.high}
          step={(axis.high - axis.low) / 100 || 1}
          initial={axis.low}
          onInput={(value) => place(puck.value.map((each, k) => (k === i + 2 ? value : each)))}
        />
      ))}
    </>
  );
}

function FindingItem({ finding, all }: { finding: Finding; all: BenchFacts }) {
  const rule = all.rules.find((each) => each.id === finding.rule), on = looked.value === finding.id;
  const failed = attempts.value.find((each) => each.id === finding.id && !each.done);
  return (
    <li>
      <button type="button" class={finding.severity} aria-pressed={on} onClick={() => look(finding)}>
        <span aria-label={finding.severity}>{k_marks[finding.severity]}</span>
        {rule?.title ?? finding.rule}
        {finding.clips.length > 0 && <small>{finding.clips.map(readable).join(', ')}</small>}
      </button>
      {on && (
        <div class="detail">
          <p>{finding.message} <small>{rule?.help}</small></p>
          {finding.mend !== null && (
            <p class="mend">
              <button type="button" class="small" disabled={busy.value} onClick={() => void mend(finding.id)}>Mend it</button>
              <small>{finding.mend}</small>
            </p>
          )}
          {failed && <p class="failed">Not mended: {failed.text.replace(/^not done: /, '') || 'the clips at hand cannot give what it asks for'}.</p>}
        </div>
      )}
    </li>
  );
}

function Findings({ all }: { all: BenchFacts }) {
  const count = (severity: Finding['severity']) => findings.value.filter((each) => each.severity === severity).length;
  const counted = (n: number, one: string) => `${n} ${one}${n === 1 ? '' : 's'}`;
  return (
    <Section
      title={`Findings: ${counted(count('error'), 'error')}, ${counted(count('warning'), 'warning')}, ${counted(count('info'), 'remark')}`}
      aside={
        <button type="button" class="small" disabled={busy.value || all.findings.length === 0} onClick={() => void mend()} title="Makes the clips that are missing where the others can give them, and mends what else can be mended">
          Mend all
        </button>
      }
    >
      {findings.value.length === 0 && <p>Nothing is wrong with this space.</p>}
      <ul class="findings">
        {findings.value.map((finding) => <FindingItem key={finding.id} finding={finding} all={all} />)}
      </ul>
    </Section>
  );
}

function Repairs({ all }: { all: BenchFacts }) {
  if (all.repairs.length === 0) return null;
  return (
    <Section title={`Repairs: ${all.repairs.length}`}>
      <ul class="rows">
        {all.repairs.map((repair) => (
          <li key={repair.id}>
            <span>{repair.text}</span>
            <button type="button" class="small" disabled={busy.value} onClick={() => void takeBack(repair.id)}>Take back</button>
          </li>
        ))}
      </ul>
    </Section>
  );
}

function Clips({ shown, all }: { shown: SpaceFacts; all: BenchFacts }) {
  const names = [...new Set(shown.samples.map(({ clip }) => clip))];
  return (
    <Section title={`Clips: ${names.length} here, ${all.leftOut.length} left out`}>
      <details>
        <summary>Leave out, take in</summary>
        <ul class="rows">
          {names.map((clip) => (
            <li key={clip}>
              <span>{readable(clip)}</span>
              <button type="button" class="small" disabled={busy.value} aria-label={`Leave out ${clip}`} onClick={() => void leaveOut(clip, true)}>Leave out</button>
            </li>
          ))}
          {all.leftOut.map(({ clip, reason, atHand }) => (
            <li key={clip} class="out">
              <span>{readable(clip)} <small>{reason}</small></span>
              {atHand && <button type="button" class="small" disabled={busy.value} aria-label={`Take in ${clip}`} onClick={() => void leaveOut(clip, false)}>Take in</button>}
            </li>
          ))}
        </ul>
      </details>
      {all.failed.length > 0 && (
        <ul class="rows unread">
          {all.failed.map((text) => <li key={text}><span><b>Not read:</b> {text}</span></li>)}
        </ul>
      )}
    </Section>
  );
}

function Thresholds({ all }: { all: BenchFacts }) {
  const every = all.rules.flatMap((rule) => rule.thresholds.map((threshold, i) => ({ rule, threshold, first: i === 0 })));
  /** Those that the paper's own problems hang on are in sight. */
  const isMain = ({ rule, first }: (typeof every)[number]) => first && rule.id in k_highest;
  const slider = ({ rule, threshold, first }: (typeof every)[number]) => (
    <Slider
      key={`${rule.id}.${threshold.name}`}
      label={first ? rule.title : `${rule.title}: ${threshold.name.replaceAll('_', ' ')}`}
      hint={threshold.help}
      unit={threshold.unit}
      value={threshold.value}
      low={0}
      high={Math.max((first && k_highest[rule.id]) || 0, 2.5 * threshold.initial, threshold.value)}
      step={threshold.initial >= 4 ? 0.5 : threshold.initial >= 0.4 ? 0.05 : 0.005}
      initial={threshold.initial}
      onInput={(value) => void setThreshold(rule.id, threshold.name, value)}
    />
  );
  const changed = every.some(({ threshold }) => threshold.value !== threshold.initial);
  return (
    <Section title="Thresholds" aside={<button type="button" class="small" disabled={!changed} onClick={() => void resetThresholds()}>Reset</button>}>
      {every.filter(isMain).map(slider)}
      <details>
        <summary>All others</summary>
        <div class="more">{every.filter((each) => !isMain(each)).map(slider)}</div>
      </details>
    </Section>
  );
}

export function SpacePanel() {
  const shown = space.value, all = project.value;
  if (!all) return <Section title="Blend space">{<p>One moment…</p>}</Section>;
  if (!shown) return <Section title="Blend space" aside={<Steps all={all} />}>{<p>It has none.</p>}</Section>;
  const missing = all.placeholders.filter((each) => each.space === shown.name);
  const figures = heat.value.length > 0 ? [...new Set(heat.value.map(({ title }) => title))] : k_heats;
  return (
    <>
      <Section title="Blend space" aside={<Steps all={all} />}>
        {all.spaces.length > 1 && (
          <Segmented
            label="Space"
            choices={all.spaces.map(({ name }) => ({ value: name, label: k_space_names[name] ?? name.replace('style:', '') }))}
            value={shown.name}
            onChange={choose}
          />
        )}
        <Slices shown={shown} />
        <Weights />
        <Toggle label="Ghosts of these clips" hint="Each clip alone, where the character is" on={ghosts.value} onChange={(on) => (ghosts.value = on)} />
        <Choose
          label="Colour by"
          choices={[{ value: '', label: 'none' }, ...figures.map((title) => ({ value: title, label: title }))]}
          value={shownHeat.value}
          onChange={(title) => void showHeat(title)}
        />
        <HeatKey />
      </Section>
      <Findings all={all} />
      <Repairs all={all} />
      <Thresholds all={all} />
      {missing.length > 0 && (
        <Section title="Missing clips">
          <ul class="missing">
            {missing.map((each, i) => (
              <li key={i} class={each.needed ? 'needed' : 'suggested'}>
                {each.text} <small>{each.needed ? 'needed' : 'suggested'}</small>
              </li>
            ))}
          </ul>
        </Section>
      )}
      <Clips shown={shown} all={all} />
    </>
  );
}
