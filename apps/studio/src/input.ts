// Keys, gamepad and the stick on the screen, as one request.
import { signal } from '@preact/signals';
import { facts, playing, restart, setMode, steer, steered, step } from './session';
import { slowness } from './settings';
import type { FootMode } from './engine/messages';

/** The stick on the screen, -1 … 1 each; null: nobody holds it. */
export const stick = signal<{ x: number; y: number } | null>(null);

const k_walk_mps = 1.4, k_run_mps = 3.5, k_turn_deg_s = 75, k_sidestep_mps = 0.8;
const k_dead_zone = 0.15;
const k_modes: FootMode[] = ['none', 'colvin2013', 'surefoot'];

const held = new Set<string>();
const k_steering_keys = new Set(
  ['KeyW', 'KeyA', 'KeyS', 'KeyD', 'KeyQ', 'KeyE', 'ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight'],
);

const isOwnOfControl = (event: KeyboardEvent): boolean => {
  const at = event.target as HTMLElement;
  if (at.closest('input[type=range], select, [role=tablist], [role=radiogroup]')) return event.code.startsWith('Arrow') || event.code === 'Space';
  if (at.closest('button, summary, a, input[type=checkbox], input[type=radio]')) return event.code === 'Space' || event.code === 'Enter';
  return at.closest('input, textarea') !== null;
};

function press(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey || isOwnOfControl(event)) return;
  if (k_steering_keys.has(event.code)) {
    held.add(event.code);
    event.preventDefault();
    return;
  }
  if (event.repeat && event.code !== 'Period') return;
  const digit = ['Digit1', 'Digit2', 'Digit3'].indexOf(event.code);
  if (digit >= 0) setMode(k_modes[digit]!);
  else if (event.code === 'Space') playing.value = !playing.value;
  else if (event.code === 'Period') singleStep();
  else if (event.code === 'KeyR') void restart();
  else if (event.code === 'KeyP') steered.value = false;
  else return;
  event.preventDefault();
}

export function singleStep(): void {
  playing.value = false;
  void step(1, slowness.value);
}

export function listen(): void {
  addEventListener('keydown', press);
  addEventListener('keyup', (event) => held.delete(event.code));
  addEventListener('blur', () => held.clear());
  document.addEventListener('visibilitychange', () => held.clear());
}

const down = (...codes: string[]): number => (codes.some((code) => held.has(code)) ? 1 : 0);

/** Directions -1 … 1: ahead, to the left, turning to the left; and whether to run. */
interface Wish {
  ahead: number;
  left: number;
  turn: number;
  run: boolean;
}

let shift = false;
addEventListener('keydown', (event) => (shift = event.shiftKey));
addEventListener('keyup', (event) => (shift = event.shiftKey));

function fromKeys(): Wish {
  return {
    ahead: down('KeyW', 'ArrowUp') - down('KeyS', 'ArrowDown'),
    left: down('KeyQ') - down('KeyE'),
    turn: down('KeyA', 'ArrowLeft') - down('KeyD', 'ArrowRight'),
    run: shift,
  };
}

/** Pushed all the way it runs, half the way it walks. */
function fromStick(x: number, y: number): Wish {
  const live = (value: number) => (Math.abs(value) < k_dead_zone ? 0 : value);
  return { ahead: live(y), left: 0, turn: -live(x), run: Math.abs(y) > 0.9 };
}

function fromPads(): Wish | null {
  for (const pad of navigator.getGamepads?.() ?? []) {
    if (!pad?.connected) continue;
    const wish = fromStick(pad.axes[0] ?? 0, -(pad.axes[1] ?? 0));
    const side = pad.axes[2] ?? 0;
    wish.left = Math.abs(side) < k_dead_zone ? 0 : -side;
    if (isAnything(wish)) return wish;
  }
  return null;
}

const isAnything = (wish: Wish): boolean => wish.ahead !== 0 || wish.left !== 0 || wish.turn !== 0;

const within = (value: number, range: [number, number] | undefined): number =>
  range ? Math.min(Math.max(value, range[0]), range[1]) : value;

/** Asks the character for what is held down now; once a picture. */
export function readInput(): void {
  const known = facts.value;
  if (!known) return;
  const wish = [fromKeys(), stick.value && fromStick(stick.value.x, stick.value.y), fromPads()].find(
    (each) => each && isAnything(each),
  );
  if (!wish) {
    steer(null);
    return;
  }
  const pace = wish.run && wish.ahead > 0 ? k_run_mps : k_walk_mps;
  steer({
    speed: within(wish.ahead * pace, known.facing['speed']),
    lateral: within(wish.left * k_sidestep_mps, known.lateral['lateral'] ?? [0, 0]),
    turn: within(wish.turn * k_turn_deg_s, known.facing['turn']),
  });
}
