// What foot placement thinks, drawn over the picture: never hidden by what it is about.
import {
  BufferAttribute, BufferGeometry, CircleGeometry, Color, DoubleSide, Group, LineSegments, LineBasicMaterial, Matrix4,
  Mesh, MeshBasicMaterial, Quaternion, RingGeometry, Shape, ShapeGeometry, Vector3,
} from 'three';
import type { FrameLayout } from '../engine/messages';
import { k_side_colors } from './theme';

const k_axis_m = 0.16;
const k_up = new Vector3(0, 1, 0);
const k_axis_colors = [0xe5484d, 0x46a758, 0x3e63dd];

function overlayMaterial(color: number, opacity: number): MeshBasicMaterial {
  return new MeshBasicMaterial({ color, opacity, transparent: true, depthTest: false, side: DoubleSide, fog: false });
}

/** A sole from above: heel at the back, toes ahead (+z). */
function footprint(side: 0 | 1): ShapeGeometry {
  const inner = side === 0 ? -1 : 1;
  const shape = new Shape();
  shape.moveTo(0, -0.115);
  shape.bezierCurveTo(0.045 * inner, -0.115, 0.03 * inner, -0.02, 0.032 * inner, 0.03);
  shape.bezierCurveTo(0.036 * inner, 0.1, 0.025 * inner, 0.16, 0.005 * inner, 0.165);
  shape.bezierCurveTo(-0.04 * inner, 0.165, -0.058 * inner, 0.08, -0.045 * inner, 0.02);
  shape.bezierCurveTo(-0.034 * inner, -0.05, -0.045 * inner, -0.115, 0, -0.115);
  const geometry = new ShapeGeometry(shape, 8);
  geometry.applyMatrix4(new Matrix4().makeBasis(new Vector3(1, 0, 0), new Vector3(0, 0, 1), new Vector3(0, -1, 0)));
  return geometry;
}

function outline(of: ShapeGeometry): BufferGeometry {
  // The shape's own border: its first vertices run once around it.
  const positions = of.getAttribute('position');
  const points: number[] = [];
  for (let i = 0; i < positions.count; ++i)
    for (const k of [i, (i + 1) % positions.count]) points.push(positions.getX(k), positions.getY(k), positions.getZ(k));
  return new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
}

/** The marks of one foot. */
class FootMarks {
  readonly contacts = new Group();
  readonly foothold = new Group();
  readonly #dots: { fill: Mesh; ring: Mesh }[] = [];

  constructor(side: 0 | 1) {
    const color = k_side_colors[side];
    for (let i = 0; i < 2; ++i) {
      const fill = new Mesh(new CircleGeometry(0.028, 24).rotateX(-Math.PI / 2), overlayMaterial(color, 0.95));
      const ring = new Mesh(new RingGeometry(0.02, 0.028, 24).rotateX(-Math.PI / 2), overlayMaterial(color, 0.8));
      this.#dots.push({ fill, ring });
      this.contacts.add(fill, ring);
    }
    const sole = footprint(side);
    this.foothold.add(new Mesh(sole, overlayMaterial(color, 0.35)));
    this.foothold.add(new LineSegments(outline(sole), new LineBasicMaterial({ color, depthTest: false, transparent: true, fog: false })));
    this.foothold.children.forEach((child) => (child.renderOrder = 9));
    this.contacts.children.forEach((child) => (child.renderOrder = 10));
  }

  update(frame: Float32Array, at: number, places: FrameLayout['foot']): void {
    const contact = frame[at + places.contact] ?? 0;
    // Heel and ball: full where they carry, hollow where they are in the air.
    [0, 2].forEach((point, i) => {
      const dot = this.#dots[i]!;
      const from = at + places.sole + 3 * point;
      for (const each of [dot.fill, dot.ring]) each.position.set(frame[from]!, frame[from + 1]! + 0.004, frame[from + 2]!);
      dot.fill.visible = (contact & (i + 1)) !== 0;
      dot.ring.visible = !dot.fill.visible;
    });
    this.foothold.visible = frame[at + places.hasNext] === 1;
    this.foothold.position.fromArray(frame, at + places.next).addScaledVector(k_up, 0.006);
    const tilt = new Quaternion().setFromUnitVectors(k_up, new Vector3().fromArray(frame, at + places.nextNormal));
    this.foothold.quaternion.copy(tilt).multiply(new Quaternion().setFromAxisAngle(k_up, frame[at + places.nextYaw]!));
  }
}

export class Overlays {
  readonly group = new Group();
  readonly #feet = [new FootMarks(0), new FootMarks(1)];
  readonly #axes: LineSegments;
  readonly #hips: LineSegments;

  constructor() {
    this.#axes = segments(6, k_axis_colors.concat(k_axis_colors));
    this.#hips = segments(2, [...k_side_colors]);
    this.group.add(this.#axes, this.#hips, ...this.#feet.flatMap((foot) => [foot.contacts, foot.foothold]));
  }

  update(frame: Float32Array, layout: FrameLayout, ankles: [number, number], shown: { axes: boolean; hips: boolean; contacts: boolean; footholds: boolean }): void {
    this.#axes.visible = shown.axes;
    this.#hips.visible = shown.hips;
    const axes = this.#axes.geometry.getAttribute('position') as BufferAttribute;
    const hips = this.#hips.geometry.getAttribute('position') as BufferAttribute;
    const from = new Vector3(), along = new Vector3();
    this.#feet.forEach((foot, side) => {
      const at = layout.feet + side * layout.footFloats;
      foot.update(frame, at, layout.foot);
      foot.contacts.visible = shown.contacts;
      foot.foothold.visible &&= shown.footholds;
      from.fromArray(frame, at + layout.foot.hip).toArray(hips.array, 6 * side);
      from.fromArray(frame, at + layout.foot.ankle).toArray(hips.array, 6 * side + 3);
      const joint = layout.joints + 16 * (ankles[side] ?? 0);
      for (let axis = 0; axis < 3; ++axis) {
        from.fromArray(frame, joint + 12).toArray(axes.array, 18 * side + 6 * axis);
        along.fromArray(frame, joint + 4 * axis).multiplyScalar(k_axis_m).add(from).toArray(axes.array, 18 * side + 6 * axis + 3);
      }
    });
    axes.needsUpdate = hips.needsUpdate = true;
  }
}

/** Lines from the first of two points to the second, a colour each. */
function segments(count: number, colors: number[]): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(6 * count), 3));
  const rgb = new Float32Array(6 * count);
  colors.forEach((color, i) => [0, 1].forEach((end) => new Color(color).toArray(rgb, 6 * i + 3 * end)));
  geometry.setAttribute('color', new BufferAttribute(rgb, 3));
  const lines = new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true, fog: false }));
  lines.frustumCulled = false;
  lines.renderOrder = 11;
  return lines;
}
