// Blend space: the triangulation, what is wrong with it, and a puck to drag through it.
import { batch, computed, effect, signal } from '@preact/signals';
import { engine, fail, hold, say } from '../session';
import type { Finding, SpaceFacts, SpacesFacts } from '../engine/messages';
import { Section, Segmented, Slider } from '../ui/controls';

export const spaces = signal<SpacesFacts | null>(null);
const chosen = signal(0);
const puck = signal<number[]>([]);
const weights = signal<{ clip: string; weight: number }[]>([]);
/** Index into the shown findings of the one that is looked at. */
const looked = signal<number | null>(null);

const space = computed<SpaceFacts | null>(() => spaces.value?.spaces[chosen.value] ?? null);
const findings = computed<Finding[]>(() =>
  (spaces.value?.findings ?? []).filter((each) => each.space === '' || each.space === space.value?.name),
);

/** Thresholds that the paper's own problems hang on. */
const k_thresholds = [
  { rule: 'crossing-axis', high: 30 },
  { rule: 'acute-triangle', high: 45 },
  { rule: 'too-close', high: 40 },
  { rule: 'uncovered', high: 50 },
];
const k_marks: Record<Finding['severity'], string> = { error: '▲', warning: '◆', info: '●' };
const k_space_names: Record<string, string> = { facing: 'Speed and turn', lateral: 'Sideways' };

/** A puck that the character obeys; m/s and deg/s by the axes' names. */
function request(shown: SpaceFacts, at: number[]): { speed: number; lateral: number; turn: number } {
  const value = (name: string) => at[shown.axes.findIndex((axis) => axis.name === name)] ?? 0;
  return { speed: value('speed') + value('forward'), lateral: value('lateral'), turn: value('turn') };
}

export async function loadSpaces(): Promise<void> {
  try {
    const loaded = await engine.call('spaces');
    batch(() => {
      spaces.value = loaded;
      chosen.value = 0;
      looked.value = null;
      place(restingPlace(loaded.spaces[0]));
    });
  } catch (error) {
    fail('The blend spaces could not be shown', error);
  }
}

/** Somewhere inside, where more than one clip plays. */
function restingPlace(shown: SpaceFacts | undefined): number[] {
  return shown?.axes.map((axis) => (axis.name === 'turn' ? 0.2 * axis.high : axis.low + 0.45 * (axis.high - axis.low))) ?? [];
}

function place(at: number[]): void {
  puck.value = at;
}

let asking = false;
effect(() => {
  const at = puck.value, index = chosen.value, shown = space.value;
  if (!shown || at.length !== shown.axes.length) return;
  hold(request(shown, at));
  if (asking) return;
  asking = true;
  // The last place wins: while one answer is on its way, the puck may have moved on.
  void engine.call('blend', index, at).then((now) => {
    weights.value = now;
    asking = false;
    if (puck.value !== at) puck.value = [...puck.value];
  }, (error: unknown) => {
    asking = false;
    fail('The weights could not be computed', error);
  });
});

async function setThreshold(rule: string, name: string, value: number): Promise<void> {
  try {
    spaces.value = await engine.call('setThreshold', rule, name, value);
    looked.value = null;
  } catch (error) {
    fail('This threshold cannot be set', error);
  }
}

async function resetThresholds(): Promise<void> {
  spaces.value = await engine.call('resetThresholds');
  say('All thresholds are the project’s own again.');
}

/** [px] of the map; its border is for the axes. */
const size = signal({ width: 600, height: 500 });
const k_left = 58, k_right = 34, k_top = 30, k_bottom = 50;
const k_beside = 15; // [px] a finding's mark stands beside the missing clip that it asks for

interface Frame {
  x: (value: number) => number;
  y: (value: number) => number;
  back: (x: number, y: number) => number[];
}

function frameOf(shown: SpaceFacts): Frame {
  const { width, height } = size.value;
  const [across, up] = [shown.axes[0]!, shown.axes[1]];
  const wide = width - k_left - k_right, high = height - k_top - k_bottom;
  const x = (value: number) => k_left + ((value - across.low) / (across.high - across.low)) * wide;
  const y = (value: number) => (up ? k_top + high - ((value - up.low) / (up.high - up.low)) * high : k_top + high / 2);
  const inside = (share: number) => Math.min(Math.max(share, 0), 1);
  const back = (px: number, py: number) => {
    const at = [across.low + inside((px - k_left) / wide) * (across.high - across.low)];
    if (up) at.push(up.low + inside((k_top + high - py) / high) * (up.high - up.low));
    return at;
  };
  return { x, y, back };
}

let watched: ResizeObserver | undefined;
/** One unit of the map is one pixel, however large it is. */
function watchSize(box: HTMLElement | null): void {
  watched?.disconnect();
  watched = undefined;
  if (!box) return;
  watched = new ResizeObserver(() => {
    if (box.clientWidth !== size.value.width || box.clientHeight !== size.value.height)
      size.value = { width: Math.max(box.clientWidth, 160), height: Math.max(box.clientHeight, 120) };
  });
  watched.observe(box);
}

