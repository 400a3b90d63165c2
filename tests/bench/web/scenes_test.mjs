/** The scenes of ./bench web, before an engine plays them. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { watch } from './measures.mjs';
import { scenes } from './scenes.mjs';

for (const scene of scenes)
  test(`${scene.name} starts without an error: nothing overlaps, and the anchors of each joint coincide`, () => {
    const watched = watch({
      ...scene,
      errors: [...scene.errors.filter((name) => name !== 'standing'), 'drift', 'gap'],
    });
    watched.see(scene.bodies);
    for (const [name, value] of Object.entries(watched.values)) assert.ok(Math.abs(value) < 1e-9, `${name} ${value}`);
  });

test('a body that is moved has an error', () => {
  const scene = scenes.find(({ name }) => name === 'figures');
  const poses = scene.bodies.with(1, {
    ...scene.bodies[1],
    position: scene.bodies[1].position.map((at, k) => at - 0.5 * (k === 1)),
  });
  const watched = watch({ ...scene, errors: ['drift', 'gap', 'penetration'] });
  watched.see(poses);
  assert.ok(Math.abs(watched.values.drift - 0.5) < 1e-9);
  assert.ok(Math.abs(watched.values.gap - 0.5) < 1e-9);
  assert.ok(watched.values.penetration > 0.01); // the pelvis is between the shins
});
