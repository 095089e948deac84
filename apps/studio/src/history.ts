// The last seconds of both feet, for the strip under the picture.
import type { FrameLayout } from './engine/messages';

export const k_history_s = 6;

export class History {
  readonly time: number[] = [];
  /** [cm] by foot: of the sole over the ground under it. */
  readonly clearance: [number[], number[]] = [[], []];
  /** By foot: 0 lifted, 1 heel, 2 toes, 3 flat. */
  readonly contact: [number[], number[]] = [[], []];

  clear(): void {
    for (const list of [this.time, ...this.clearance, ...this.contact]) list.length = 0;
  }

  add(frame: Float32Array, layout: FrameLayout): void {
    const now = frame[layout.time] ?? 0;
    if (this.time.length > 0 && now <= this.time[this.time.length - 1]!) return;
    this.time.push(now);
    for (const side of [0, 1] as const) {
      const foot = layout.feet + side * layout.footFloats;
      this.clearance[side].push((frame[foot + layout.foot.clearance] ?? 0) * 100);
      this.contact[side].push(frame[foot + layout.foot.contact] ?? 0);
    }
    let old = 0;
    while (this.time[old]! < now - k_history_s) ++old;
    if (old > 0) for (const list of [this.time, ...this.clearance, ...this.contact]) list.splice(0, old);
  }
}
