// What a crowd cost over the last seconds: animating it, and drawing it.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { costs, k_cost_history_s } from '../crowd';
import { k_side_colors } from '../view/theme';
import { usePlotStrip } from './plot_strip';
import { css, token } from './strip';

const k_redraw_ms = 100;
const k_decades_ms = [0.1, 1, 10, 100, 1000, 10000];
const k_names = ['Animation', 'Drawing'];

function makePlot(box: HTMLElement): uPlot {
  const axis = { stroke: () => token('--ink-2'), grid: { stroke: () => token('--line'), width: 1 }, ticks: { show: false } };
  return new uPlot(
    {
      width: Math.max(box.clientWidth, 100),
      height: Math.max(box.clientHeight, 60),
      legend: { show: false },
      cursor: { show: false },
      padding: [6, 24, 0, 0],
      scales: { x: { time: false }, y: { auto: true, distr: 3, range: (_, __, high) => [k_decades_ms[0]!, 10 ** Math.ceil(Math.log10(Math.max(high ?? 0, 10)))] } },
      axes: [
        { ...axis, size: 22, space: 70, font: '11px system-ui', values: (_, ticks) => ticks.map((tick) => `${tick} s`) },
        { ...axis, size: 56, font: '11px system-ui', splits: (plot) => k_decades_ms.filter((each) => each <= plot.scales['y']!.max!), values: (_, ticks) => ticks.map((tick) => (tick === null ? '' : `${tick} ms`)) }, // uPlot takes out every other one of a log scale's
      ],
      series: [{}, ...k_side_colors.map((color, i) => ({ label: k_names[i], stroke: css(color), width: 2, spanGaps: true, points: { show: false } }))],
    },
    [[], [], []],
    box,
  );
}

function show(plot: uPlot): void {
  const end = costs.time.at(-1) ?? 0;
  const shown = (list: (number | null)[]) => list.map((each) => (each === null || each <= 0 ? null : Math.max(each, k_decades_ms[0]!)));
  plot.setData([costs.time.map((time) => time - end), shown(costs.animation), shown(costs.rendering)] as uPlot.AlignedData, false);
  plot.setScale('x', { min: -k_cost_history_s, max: 0 });
}

export function CostStrip() {
  const box = usePlotStrip(makePlot, show, k_redraw_ms);
  return (
    <figure class="strip">
      <figcaption>
        Cost of a frame <span class="key left">animation</span> <span class="key right">drawing</span>
      </figcaption>
      <div ref={box} />
    </figure>
  );
}
