// A stick to push with a finger or the mouse.
import { useRef } from 'preact/hooks';
import { stick } from '../input';

const k_radius = 44; // [px] that it can be pushed

export function Stick() {
  const ring = useRef<HTMLDivElement>(null);
  const push = (event: PointerEvent) => {
    const box = ring.current!.getBoundingClientRect();
    let x = (event.clientX - box.left - box.width / 2) / k_radius;
    let y = -(event.clientY - box.top - box.height / 2) / k_radius;
    const length = Math.hypot(x, y);
    if (length > 1) {
      x /= length;
      y /= length;
    }
    stick.value = { x, y };
  };
  const release = () => (stick.value = null);
  const at = stick.value ?? { x: 0, y: 0 };
  return (
    <div
      class="stick"
      ref={ring}
      role="img"
      aria-label="Stick to steer with; the keys W, A, S and D do the same"
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        push(event);
      }}
      onPointerMove={(event) => event.currentTarget.hasPointerCapture(event.pointerId) && push(event)}
      onPointerUp={release}
      onPointerCancel={release}
    >
      <svg viewBox="-60 -60 120 120" aria-hidden="true">
        <circle class="rim" r="54" />
        <path class="mark" d="M0-49l5 7h-10zM0 49l5-7h-10zM-49 0l7-5v10zM49 0l-7-5v10z" />
        <circle class="knob" cx={at.x * k_radius} cy={-at.y * k_radius} r="22" />
      </svg>
    </div>
  );
}
