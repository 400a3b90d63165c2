/** What the tests of ports/web share. They run on what ports/web/build has made. */
import { readFileSync } from 'node:fs';

export const root = new URL('../../', import.meta.url);
export const built = new URL(
  process.env.DETENT_WEB_BUILD ? `file://${process.env.DETENT_WEB_BUILD}/` : 'build/web/',
  root,
);
/** The package: its functions that make shapes, and the rest. */
export const shapes = await import(new URL('package/dist/index.js', built));
export const { load } = shapes;

const bytes = (path) => new Uint8Array(readFileSync(new URL(path, root)));

/** The assets of the scenes, by their indices in examples/scenes/scene.h. */
export const sceneAssets = ['valley.mesh', 'hills.field', 'round.hull', 'dumbbell.compound'].map((name) =>
  bytes(`examples/scenes/assets/${name}`),
);
export const recording = (scene, config) => bytes(`tests/campaigns/lockstep/recordings/${scene}.${config}.rec`);
/** The committed recordings, with the digests of their last ticks on the machine that recorded them. */
export const recordings = readFileSync(new URL('tests/campaigns/lockstep/recordings/index.csv', root), 'utf8')
  .trim()
  .split('\n')
  .slice(1)
  .map((row) => row.split(','))
  .map(([scene, config, ticks, digest]) => ({ scene, config, ticks: Number(ticks), digest: BigInt(`0x${digest}`) }));
export const configs = ['fx64', 'f32'];

/** CRC-32, as chunks have it. */
export function crc32(data) {
  let crc = ~0;
  for (const byte of data) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}
