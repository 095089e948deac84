// What the character does now, in words and numbers, in a corner of the picture.
import { facts, frame, frameCount, steered } from '../session';

const k_contacts = ['in the air', 'on the heel', 'on the toes', 'flat'];

export function Readout() {
  void frameCount.value;
  const known = facts.value;
  if (!known || frame.length === 0) return null;
  const { layout } = known;
  const at = (place: number) => frame[place] ?? 0;
  const limit = at(layout.speedLimit), turn = Math.round(at(layout.turn));
  return (
    <div class="readout">
      <dl>
        <div>
          <dt>speed</dt>
          <dd>{at(layout.speed).toFixed(2)} m/s</dd>
        </div>
        <div>
          <dt>turn</dt>
          <dd>{turn === 0 ? '0' : `${Math.abs(turn)}° ${turn > 0 ? 'left' : 'right'}`}</dd>
        </div>
        {([0, 1] as const).map((side) => {
          const foot = layout.feet + side * layout.footFloats;
          return (
            <div key={side} class={side === 0 ? 'left' : 'right'}>
              <dt>{side === 0 ? 'left' : 'right'}</dt>
              <dd>{k_contacts[at(foot + layout.foot.contact)]}{at(foot + layout.foot.planted) === 1 ? ', held' : ''}</dd>
            </div>
          );
        })}
      </dl>
      {limit > 0 && <p>The ground ahead allows {limit.toFixed(1)} m/s</p>}
      {!steered.value && <p class="hint">Take over: <kbd>W</kbd><kbd>A</kbd><kbd>S</kbd><kbd>D</kbd></p>}
    </div>
  );
}
