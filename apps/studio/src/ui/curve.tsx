// One control over one cycle, and where in it the character is.
import { effect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';

const k_width = 400, k_height = 100;

export function Curve(props: { values: ArrayLike<number>; unit: string; at: () => number }) {
  const mark = useRef<SVGLineElement>(null);
  useEffect(() => effect(() => {
    const x = (k_width * props.at()).toFixed(1);
    mark.current?.setAttribute('x1', x);
    mark.current?.setAttribute('x2', x);
  }), [props.at]);
  const values = Array.from(props.values), known = values.filter(Number.isFinite);
  const low = Math.min(...known), high = Math.max(...known);
  const y = (value: number) => (high > low ? 4 + (k_height - 8) * ((high - value) / (high - low)) : k_height / 2);
  const points = values.flatMap((value, i) => (Number.isNaN(value) ? [] : [`${((k_width * i) / (values.length - 1)).toFixed(1)},${y(value).toFixed(1)}`]));
  const text = (value: number) => `${Number(value.toPrecision(3))} ${props.unit}`;
  return (
    <div class="curve">
      <svg viewBox={`0 0 ${k_width} ${k_height}`} preserveAspectRatio="none" role="img" aria-label={`Over a cycle from ${text(low)} to ${text(high)}`}>
        {low < 0 && high > 0 && <line class="zero" x1="0" x2={k_width} y1={y(0)} y2={y(0)} />}
        <polyline points={points.join(' ')} />
        <line ref={mark} class="now" y1="0" y2={k_height} />
      </svg>
      <span>{text(high)}</span>
      <span>{text(low)}</span>
    </div>
  );
}
