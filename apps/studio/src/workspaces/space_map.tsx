// The triangulation as a map: clips, cells, findings, missing clips, colours of the probe, and a puck to drag.
import { signal } from '@preact/signals';
import { project } from '../bench';
import type { Finding, Heat, SpaceFacts } from '../engine/messages';
import { ghosts } from '../settings';
import { awayFrom, sliceOf } from './slice';
import { colorOf, findings, look, looked, place, puck, shownMap, space, weights } from './space_state';

/** [px] of the map; its border is for the axes. */
const size = signal({ width: 600, height: 500 });
const k_left = 58, k_right = 34, k_top = 30, k_bottom = 50;
const k_beside = 15; // [px] a finding's mark stands beside the missing clip that it asks for
const k_faint = 0.2; // of what lies on other slices

interface Frame {
  x: (value: number) => number;
  y: (value: number) => number;
  /** Places on the axes of the map; others stay where they are. */
  back: (x: number, y: number) => number[];
}

function frameOf(shown: SpaceFacts): Frame {
  const { width, height } = size.value;
  const [across, up] = [shown.axes[0]!, shown.axes[1]];
  const wide = width - k_left - k_right, high = height - k_top - k_bottom;
  const x = (value: number) => k_left + ((value - across.low) / (across.high - across.low || 1)) * wide;
  const y = (value: number) => (up ? k_top + high - ((value - up.low) / (up.high - up.low || 1)) * high : k_top + high / 2);
  const inside = (share: number) => Math.min(Math.max(share, 0), 1);
  const back = (px: number, py: number) => {
    const at = [across.low + inside((px - k_left) / wide) * (across.high - across.low)];
    if (up) at.push(up.low + inside((k_top + high - py) / high) * (up.high - up.low));
    return [...at, ...puck.value.slice(at.length)];
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
  if (!(high > low)) return [low];
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

/** The cells of the probe that lie nearest to the slice, in colours from good to bad. */
function HeatLayer({ map, frame }: { map: Heat; frame: Frame }) {
  const [wide, high] = [map.steps[0] ?? 0, map.steps[1]];
  const color = (value: number) => {
    const share = (value - map.least) / (map.full - map.least || 1);
    return map.scale[Math.min(Math.max(Math.floor(share * map.scale.length), 0), map.scale.length - 1)];
  };
  const near = map.cells.filter(({ at }) => at.every((value, axis) => axis < 2 || Math.abs(value - puck.value[axis]!) <= map.steps[axis]! / 2 + 1e-6));
  return (
    <g class="heat">
      {near.map(({ at, value, text }, i) => {
        const x = frame.x(at[0]! - wide / 2), y = high === undefined ? frame.y(0) - 20 : frame.y(at[1]! + high / 2);
        const width = frame.x(at[0]! + wide / 2) - x + 0.5, height = high === undefined ? 40 : frame.y(at[1]! - high / 2) - y + 0.5;
        return (
          <rect key={i} x={x} y={y} width={width} height={height} fill={value === null ? 'none' : color(value)}>
            <title>{`${text}: ${value === null ? 'not measured, no foot stands' : `${value.toFixed(map.decimals)} ${map.unit}`}`}</title>
          </rect>
        );
      })}
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

const k_letter = 6.9, k_line = 13; // [px] of names
const isAtTheEdge = (x: number) => x > size.value.width - 100;

/** Clips whose names can be read: those that play first, then those that cover no other. */
function namesWithRoom(all: { clip: string; place: [number, number]; weight: number }[]): Set<string> {
  const boxes: [number, number, number][] = [];
  const named = new Set<string>();
  for (const { clip, place: [x, y] } of [...all].sort((a, b) => b.weight - a.weight)) {
    const width = k_letter * clip.length, left = isAtTheEdge(x) ? x - 8 - width : x + 8;
    if (boxes.some(([from, to, line]) => left < to && left + width > from && Math.abs(y - line) < k_line)) continue;
    boxes.push([left, left + width, y]);
    named.add(clip);
  }
  return named;
}

function Samples({ shown, at, far }: { shown: SpaceFacts; at: (values: number[]) => [number, number]; far: (values: number[]) => number }) {
  const playing = new Map(weights.value.map((each) => [each.clip, each.weight]));
  const named = namesWithRoom(shown.samples.map(({ clip, at: place }) => ({ clip, place: at(place), weight: playing.get(clip) ?? 0 })));
  return (
    <g class="samples">
      {shown.samples.map((sample) => {
        const [x, y] = at(sample.at), weight = playing.get(sample.clip) ?? 0;
        const flip = isAtTheEdge(x);
        return (
          <g key={sample.clip} class={weight > 0.005 ? 'plays' : ''} opacity={far(sample.at)}>
            <circle
              class="weight"
              cx={x}
              cy={y}
              r={5 + 17 * Math.sqrt(Math.max(weight, 0))}
              style={ghosts.value ? { fill: colorOf(sample.clip) } : {}}
            />
            <circle cx={x} cy={y} r="4" />
            <title>{sample.clip}</title>
            {named.has(sample.clip) && <text x={x + (flip ? -8 : 8)} y={y - 7} text-anchor={flip ? 'end' : 'start'}>{sample.clip.replaceAll('_', ' ')}</text>}
          </g>
        );
      })}
    </g>
  );
}

export function HeatKey() {
  const map = shownMap.value;
  if (!map) return null;
  return (
    <p class="heat-key">
      <span>{map.least.toFixed(map.decimals)}</span>
      <i style={{ background: `linear-gradient(90deg, ${map.scale.flatMap((color, i) => [`${color} ${(100 * i) / map.scale.length}%`, `${color} ${(100 * (i + 1)) / map.scale.length}%`]).join(', ')})` }} />
      <span>{map.full.toFixed(map.decimals)} {map.unit}</span>
    </p>
  );
}

export function SpaceMap() {
  const shown = space.value;
  if (!shown) return <div class="map" ref={watchSize} />;
  const { width, height } = size.value;
  const frame = frameOf(shown);
  const ranges = shown.axes.map(({ low, high }) => high - low);
  const missing = (project.value?.placeholders ?? []).filter((each) => each.space === shown.name && each.axes.length === shown.axes.length);
  /** What is asked for beyond the axes stands at their ends. */
  const at = (values: number[]): [number, number] => [
    Math.min(Math.max(frame.x(values[0] ?? 0), k_left), width - k_right),
    Math.min(Math.max(frame.y(values[1] ?? 0), k_top), height - k_bottom),
  ];
  const far = (values: number[]) => Math.max(1 - 4 * awayFrom(values, puck.value, ranges), k_faint);
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
        class={shownMap.value ? 'coloured' : ''}
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
        {shownMap.value && <HeatLayer map={shownMap.value} frame={frame} />}
        <g class="cells">
          {shown.cells.map((cell, i) => (
            <polygon key={i} points={sliceOf(cell.map((corner) => shown.samples[corner]!.at), puck.value).map((point) => at(point).join(',')).join(' ')} />
          ))}
        </g>
        <g class="placeholders">
          {missing.map((each, i) => (
            <g key={i} class={each.needed ? 'needed' : 'suggested'} opacity={far(each.at)} transform={`translate(${at(each.at).join(' ')})`}>
              <rect x="-8" y="-8" width="16" height="16" rx="3" />
              <path d="M-4 0H4M0-4V4" />
              <title>{`${each.needed ? 'Needed' : 'Suggested'}: ${each.text}`}</title>
            </g>
          ))}
        </g>
        <Samples shown={shown} at={at} far={far} />
        <g>
          {findings.value.map((finding) => {
            if (finding.at.length !== shown.axes.length) return null;
            const [x, y] = at(finding.at);
            const taken = missing.some((each) => Math.hypot(at(each.at)[0] - x, at(each.at)[1] - y) < k_beside);
            return (
              <g key={finding.id} opacity={far(finding.at)} onClick={() => looked.value !== finding.id && look(finding)}>
                <Mark finding={finding} x={taken ? x - k_beside : x} y={taken ? y - k_beside : y} on={looked.value === finding.id} />
              </g>
            );
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
