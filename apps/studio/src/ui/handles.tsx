// Handles on the body that is shaped: each pulls a length of it longer or shorter, as the slider of that name does.
import { Vector3 } from 'three';
import { useEffect, useRef } from 'preact/hooks';
import { signal } from '@preact/signals';
import { part, rigs, shape, shapesBody, stepOf } from '../gait';
import { facts } from '../session';
import { gaitWork } from '../settings';

interface Handle {
  /** Of the template. */
  parameter: string;
  /** The joint that it is at, and those in whose middle the length begins; none: the ground, up to the crown. */
  at: string;
  from: string[];
}

const k_crown = 0.135; // of the stature, from the head's joint: just above it
const k_least_px = 40; // of a length that is seen from its end
const both = (make: (side: string) => Handle) => ['Left', 'Right'].map(make);
const k_handles: Handle[] = [
  { parameter: 'stature', at: 'Head', from: [] },
  { parameter: 'trunk', at: 'Neck', from: ['Hips'] },
  ...both((side) => ({ parameter: 'shoulders', at: `${side}UpperArm`, from: ['LeftUpperArm', 'RightUpperArm'] })),
  ...both((side) => ({ parameter: 'arm', at: `${side}Hand`, from: [`${side}UpperArm`] })),
  ...both((side) => ({ parameter: 'hips', at: `${side}UpperLeg`, from: ['LeftUpperLeg', 'RightUpperLeg'] })),
  ...both((side) => ({ parameter: 'leg', at: `${side}LowerLeg`, from: [`${side}UpperLeg`] })),
  ...both((side) => ({ parameter: 'foot', at: `${side}Toes`, from: [`${side}Foot`] })),
];

type Place = [x: number, y: number];
/** In the picture [px]; null: it is not in sight. */
type Project = (at: Vector3) => Place | null;

const known = (name: string) => rigs.value.find((each) => each.name === gaitWork.value?.rig?.name)?.parameters.find((each) => each.name === name);
const valueOf = (name: string) => gaitWork.value?.rig?.values[name] ?? known(name)?.initial ?? 0;

/** Where a handle and the beginning of its length are in the world. */
function ends({ at, from }: Handle, frame: Float32Array): [Vector3, Vector3] | null {
  const { joints, layout } = facts.value!;
  const matrixAt = (name: string) => layout.joints + 16 * joints.indexOf(name);
  if ([at, ...from].some((name) => !joints.includes(name))) return null;
  const place = (name: string) => new Vector3().fromArray(frame, matrixAt(name) + 12);
  if (from.length > 0) return [place(at), from.map(place).reduce((sum, each) => sum.add(each)).divideScalar(from.length)];
  const up = new Vector3().fromArray(frame, matrixAt(at) + 4);
  return [place(at).addScaledVector(up, k_crown * valueOf('stature')), new Vector3().fromArray(frame, layout.root)];
}

const places = new Map<Handle, [at: Place, from: Place]>();
let drawn: SVGSVGElement | null = null;

/** Puts all handles where the body is in the picture; called once a picture. */
export function placeHandles(frame: Float32Array, project: Project): void {
  if (!drawn || !facts.value || frame.length === 0) return;
  let height = 0; // of the body, in the picture
  k_handles.forEach((handle, i) => {
    const group = drawn!.children[i] as SVGGElement, world = ends(handle, frame);
    const at = world && project(world[0]), from = world && project(world[1]);
    group.style.display = at && from ? '' : 'none';
    if (!at || !from) return;
    places.set(handle, [at, from]);
    height = Math.max(height, Math.abs(at[1] - from[1]));
    group.setAttribute('transform', `translate(${at[0].toFixed(1)} ${at[1].toFixed(1)})`);
    const line = group.firstElementChild!;
    line.setAttribute('x2', (from[0] - at[0]).toFixed(1));
    line.setAttribute('y2', (from[1] - at[1]).toFixed(1));
  });
  // On a body that is small in the picture they must not cover each other.
  const size = Math.min(Math.max(height / 300, 0.5), 1);
  drawn.style.setProperty('--knob', `${6 * size}px`);
  drawn.style.setProperty('--grip', `${16 * size}px`);
}

/** What is being pulled, from where. */
const pulled = signal<{ handle: Handle; value: number; along: Place; x: number; y: number } | null>(null);

function take(handle: Handle, event: PointerEvent): void {
  const [at, from] = places.get(handle)!;
  (event.currentTarget as Element).setPointerCapture(event.pointerId);
  event.preventDefault();
  part();
  pulled.value = { handle, value: valueOf(handle.parameter), along: [at[0] - from[0], at[1] - from[1]], x: event.clientX, y: event.clientY };
}

/** As many times as long as the pointer has made it. */
function pull(event: PointerEvent): void {
  const now = pulled.value, parameter = now && known(now.handle.parameter);
  if (!parameter) return;
  const [x, y] = now.along, length = Math.max(Math.hypot(x, y), 1);
  const moved = ((event.clientX - now.x) * x + (event.clientY - now.y) * y) / length;
  const step = stepOf(parameter), wanted = now.value * (1 + moved / Math.max(length, k_least_px));
  const value = Number(Math.min(Math.max(Math.round(wanted / step) * step, parameter.low), parameter.high).toFixed(6));
  if (value !== valueOf(parameter.name)) shape(parameter.name, value);
}

function letGo(): void {
  pulled.value = null;
  part();
}

/** What its slider says. */
function Label({ parameter }: { parameter: string }) {
  const unit = known(parameter)?.unit ?? '';
  return <text x="14" y="4">{parameter} {valueOf(parameter).toFixed(2)}{unit === '1' ? '' : ` ${unit}`}</text>;
}

export function Handles() {
  const svg = useRef<SVGSVGElement>(null);
  const isShown = shapesBody.value && known('stature') !== undefined;
  useEffect(() => {
    drawn = svg.current;
    return () => {
      drawn = null;
      places.clear();
    };
  }, [isShown]);
  if (!isShown) return null;
  // The panel's sliders do the same for keyboards and screen readers.
  return (
    <svg class="handles" ref={svg} aria-hidden="true">
      {k_handles.map((handle) => (
        <g key={`${handle.parameter} ${handle.at}`} data-handle={`${handle.parameter} ${handle.at}`} class={pulled.value?.handle === handle ? 'pulled' : ''} style="display: none">
          <line />
          <circle class="grip" onPointerDown={(event) => take(handle, event)} onPointerMove={pull} onPointerUp={letGo} onPointerCancel={letGo} />
          <circle class="knob" />
          <Label parameter={handle.parameter} />
        </g>
      ))}
    </svg>
  );
}
