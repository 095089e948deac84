// Terrain: steer the character over every course and see how its feet stand.
import { facts, figures, setCourse, setMode, steered } from '../session';
import { cameraView, course, gradeDeg, mode, overlays, patrolSpeed, type CameraView } from '../settings';
import type { FootMode } from '../engine/messages';
import { Choose, Section, Segmented, Slider, Toggle } from '../ui/controls';

const k_course_names: Record<string, string> = {
  flat: 'Flat',
  hills: 'Hills',
  slope_up: 'Slope, up',
  slope_down: 'Slope, down',
  cross_slope: 'Across a slope',
  stairs_up: 'Stairs, up',
  stairs_down: 'Stairs, down',
  ledge: 'Ledge',
  rubble: 'Rubble',
  curb_oblique: 'Kerb, oblique',
};
const k_modes: { value: FootMode; label: string; hint: string }[] = [
  { value: 'none', label: 'None', hint: 'The legs stay as animated (1)' },
  { value: 'colvin2013', label: 'Colvin 2013', hint: 'The five steps of the paper, as printed (2)' },
  { value: 'surefoot', label: 'Surefoot', hint: 'Planned footholds, plants that cannot slide (3)' },
];
const k_views: { value: CameraView; label: string }[] = [
  { value: 'follow', label: 'Follow' },
  { value: 'side', label: 'Side' },
  { value: 'front', label: 'Front' },
  { value: 'feet', label: 'Feet' },
];
/** Figures that say something of a few seconds, in this order. */
const k_shown = [
  'skate_cm_s', 'penetration_heel_ball_cm', 'penetration_toe_mid_cm', 'float_mean_cm', 'sole_angle_deg',
  'sole_angle_worst_deg', 'over_extensions', 'knee_peak_ratio', 'knee_min_deg', 'hip_jerk_ratio',
];

function Figures() {
  const known = facts.value, values = figures.value;
  if (!known) return null;
  return (
    <table class="figures">
      <thead class="hidden">
        <tr>
          <th scope="col">Figure</th>
          <th scope="col">Value</th>
          <th scope="col">Mark</th>
        </tr>
      </thead>
      <tbody>
        {k_shown.map((key) => {
          const index = known.figures.findIndex((each) => each.key === key);
          const figure = known.figures[index];
          if (!figure) return null;
          const value = values?.[index];
          return (
            <tr key={key} class={value?.missed ? 'missed' : ''} title={figure.mark ? `Mark: ${figure.mark}` : undefined}>
              <th scope="row">{figure.name}</th>
              <td>
                {value?.text ?? '–'} <small>{figure.unit}</small>
              </td>
              <td class="verdict" aria-label={!value ? 'not measured yet' : value.missed ? 'misses its mark' : 'meets its mark'}>
                {!value ? '' : value.missed ? '✗' : '✓'}
              </td>
            </tr>
          );
        })}
      </tbody>
    </table>
  );
}

export function TerrainPanel() {
  const known = facts.value;
  const fastest = known?.facing['speed']?.[1] ?? 4;
  const sloped = course.value === 'slope_up' || course.value === 'slope_down';
  return (
    <>
      <Section title="Course">
        <Choose
          label="Walk over"
          choices={(known?.courses ?? [course.value]).map((value) => ({ value, label: k_course_names[value] ?? value }))}
          value={course.value}
          onChange={(value) => void setCourse(value, gradeDeg.value)}
        />
        {sloped && (
          <Slider label="Grade" unit="°" value={gradeDeg.value} low={5} high={30} step={5} initial={15} onInput={(value) => void setCourse(course.value, value)} />
        )}
        <Toggle label="Walks up and down by itself" hint="P" on={!steered.value} onChange={(on) => (steered.value = !on)} />
        <Slider label="Its pace" unit="m/s" value={patrolSpeed.value} low={0.4} high={Math.floor(fastest * 10) / 10} step={0.1} initial={1.4} onInput={(value) => (patrolSpeed.value = value)} />
      </Section>
      <Section title="Foot placement">
        <Segmented label="Foot placement" choices={k_modes} value={mode.value} onChange={setMode} />
      </Section>
      <Section title="Last four seconds">
        <Figures />
      </Section>
      <Section title="Show">
        <Segmented label="Camera" choices={k_views} value={cameraView.value} onChange={(value) => (cameraView.value = value)} />
        <Toggle label="Contacts: full on the ground, hollow in the air" on={overlays.contacts.value} onChange={(on) => (overlays.contacts.value = on)} />
        <Toggle label="Footholds to come" on={overlays.footholds.value} onChange={(on) => (overlays.footholds.value = on)} />
        <Toggle label="Ankle axes" on={overlays.axes.value} onChange={(on) => (overlays.axes.value = on)} />
        <Toggle label="Hip to ankle" on={overlays.hips.value} onChange={(on) => (overlays.hips.value = on)} />
      </Section>
      <Section title="Keys">
        <p class="keys">
          <kbd>W</kbd><kbd>S</kbd> go, back · <kbd>A</kbd><kbd>D</kbd> turn · <kbd>Q</kbd><kbd>E</kbd> sidestep · <kbd>Shift</kbd> run ·{' '}
          <kbd>Space</kbd> pause · <kbd>.</kbd> step · <kbd>R</kbd> restart · <kbd>P</kbd> by itself · <kbd>1</kbd><kbd>2</kbd><kbd>3</kbd> placement
        </p>
      </Section>
    </>
  );
}
