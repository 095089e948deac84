// What the graph did over the last seconds: which states played, and what happened.
import { useEffect, useRef } from 'preact/hooks';
import { effect } from '@preact/signals';
import { graph, k_graph_history_s, live, past, shownMachine } from '../graph';
import { isDark } from '../view/theme';
import { token } from './strip';

const k_name_px = 78, k_tick_px = 16;

function draw(canvas: HTMLCanvasElement): void {
  const width = canvas.clientWidth, height = canvas.clientHeight, scale = devicePixelRatio;
  const known = graph.value, machine = known?.machines[shownMachine.value];
  if (width === 0 || height === 0 || !known) return;
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  const context = canvas.getContext('2d')!;
  context.scale(scale, scale);
  context.font = '11px system-ui, sans-serif';
  context.textBaseline = 'middle';
  const end = past.moments.at(-1)?.time ?? 0, right = width - 14;
  const x = (time: number) => right - ((end - time) / k_graph_history_s) * (right - k_name_px);
  const states = machine?.states ?? [];
  const lane = Math.min(22, (height - k_tick_px - 4) / (states.length + 1));
  const ink = token('--ink-2'), line = token('--line'), accent = token('--accent');
  context.fillStyle = ink;
  for (let second = 0; second <= k_graph_history_s; second += 2) {
    context.fillStyle = line;
    context.fillRect(x(end - second), 2, 1, height - k_tick_px);
    context.fillStyle = ink;
    context.textAlign = 'center';
    context.fillText(second === 0 ? 'now' : `-${second} s`, Math.min(x(end - second), width - 18), height - 7);
  }
  context.textAlign = 'right';
  states.forEach((state, s) => {
    const top = 3 + s * lane;
    context.fillStyle = ink;
    context.fillText(state.name.slice(0, 12), k_name_px - 8, top + lane / 2);
    context.fillStyle = accent;
    for (let m = 1; m < past.moments.length; ++m) {
      const moment = past.moments[m]!, whole = moment.weights[machine!.node] ?? 0;
      const share = whole > 0 ? (moment.weights[state.node] ?? 0) / whole : 0;
      if (share < 0.005) continue;
      const from = Math.max(x(past.moments[m - 1]!.time), k_name_px), size = Math.max(share * (lane - 4), 1);
      context.fillRect(from, top + (lane - 2 - size), x(moment.time) - from + 0.6, size);
    }
  });
  const top = 3 + states.length * lane;
  context.fillStyle = ink;
  context.fillText('events', k_name_px - 8, top + lane / 2);
  context.textAlign = 'left';
  past.events.forEach(({ name, time }, i) => {
    const at = x(time);
    if (at < k_name_px) return;
    context.fillStyle = /left/.test(name) ? token('--left') : /right/.test(name) ? token('--right') : accent;
    context.fillRect(at, top + 2, 2, lane - 4);
    // As much of its name as fits before the next one.
    const room = Math.min(x(past.events[i + 1]?.time ?? end), right) - at - 8;
    const words = name.split('_');
    const text = [words.join(' '), words[0]!].find((each) => context.measureText(each).width < room);
    if (text) context.fillText(text, at + 5, top + lane / 2);
  });
}

export function GraphStrip() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const element = canvas.current!;
    const watch = new ResizeObserver(() => draw(element));
    watch.observe(element);
    const stop = effect(() => {
      void live.value;
      void isDark.value;
      void shownMachine.value;
      requestAnimationFrame(() => draw(element));
    });
    return () => {
      stop();
      watch.disconnect();
    };
  }, []);
  const said = live.value && graph.value ? past.events.slice(-3).map(({ name, time }) => `${name} at ${time.toFixed(1)} s`).join(', ') : '';
  return (
    <figure class="strip">
      <figcaption>States and events</figcaption>
      <div><canvas ref={canvas} class="events" role="img" aria-label={`States over the last seconds, and events: ${said}`} /></div>
    </figure>
  );
}
