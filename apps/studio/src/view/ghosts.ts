// The clips that the character's pose is blended from, each as a figure one can see through.
import { Color, Group } from 'three';
import type { CharacterMesh, FrameLayout } from '../engine/messages';
import { CharacterView } from './character';

export class Ghosts {
  readonly group = new Group();
  #views: CharacterView[] = [];

  show(mesh: CharacterMesh, most: number): void {
    this.dispose();
    for (let i = 0; i < most; ++i) {
      const view = new CharacterView(mesh);
      view.fade();
      this.#views.push(view);
      this.group.add(view.mesh);
    }
  }

  /** `colors`: one a clip; null: they are not shown. */
  update(frame: Float32Array, layout: FrameLayout, colors: readonly string[] | null): void {
    this.#views.forEach((view, i) => {
      const at = layout.ghosts + i * layout.ghostFloats;
      const weight = frame[at + layout.ghost.weight] ?? 0;
      view.mesh.visible = colors !== null && weight > 0 && weight < 1;
      if (!colors || !view.mesh.visible) return;
      view.pose(frame, at + layout.ghost.joints);
      view.mesh.material.color.copy(new Color(colors[frame[at + layout.ghost.clip] ?? 0] ?? '#888888'));
      view.mesh.material.opacity = 0.25 + 0.45 * weight;
    });
  }

  dispose(): void {
    for (const view of this.#views) view.dispose();
    this.#views = [];
    this.group.clear();
  }
}
