/** The colours of bodies. */
import { Color, SRGBColorSpace } from 'three';
import type { BodyRow } from '../src/index.js';

export type ColourBy = 'island' | 'sleep' | 'speed';

export const palette = {
  fixed: '#6d7683',
  kinematic: '#3fb8af',
  awake: '#f0a04b',
  asleep: '#5874a3',
  sensor: '#b48cf2',
  contact: '#ffd84d',
  idleContact: '#8b93a0',
  joint: '#7fd4ff',
  bounds: '#5d6b7c',
  selected: '#ffffff',
  marked: '#ff5d5d',
  ghost: '#8fe3ff',
} as const;

/** Stops of a ramp from slow to fast, dark to bright, also for eyes that do not tell red from green. */
const ramp = ['#3b4d8f', '#2c7da8', '#2fae96', '#8ccf5f', '#f7d84a', '#ff8f3f'];
const stops = ramp.map((text) => new Color(text));
export const rampGradient = `linear-gradient(90deg, ${ramp.join(', ')})`;

const cache = new Map<string, Color>();
const named = (text: string): Color => {
  let colour = cache.get(text);
  if (colour === undefined) cache.set(text, (colour = new Color(text)));
  return colour;
};

/** Neighbouring slots get hues far apart, by the golden angle. */
function islandColour(island: number, awake: boolean): Color {
  const key = `${island}${awake}`;
  let colour = cache.get(key);
  if (colour === undefined) {
    const hue = (0.08 + island * 0.61803398875) % 1;
    colour = new Color().setHSL(hue, awake ? 0.62 : 0.22, awake ? 0.6 : 0.4, SRGBColorSpace);
    cache.set(key, colour);
  }
  return colour;
}

const mixed = new Color();
export function colourOf(row: BodyRow, by: ColourBy, speedMax: number): Color {
  if (row.sensor) return named(palette.sensor);
  if (row.type === 'fixed') return named(palette.fixed);
  if (by === 'speed') {
    const at = Math.min(1, row.speed / Math.max(speedMax, 1e-9)) * (stops.length - 1);
    const i = Math.min(stops.length - 2, Math.floor(at));
    return mixed.copy(stops[i]!).lerp(stops[i + 1]!, at - i);
  }
  if (row.type === 'kinematic') return named(palette.kinematic);
  if (by === 'island') return islandColour(row.island, row.awake);
  return named(row.awake ? palette.awake : palette.asleep);
}
