// Colours of the three-dimensional picture, light and dark; those of the page are in style.css.
import { computed, signal } from '@preact/signals';
import { theme } from '../settings';

const query = matchMedia('(prefers-color-scheme: dark)');
const systemIsDark = signal(query.matches);
query.addEventListener('change', () => (systemIsDark.value = query.matches));

export const isDark = computed(() => (theme.value === 'system' ? systemIsDark.value : theme.value === 'dark'));

export interface Palette {
  sky: number;
  ground: number;
  line: number;
  body: number;
  sun: number;
  sunStrength: number;
  fillSky: number;
  fillGround: number;
  fillStrength: number;
  /** Of who goes in a crowd. */
  crowd: readonly number[];
}

const k_light_crowd = [0xeadcc8, 0xc9b79a, 0xa9bcc0, 0xd6a98a, 0x8fa79b] as const;
const k_dark_crowd = [0xe2d9cb, 0xb9a88c, 0x93abb2, 0xc4926f, 0x7d9a8d] as const;

export const palette = computed<Palette>(() =>
  isDark.value
    ? { sky: 0x14181b, ground: 0x3f4b4a, line: 0x7d8d8a, body: 0xe2d9cb, sun: 0xfff1dc, sunStrength: 2.6, fillSky: 0x9db4c0, fillGround: 0x2c2a26, fillStrength: 0.9, crowd: k_dark_crowd }
    : { sky: 0xe3eaec, ground: 0xb4c2bd, line: 0x77898a, body: 0xeadcc8, sun: 0xfff4e4, sunStrength: 2.4, fillSky: 0xeaf3f8, fillGround: 0x8d8a80, fillStrength: 1.35, crowd: k_light_crowd },
);

/** Left and right, told apart by people who see colours differently, too. */
export const k_side_colors = [0x2f7fd6, 0xe58a1f] as const;

/** For what is told apart by colour alone, also by people who see colours differently (Okabe and Ito 2008). */
export const k_told_apart = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#d55e00', '#56b4e9'] as const;