const round = (value: number) => Number(value.toFixed(3));
const steps = (low: number, high: number): number[] => {
  const rough = (high - low) / 6, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((each) => each * power).find((each) => each >= rough)!;
  const ticks: number[] = [];
  for (let tick = Math.ceil(low / step) * step; tick <= high + 1e-6; tick += step) ticks.push(round(tick));
  return ticks;
};

function Grid({ shown, frame }: { shown: SpaceFacts; frame: Frame }) {
  const [across, up] = [shown.axes[0]!, shown.axes[1]];
  const { width, height } = size.value;
  return (
    <g class="grid">
      {steps(across.low, across.high).map((tick) => (
        <g key={`x${tick}`}>
          <line class={tick === 0 ? 'zero' : ''} x1={frame.x(tick)} x2={frame.x(tick)} y1={k_top} y2={height - k_bottom} />
          <text x={frame.x(tick)} y={height - k_bottom + 17} text-anchor="middle">{tick}</text>
        </g>
      ))}
      {up && steps(up.low, up.high).map((tick) => (
        <g key={`y${tick}`}>
          <line class={tick === 0 ? 'zero' : ''} x1={k_left} x2={width - k_right} y1={frame.y(tick)} y2={frame.y(tick)} />
          <text x={k_left - 10} y={frame.y(tick) + 4} text-anchor="end">{tick}</text>
        </g>
      ))}
      <text class="title" x={(k_left + width - k_right) / 2} y={height - 12} text-anchor="middle">{across.name} [{across.unit}]</text>
      {up && <text class="title" transform={`translate(16 ${(k_top + height - k_bottom) / 2}) rotate(-90)`} text-anchor="middle">{up.name} [{up.unit}]</text>}
    </g>
  );
}

/** Where a finding is, by shape and colour: a triangle an error, a square on its tip a warning, a circle a remark. */
function Mark({ finding, x, y, on }: { finding: Finding; x: number; y: number; on: boolean }) {
  const size = on ? 12 : 8;
  const shapes = { error: `M0 ${-size}L${size} ${size * 0.8}H${-size}z`, warning: `M0 ${-size}L${size} 0 0 ${size}${-size} 0z`, info: '' };
  return (
    <g class={`mark ${finding.severity}${on ? ' on' : ''}`} transform={`translate(${x} ${y})`}>
      {finding.severity === 'info' ? <circle r={size * 0.75} /> : <path d={shapes[finding.severity]} />}
      <title>{finding.message}</title>
    </g>
  );
}

export function SpaceMap() {
  const shown = space.value;
  if (!shown) return <div class="map" />;
  const { width, height } = size.value;
  const frame = frameOf(shown);
  const missing = (spaces.value?.placeholders ?? []).filter((each) => each.space === shown.name && each.axes.length === shown.axes.length);
  const at = (values: number[]): [number, number] => [frame.x(values[0] ?? 0), frame.y(values[1] ?? 0)];
  const playing = new Map(weights.value.map((each) => [each.clip, each.weight]));
  const drag = (event: PointerEvent) => {
    const svg = event.currentTarget as SVGSVGElement;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM()!.inverse());
    place(frame.back(point.x, point.y));
  };
  const nudge = (event: KeyboardEvent) => {
    const axis = event.key === 'ArrowLeft' || event.key === 'ArrowRight' ? 0 : event.key === 'ArrowUp' || event.key === 'ArrowDown' ? 1 : -1;
    const range = shown.axes[axis];
    if (!range) return;
    event.preventDefault();
    event.stopPropagation();
    const step = ((range.high - range.low) / (event.shiftKey ? 10 : 50)) * (event.key === 'ArrowLeft' || event.key === 'ArrowDown' ? -1 : 1);
    place(puck.value.map((value, i) => (i === axis ? Math.min(Math.max(value + step, range.low), range.high) : value)));
  };
  const words = shown.axes.map((axis, i) => `${axis.name} ${(puck.value[i] ?? 0).toFixed(1)} ${axis.unit}`).join(', ');
  return (
    <div class="map" ref={watchSize}>
      <svg
        viewBox={`0 0 ${width} ${height}`}
        tabindex={0}
        role="slider"
        aria-label="Puck in the blend space; arrow keys move it, with Shift in larger steps"
        aria-valuenow={round(puck.value[0] ?? 0)}
        aria-valuetext={words}
        onKeyDown={nudge}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          drag(event);
        }}
        onPointerMove={(event) => event.currentTarget.hasPointerCapture(event.pointerId) && drag(event)}
      >
        <Grid shown={shown} frame={frame} />
        <g class="cells">
          {shown.cells.map((cell, i) => (
            <polygon key={i} points={cell.map((corner) => at(shown.samples[corner]!.at).join(',')).join(' ')} />
          ))}
        </g>
        <g class="placeholders">
          {missing.map((each, i) => (
            <g key={i} class={each.needed ? 'needed' : 'suggested'} transform={`translate(${at(each.at).join(' ')})`}>
              <rect x="-8" y="-8" width="16" height="16" rx="3" />
              <path d="M-4 0H4M0-4V4" />
              <title>{`${each.needed ? 'Needed' : 'Suggested'}: ${each.text}`}</title>
            </g>
          ))}
        </g>
        <g class="samples">
          {shown.samples.map((sample) => {
            const [x, y] = at(sample.at), weight = playing.get(sample.clip) ?? 0;
            const name = sample.clip.replaceAll('_', ' ');
            return (
              <g key={sample.clip} class={weight > 0.005 ? 'plays' : ''}>
                <circle class="weight" cx={x} cy={y} r={5 + 17 * Math.sqrt(Math.max(weight, 0))} />
                <circle cx={x} cy={y} r="4" />
                <text x={x + (x > width - 100 ? -8 : 8)} y={y - 7} text-anchor={x > width - 100 ? 'end' : 'start'}>{name}</text>
              </g>
            );
          })}
        </g>
        <g>
          {findings.value.map((finding, i) => {
            if (finding.at.length !== shown.axes.length) return null;
            const [x, y] = at(finding.at);
            const taken = missing.some((each) => Math.hypot(at(each.at)[0] - x, at(each.at)[1] - y) < k_beside);
            return <Mark key={i} finding={finding} x={taken ? x - k_beside : x} y={taken ? y - k_beside : y} on={looked.value === i} />;
          })}
        </g>
        <g class="puck" transform={`translate(${at(puck.value).join(' ')})`}>
          <circle r="10" />
          <path d="M-16 0H-6M6 0H16M0-16V-6M0 6V16" />
        </g>
      </svg>
    </div>
  );
}

