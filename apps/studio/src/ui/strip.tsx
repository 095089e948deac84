// How high each foot is over the ground, and when it stands, over the last seconds.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { history } from '../session';
import { k_history_s } from '../history';
import { k_side_colors } from '../view/theme';
import { usePlotStrip } from './plot_strip';

const k_redraw_ms = 60;
const k_lane = 7; // [px]
const k_names = ['Left', 'Right'];
export const css = (color: number) => `#${color.toString(16).padStart(6, '0')}`;
export const token = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** Lanes along the bottom: full height where the sole is flat, the lower half for the heel, the upper for the toes. */
function drawContacts(plot: uPlot): void {
  const { ctx } = plot;
  const { left, top, width, height } = plot.bbox;
  const lane = k_lane * devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  for (const side of [0, 1] as const) {
    ctx.fillStyle = css(k_side_colors[side]);
    const base = top + height - (2 - side) * (lane + 3 * devicePixelRatio);
    for (let i = 0; i + 1 < history.time.length; ++i) {
      const contact = history.contact[side][i]!;
      if (contact === 0) continue;
      const from = plot.valToPos(history.time[i]!, 'x', true), to = plot.valToPos(history.time[i + 1]!, 'x', true);
      const upper = contact === 1 ? 0.5 : 0, share = contact === 3 ? 1 : 0.5;
      ctx.fillRect(from, base + upper * lane, to - from + 0.6, share * lane);
    }
  }
  ctx.restore();
}

/** Limits that leave the lanes a place of their own under the curves. */
function makeRoom(low: number, high: number): [number, number] {
  const top = Math.max(high ?? 0, 12) * 1.05, bottom = Math.min(low ?? 0, 0);
  return [bottom - 0.75 * (top - bottom), top];
}

function makePlot(box: HTMLElement): uPlot {
  const axis = { stroke: () => token('--ink-2'), grid: { stroke: () => token('--line'), width: 1 }, ticks: { show: false } };
  return new uPlot(
    {
      width: Math.max(box.clientWidth, 100),
      height: Math.max(box.clientHeight, 60),
      legend: { show: false },
      cursor: { show: false },
      padding: [6, 24, 0, 0],
      scales: { x: { time: false }, y: { range: (_, low, high) => makeRoom(low, high) } },
      axes: [
        { ...axis, size: 22, space: 70, font: '11px system-ui', values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
        { ...axis, size: 46, space: 22, font: '11px system-ui', values: (_, ticks) => ticks.map((tick) => (tick < 0 ? '' : `${tick} cm`)) },
      ],
      series: [{}, ...k_side_colors.map((color, side) => ({ label: k_names[side], stroke: css(color), width: 2, points: { show: false } }))],
      hooks: { draw: [drawContacts] },
    },
    [[], [], []],
    box,
  );
}

function show(plot: uPlot): void {
  const end = Math.max(history.time[history.time.length - 1] ?? 0, k_history_s);
  plot.setData([history.time, ...history.clearance], false);
  plot.setScale('x', { min: end - k_history_s, max: end });
}

export function Strip() {
  const box = usePlotStrip(makePlot, show, k_redraw_ms, () => history.time.length <= 1);
  return (
    <figure class="strip">
      <figcaption>
        Feet over the ground <span class="key left">left</span> <span class="key right">right</span>
        <span class="quiet"> bars: on the ground</span>
      </figcaption>
      <div ref={box} />
    </figure>
  );
}
