/** Where the bodies of a recording are: what the camera shall see at first. */
import type { Vec3, WorldView } from '../src/index.js';
import type { Playback } from './playback.js';

export interface Place {
  position: Vec3;
  size: number;
}
export interface Extent {
  middle: Vec3;
  /** How far the bodies are from the middle. */
  radius: number;
  /** The places, from the middle. */
  reached: { offset: Vec3; size: number }[];
}

/** Of a world without bodies. */
export const emptyExtent: Extent = { middle: [0, 0, 0], radius: 5, reached: [] };

/** How many times the median distance is far. */
const outlierFactor = 3;
/** Of a large world some bodies stand for all. */
const bodiesMax = 200;

/** What is played before the first frame, to see where the bodies go: ticks, and work as workOf() counts it. No time, for the
 *  camera shall be the same on every machine. */
const surveyTicks = 90;
const surveyWork = 6000;
/** Bodies that travel so many times their extent are seen where they start. */
const travelFactor = 12;

/** Where bodies are in the first part of a recording. `work`: how much of it is played, at most. */
export function survey(playback: Playback, work = surveyWork): Extent {
  playback.verifyWork(surveyTicks, work);
  const [start, ...later] = [0, 0.5, 1].map((share) => {
    playback.goTo(playback.first + share * (playback.verified - playback.first));
    return placesOf(playback.shown);
  });
  playback.goTo(playback.first);
  const first = extentOf(start!);
  const all = extentOf([...start!, ...later.flat()]);
  return all.radius > travelFactor * first.radius ? first : all;
}

/** Where bodies are now. */
export const extentNow = (world: WorldView): Extent => extentOf(placesOf(world));

/** The places of the bodies that move, or of all if none does. */
function placesOf(world: WorldView): Place[] {
  const rows = world.bodies();
  const moving = rows.filter((row) => row.type !== 'fixed');
  const chosen = moving.length > 0 ? moving : rows;
  const step = Math.ceil(chosen.length / bodiesMax);
  return chosen
    .filter((_, i) => i % step === 0)
    .map((row) => {
      const { position, shape } = world.body(row.id).def;
      const size = shape.type === 'box' ? Math.hypot(...shape.halfExtents) : shape.radius + shape.halfLength;
      return { position, size: size + shape.rounding };
    });
}

/** A body that is much farther away than most is left out: it would make all others small. */
function extentOf(places: Place[]): Extent {
  if (places.length === 0) return emptyExtent;
  const axes = [0, 1, 2] as const;
  const most = axes.map((axis) => median(places.map(({ position }) => position[axis])));
  const distance = ({ position, size }: Place) => Math.hypot(...position.map((x, axis) => x - most[axis]!)) + size;
  const limit = outlierFactor * median(places.map(distance));
  const near = places.filter((place) => distance(place) <= limit);
  const middle = axes.map((axis) => {
    const along = near.map(({ position }) => position[axis]);
    return (Math.min(...along) + Math.max(...along)) / 2;
  }) as Vec3;
  const reached = near.map(({ position, size }) => ({
    offset: position.map((x, axis) => x - middle[axis]!) as Vec3,
    size,
  }));
  const radius = Math.max(...reached.map(({ offset, size }) => Math.hypot(...offset) + size));
  return { middle, radius: Math.min(Math.max(radius, 0.01), 1e5), reached };
}

function median(list: number[]): number {
  return list.sort((a, b) => a - b)[Math.floor(list.length / 2)]!;
}