export function SpacePanel() {
  const shown = space.value, all = spaces.value;
  if (!shown || !all) return <Section title="Blend space">{<p>It has none.</p>}</Section>;
  const count = (severity: Finding['severity']) => findings.value.filter((each) => each.severity === severity).length;
  return (
    <>
      <Section title="Blend space">
        {all.spaces.length > 1 && (
          <Segmented
            label="Space"
            choices={all.spaces.map((each, i) => ({ value: i, label: k_space_names[each.name] ?? each.name.replace('style:', '') }))}
            value={chosen.value}
            onChange={(value) => batch(() => {
              chosen.value = value;
              looked.value = null;
              place(restingPlace(all.spaces[value]));
            })}
          />
        )}
        <ul class="weights">
          {weights.value.map((each) => (
            <li key={each.clip}>
              <span>{each.clip.replaceAll('_', ' ')}</span>
              <meter min={0} max={1} value={each.weight} aria-label={`${each.clip}: weight`} />
              <output>{(100 * each.weight).toFixed(0)} %</output>
            </li>
          ))}
        </ul>
      </Section>
      <Section title={`Findings: ${count('error')} errors, ${count('warning')} warnings, ${count('info')} remarks`}>
        {findings.value.length === 0 && <p>Nothing is wrong with this space.</p>}
        <ul class="findings">
          {findings.value.map((finding, i) => (
            <li key={i}>
              <button
                type="button"
                class={finding.severity}
                aria-pressed={looked.value === i}
                onClick={() => batch(() => {
                  looked.value = looked.value === i ? null : i;
                  if (looked.value !== null && finding.at.length === shown.axes.length) place(finding.at);
                })}
              >
                <span aria-label={finding.severity}>{k_marks[finding.severity]}</span>
                {all.rules.find((rule) => rule.id === finding.rule)?.title ?? finding.rule}
                {finding.clips.length > 0 && <small>{finding.clips.map((clip) => clip.replaceAll('_', ' ')).join(', ')}</small>}
              </button>
              {looked.value === i && (
                <p>
                  {finding.message} <small>{all.rules.find((rule) => rule.id === finding.rule)?.help}</small>
                </p>
              )}
            </li>
          ))}
        </ul>
      </Section>
      <Section title="Thresholds" aside={<button type="button" class="small" onClick={() => void resetThresholds()}>Reset</button>}>
        {k_thresholds.map(({ rule: id, high }) => {
          const rule = all.rules.find((each) => each.id === id), threshold = rule?.thresholds[0];
          if (!rule || !threshold) return null;
          return (
            <Slider
              key={id}
              label={rule.title}
              unit={threshold.unit}
              value={threshold.value}
              low={0}
              high={high}
              step={0.5}
              initial={threshold.initial}
              onInput={(value) => void setThreshold(id, threshold.name, value)}
            />
          );
        })}
      </Section>
      <Section title="Missing clips">
        <ul class="missing">
          {all.placeholders.filter((each) => each.space === shown.name).map((each, i) => (
            <li key={i} class={each.needed ? 'needed' : 'suggested'}>
              {each.text} <small>{each.needed ? 'needed' : 'suggested'}</small>
            </li>
          ))}
        </ul>
      </Section>
    </>
  );
}
