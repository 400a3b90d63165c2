/** The match of the page of two players: two balls among crates, within walls. */
import { box, halfSpace, sphere } from '../src/index.js';
import type { BodyId, Detent, TickInputs, Vec3, World } from '../src/index.js';
import type { Extent } from './extent.js';

/** The bits of a player's input, which is one byte. */
export const input = { left: 1, right: 2, up: 4, down: 8, jump: 16 } as const;

/** Of a ball, N and N s; it has 900 kg. */
const push = 9000;
const jump = 4000;
/** Half of the field's side, m. */
export const field = 8;
/** What the camera looks at. */
const seen = 0.8 * field;
export const extent: Extent = {
  middle: [0, 0, 0],
  radius: seen,
  reached: [-seen, seen].flatMap((x) => [-seen, seen].map((z) => ({ offset: [x, 0, z] as Vec3, size: 0.5 }))),
};

export interface Match {
  world: World;
  balls: BodyId[];
}

/** The same on every machine. */
export function startMatch(detent: Detent): Match {
  const world = detent.createWorld({ capacity: { bodies: 40, contacts: 320 } });
  world.createBody({ type: 'fixed', shape: halfSpace() });
  for (const side of [-1, 1]) {
    world.createBody({ type: 'fixed', position: [side * field, 0.8, 0], shape: box([0.3, 0.8, field + 0.3]) });
    world.createBody({ type: 'fixed', position: [0, 0.8, side * field], shape: box([field + 0.3, 0.8, 0.3]) });
  }
  const balls = [-6, 6].map((x) =>
    world.createBody({ position: [x, 0.6, 0], shape: sphere(0.6), linearDamping: 0.4, angularDamping: 0.4 }),
  );
  for (let layer = 0; layer < 3; ++layer) {
    const side = 3 - layer;
    for (let i = 0; i < side * side; ++i) {
      const at = (k: number) => (k - (side - 1) / 2) * 1.05;
      const position: Vec3 = [at(i % side), 0.5 + layer, at(Math.floor(i / side))];
      world.createBody({ position, shape: box([0.5, 0.5, 0.5]), density: 120 });
    }
  }
  for (const [x, z] of [[-5, -5], [5, -5], [-5, 5], [5, 5]] as const)
    world.createBody({
      position: [x, 0.4, z],
      shape: sphere(0.4),
      density: 300,
      linearDamping: 0.2,
      angularDamping: 0.2,
    });
  return { world, balls };
}

/** Makes a tick of the match. `gravity`, m/s², should be the same on every machine. */
export function makeTick({ world, balls }: Match, { inputs }: TickInputs, gravity: number): void {
  if (Math.abs(world.settings().gravity[1] - gravity) > 0.01) world.setGravity([0, gravity, 0]);
  balls.forEach((ball, player) => {
    const bits = inputs[player]![0]!;
    const has = (bit: number) => ((bits & bit) !== 0 ? 1 : 0);
    const x = has(input.right) - has(input.left);
    const z = has(input.down) - has(input.up);
    if (x !== 0 || z !== 0) world.applyForce(ball, [x * push, 0, z * push]);
    if (has(input.jump) && world.contacts(ball).some(({ touching }) => touching)) {
      const { linearVelocity } = world.body(ball).def;
      if (linearVelocity[1] < 1) world.applyImpulse(ball, [0, jump, 0]);
    }
  });
  world.step();
}
