// Steps of a piece of work that can be undone and done again.
import { computed, signal } from '@preact/signals';

const k_most_steps = 200;

export class Undo<State> {
  readonly #past = signal<State[]>([]);
  readonly #future = signal<State[]>([]);
  #label = '';
  readonly canUndo = computed(() => this.#past.value.length > 0);
  readonly canRedo = computed(() => this.#future.value.length > 0);

  /** Before a change. Changes that follow each other under one label (the drag of a slider) are one step. */
  keep(state: State, label: string): void {
    if (label === this.#label && this.#past.value.length > 0) return;
    this.#label = label;
    this.#past.value = [...this.#past.value, state].slice(-k_most_steps);
    this.#future.value = [];
  }

  /** The next change begins a step of its own, whatever its label. */
  part(): void {
    this.#label = '';
  }

  undo(now: State): State | undefined {
    return this.#move(this.#past, this.#future, now);
  }

  redo(now: State): State | undefined {
    return this.#move(this.#future, this.#past, now);
  }

  #move(from: { value: State[] }, to: { value: State[] }, now: State): State | undefined {
    const state = from.value.at(-1);
    if (state === undefined) return undefined;
    from.value = from.value.slice(0, -1);
    to.value = [...to.value, now];
    this.part();
    return state;
  }
}
