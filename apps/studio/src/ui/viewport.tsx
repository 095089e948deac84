// The picture with what lies over it.
import { useEffect, useRef } from 'preact/hooks';
import { effect } from '@preact/signals';
import { facts, failForGood, frame, mesh, notice, terrain, tick } from '../session';
import { readInput } from '../input';
import { cameraView, ghosts, overlays, workspace } from '../settings';
import { Picture } from '../view/picture';
import { runPicture } from '../view/picture_loop';
import { palette } from '../view/theme';
import { Handles, placeHandles } from './handles';
import { Stick } from './stick';
import { Readout } from './readout';
import { clipColors } from '../workspaces/space_state';

/** Runs the picture until it is told to stop. */
function run(canvas: HTMLCanvasElement): () => void {
  const picture = new Picture(canvas);
  const stops = [
    effect(() => picture.paint(palette.value)),
    effect(() => {
      if (facts.value && mesh.value) picture.showCharacter(facts.value, mesh.value);
    }),
    effect(() => {
      if (terrain.value) picture.showTerrain(terrain.value);
    }),
    effect(() => picture.look(cameraView.value)),
  ];
  const stop = runPicture(canvas, picture, (seconds) => {
    readInput();
    const shown = {
      axes: overlays.axes.value,
      hips: overlays.hips.value,
      contacts: overlays.contacts.value,
      footholds: overlays.footholds.value,
      ghosts: ghosts.value && workspace.value === 'space' ? clipColors.value : null,
    };
    // First the picture of the frame that is here; the next one is made meanwhile.
    const tired = picture.draw(frame, Math.min(seconds, 0.25), shown);
    placeHandles(frame, (at) => picture.place(at));
    tick(seconds);
    return tired;
  });
  return () => {
    stops.forEach((each) => each());
    stop();
  };
}

export function Viewport() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    try {
      return run(canvas.current!);
    } catch (error) {
      failForGood(
        'There is no picture',
        `The studio draws with WebGL 2, which this browser does not offer. Switch on hardware acceleration in its ` +
          `settings, or use another browser. (${error instanceof Error ? error.message : String(error)})`,
      );
      return undefined;
    }
  }, []);
  return (
    <div class="viewport">
      <canvas ref={canvas} tabIndex={0} aria-label="The character on its course. Steer with W, A, S and D; drag to look from elsewhere." />
      {workspace.value === 'gait' && <Handles />}
      <Readout />
      <Stick />
      <p class="notice" role="status">{notice.value}</p>
    </div>
  );
}
