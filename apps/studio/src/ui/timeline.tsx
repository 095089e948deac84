// The one timeline: play, step, slow motion, and what just happened.
import { frameCount, playing, restart, shownSeconds, showsCrowd, showsGraph } from '../session';
import { singleStep } from '../input';
import { k_rates, slowness } from '../settings';
import { Segmented } from './controls';
import { CostStrip } from './cost_strip';
import { GraphStrip } from './graph_strip';
import { Strip } from './strip';

const k_rate_names: Record<number, string> = { 1: '1×', 2: '½×', 4: '¼×', 10: '⅒×' };

function Clock() {
  void frameCount.value;
  return <output class="clock">{shownSeconds().toFixed(2)} s</output>;
}

export function Timeline() {
  return (
    <footer class="timeline" aria-label="Timeline">
      <div class="transport">
        <button type="button" title="Back to the start (R)" aria-label="Back to the start" onClick={() => void restart()}>
          <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M4 4h2v12H4zM16 4v12L7 10z" /></svg>
        </button>
        <button
          type="button"
          class="play"
          title="Play or pause (Space)"
          aria-label={playing.value ? 'Pause' : 'Play'}
          onClick={() => (playing.value = !playing.value)}
        >
          <svg viewBox="0 0 20 20" aria-hidden="true">
            <path d={playing.value ? 'M5 4h4v12H5zM11 4h4v12h-4z' : 'M6 3.5v13L16.5 10z'} />
          </svg>
        </button>
        <button type="button" title="One step (.)" aria-label="One step" onClick={singleStep}>
          <svg viewBox="0 0 20 20" aria-hidden="true"><path d="M5 4v12l8-6zM14 4h2v12h-2z" /></svg>
        </button>
        <Segmented
          label="Pace"
          choices={k_rates.map((value) => ({ value: value as number, label: k_rate_names[value]!, hint: value === 1 ? 'As it is' : `A second lasts ${value} seconds` }))}
          value={slowness.value}
          onChange={(value) => (slowness.value = value)}
        />
        <Clock />
      </div>
      {showsCrowd() ? <CostStrip /> : showsGraph() ? <GraphStrip /> : <Strip />}
    </footer>
  );
}
