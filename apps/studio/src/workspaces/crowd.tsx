// Crowd: from one to ten thousand of the character, and what animating them costs apart from drawing them.
import { effect } from '@preact/signals';
import { useEffect, useId, useRef } from 'preact/hooks';
import { costs, crowd, lookFrom, makeCrowd, medianAnimation, posed, texels, tickCrowd } from '../crowd';
import { facts as character, failForGood, frameCount, notice } from '../session';
import { crowdCount, crowdFeet, crowdGround, crowdView, k_most_crowd, lastingPoses } from '../settings';
import { CrowdPicture } from '../view/crowd';
import { runPicture } from '../view/picture_loop';
import { palette } from '../view/theme';
import { Choose, Section, Segmented, Toggle } from '../ui/controls';

const k_counts = [1, 10, 100, 500, 2000, 10000];
const k_ground_names: Record<string, string> = { flat: 'Flat', hills: 'Hills', slope: 'A slope', kerbs: 'Kerbs' };
const k_readout_ms = 250;
const grouped = (value: number) => value.toLocaleString('en').replaceAll(',', ' ');

let picture: CrowdPicture | undefined;

/** Runs the picture until it is told to stop. */
function run(canvas: HTMLCanvasElement): () => void {
  const own = new CrowdPicture(canvas);
  picture = own;
  const stops = [
    effect(() => own.paint(palette.value)),
    effect(() => {
      if (crowd.value) own.show(crowd.value.facts, crowd.value.mesh, crowd.value.ground);
    }),
    effect(() => own.look(crowdView.value)),
  ];
  const stop = runPicture(canvas, own, (seconds) => {
    const tired = own.draw(texels, seconds);
    lookFrom(own.eye);
    tickCrowd(seconds, own.renderingMs);
    return tired;
  });
  return () => {
    stops.forEach((each) => each());
    stop();
    picture = undefined;
  };
}

function picturesASecond(): number {
  const times = costs.time.slice(-30), span = times.length > 1 ? times.at(-1)! - times[0]! : 0;
  return span > 0 ? (times.length - 1) / span : 0;
}

let lastText = 0, text: { name: string; value: string; hint: string }[] = [];
/** Slow enough to be read. */
function costLines(): typeof text {
  const now = performance.now(), count = crowd.value?.facts.count ?? 0;
  if (now - lastText < k_readout_ms && text.length > 0) return text;
  lastText = now;
  const animation = medianAnimation();
  const drawn = picture?.drawn ?? [];
  const seen = drawn.reduce((sum, each) => sum + each.characters, 0);
  text = [
    { name: 'animation', value: `${animation.toFixed(2)} ms a frame`, hint: `Moving ${grouped(count)} and posing ${grouped(posed.value)} of them; the middle of the last 30 frames` },
    { name: '', value: `${((1000 * animation) / Math.max(count, 1)).toFixed(2)} µs each, ${grouped(posed.value)} posed`, hint: '' },
    { name: 'drawing', value: `${(picture?.renderingMs ?? 0).toFixed(1)} ms a picture`, hint: 'From the first call to the last pixel, measured in every 20th picture' },
    { name: '', value: `${grouped(seen)} in sight, ${picturesASecond().toFixed(0)} pictures/s`, hint: '' },
  ];
  return text;
}

function CostReadout() {
  void frameCount.value;
  if (!crowd.value) return null;
  return (
    <div class="readout costs">
      <dl>
        {costLines().map(({ name, value, hint }, i) => (
          <div key={i} title={hint}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}

export function CrowdViewport() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    try {
      return run(canvas.current!);
    } catch (error) {
      failForGood('There is no picture', `The studio draws with WebGL 2, which this browser does not offer. (${error instanceof Error ? error.message : String(error)})`);
      return undefined;
    }
  }, []);
  return (
    <div class="viewport">
      <canvas ref={canvas} tabIndex={0} aria-label="A crowd of the character, going around in rings. Drag to look from elsewhere, scroll to come closer." />
      <CostReadout />
      <p class="notice" role="status">{notice.value}</p>
    </div>
  );
}

function Levels() {
  void frameCount.value;
  const drawn = picture?.drawn ?? [];
  return (
    <table class="figures">
      <thead class="hidden">
        <tr>
          <th scope="col">Mesh</th>
          <th scope="col">Characters in sight</th>
        </tr>
      </thead>
      <tbody>
        {drawn.map(({ triangles, characters }) => (
          <tr key={triangles}>
            <th scope="row">{grouped(triangles)} triangles</th>
            <td>{grouped(characters)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

export function CrowdPanel() {
  const id = useId();
  const change = (count: number) => {
    crowdCount.value = Math.min(Math.max(Math.round(count), 1), k_most_crowd);
    void makeCrowd(false);
  };
  return (
    <>
      <Section title="How many">
        <div class="slider">
          <label for={id}>Characters</label>
          <output for={id}>{grouped(crowdCount.value)}</output>
          <input
            id={id}
            type="range"
            min={0}
            max={Math.log10(k_most_crowd)}
            step={0.01}
            value={Math.log10(crowdCount.value)}
            aria-valuetext={`${crowdCount.value} characters`}
            onInput={(event) => change(10 ** Number(event.currentTarget.value))}
            onDblClick={() => change(500)}
            title="Double-click: 500"
          />
        </div>
        <div class="counts">
          {k_counts.map((count) => (
            <button key={count} type="button" class="small" aria-pressed={crowdCount.value === count} onClick={() => change(count)}>
              {grouped(count)}
            </button>
          ))}
        </div>
        <p class="note">{character.value ? `${character.value.name}: ${character.value.joints.length} joints, ${character.value.clipNames.length} clips.` : ''}</p>
      </Section>
      <Section title="Ground">
        <Choose
          label="They go on"
          choices={(crowd.value?.facts.grounds ?? [crowdGround.value]).map((value) => ({ value, label: k_ground_names[value] ?? value }))}
          value={crowdGround.value}
          onChange={(value) => {
            crowdGround.value = value;
            void makeCrowd(false);
          }}
        />
        <Toggle label="Feet are laid on it" hint="Off: the body follows the ground, the legs stay as animated" on={crowdFeet.value} onChange={(on) => (crowdFeet.value = on)} />
        <p class="note">{crowdGround.value === 'flat' ? 'On flat ground the clips’ own feet stand.' : 'A foot’s plane is asked for once a step, eight characters at a time; switch it off to see what it costs.'}</p>
      </Section>
      <Section title="Animation">
        <Toggle
          label="Poses last longer far away"
          hint="Beyond 12, 30 and 60 m a pose lasts for two, three and four frames; everybody goes on in each of them"
          on={lastingPoses.value}
          onChange={(on) => (lastingPoses.value = on)}
        />
        <p class="note">
          Each character has a speed, a turn and a phase of its own, blends up to three clips and is posed in the engine's worker, eight at a time: what a game
          would pay on one core.
        </p>
      </Section>
      <Section title="Drawing">
        <Segmented
          label="Camera"
          choices={[
            { value: 'above', label: 'From above' },
            { value: 'among', label: 'Among them' },
          ]}
          value={crowdView.value}
          onChange={(value) => (crowdView.value = value)}
        />
        <Levels />
        <p class="note">One call draws all who wear the same mesh; within 5 m the fine one, within 18 m a coarse one.</p>
      </Section>
    </>
  );
}
