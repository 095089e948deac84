// The few controls that everything is made of: native elements, so that keyboards and screen readers know them.
import type { ComponentChildren } from 'preact';
import { useId } from 'preact/hooks';

export interface Choice<T> {
  value: T;
  label: string;
  hint?: string;
}

/** One of a few, all in sight. */
export function Segmented<T extends string | number>(props: {
  label: string;
  choices: readonly Choice<T>[];
  value: T;
  onChange: (value: T) => void;
}) {
  const group = useId();
  return (
    <fieldset class="segmented">
      <legend class="quiet">{props.label}</legend>
      <div role="radiogroup" aria-label={props.label}>
        {props.choices.map((choice) => (
          <label key={choice.value} title={choice.hint}>
            <input
              type="radio"
              name={group}
              checked={choice.value === props.value}
              onChange={() => props.onChange(choice.value)}
            />
            <span>{choice.label}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}

export function Toggle(props: { label: ComponentChildren; on: boolean; hint?: string; onChange: (on: boolean) => void }) {
  return (
    <label class="toggle" title={props.hint}>
      <input type="checkbox" checked={props.on} onChange={(event) => props.onChange(event.currentTarget.checked)} />
      <span>{props.label}</span>
    </label>
  );
}

export function Slider(props: {
  label: string;
  unit: string;
  value: number;
  low: number;
  high: number;
  step: number;
  initial: number;
  /** More about it, for who points at it. */
  hint?: string;
  onInput: (value: number) => void;
  /** It was let go. */
  onDone?: () => void;
}) {
  const id = useId();
  const decimals = props.step < 1 ? Math.max(1, Math.round(-Math.log10(props.step))) : 0;
  return (
    <div class="slider">
      <label for={id}>{props.label}</label>
      <output for={id}>
        {props.value.toFixed(decimals)} <small>{props.unit}</small>
      </output>
      <input
        id={id}
        type="range"
        min={props.low}
        max={props.high}
        step={props.step}
        value={props.value}
        onInput={(event) => props.onInput(Number(event.currentTarget.value))}
        onChange={() => props.onDone?.()}
        onDblClick={() => props.onInput(props.initial)}
        title={`${props.hint ? `${props.hint}. ` : ''}Double-click: back to the default`}
      />
    </div>
  );
}

export function Choose(props: {
  label: string;
  choices?: readonly Choice<string>[];
  /** Choices under headings, after those without. */
  groups?: readonly { label: string; choices: readonly Choice<string>[] }[];
  value: string;
  onChange: (value: string) => void;
}) {
  const id = useId();
  const option = ({ value, label }: Choice<string>) => <option key={value} value={value}>{label}</option>;
  return (
    <div class="choose">
      <label for={id}>{props.label}</label>
      <select id={id} value={props.value} onChange={(event) => props.onChange(event.currentTarget.value)}>
        {props.choices?.map(option)}
        {props.groups?.map(({ label, choices }) => <optgroup key={label} label={label}>{choices.map(option)}</optgroup>)}
      </select>
    </div>
  );
}

export function Section(props: { title: string; children: ComponentChildren; aside?: ComponentChildren }) {
  return (
    <section>
      <header>
        <h2>{props.title}</h2>
        {props.aside}
      </header>
      {props.children}
    </section>
  );
}
