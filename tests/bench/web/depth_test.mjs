/** The judge of ./bench web: depths that are known. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { coreOf, depth, icosahedronPoints, placed } from './depth.mjs';
import { box, capsule, icosahedron, Random, sphere } from './scenes.mjs';

const level = [0, 0, 0, 1];
const root = Math.SQRT1_2;
const of = (shape, position, rotation = level) => placed(coreOf(shape), position, rotation);
const near = (value, wanted) => assert.ok(Math.abs(value - wanted) < 1e-9, `${value}, not ${wanted}`);

test('boxes overlap by the least of their overlaps, also across an edge', () => {
  near(depth(of(box(1, 1, 1), [0, 0, 0]), of(box(1, 1, 1), [0.5, 1.75, 0.5])), 0.25);
  near(depth(of(box(1, 1, 1), [0, 0, 0]), of(box(1, 1, 1), [0.5, 2.25, 0.5])), 0);
  // Two bars at right angles, each on its edge.
  const onEdge = [0, 0, Math.sin(Math.PI / 8), Math.cos(Math.PI / 8)];
  const across = [Math.sin(Math.PI / 8), 0, 0, Math.cos(Math.PI / 8)];
  near(depth(of(box(1, 1, 9), [0, 0, 0], onEdge), of(box(9, 1, 1), [0, 2 * Math.SQRT2 - 0.1, 0], across)), 0.1);
});

test('balls and capsules overlap by their radii less the distance of their cores', () => {
  near(depth(of(sphere(1), [0, 0, 0]), of(sphere(0.5), [1.2, 0, 0])), 0.3);
  near(depth(of(capsule(0.5, 1), [0, 0, 0]), of(capsule(0.5, 1), [0, 0, 0.75], [root, 0, 0, root])), 1);
  near(depth(of(capsule(0.5, 1), [0, 0, 0]), of(capsule(0.25, 1), [0.5, 2, 0], [0, 0, root, root])), 0);
  near(depth(of(sphere(0.5), [0, 1.4, 0]), of(box(1, 1, 1), [0, 0, 0])), 0.1);
  near(depth(of(sphere(0.5), [1.3, 1.4, 0]), of(box(1, 1, 1), [0, 0, 0])), 0);
  near(depth(of(sphere(0.5), [1.3, 1.3, 0]), of(box(1, 1, 1), [0, 0, 0])), 0.5 - 0.3 * Math.SQRT2);
  near(depth(of(sphere(0.5), [0, 0.9, 0]), of(box(1, 1, 1), [0, 0, 0])), 0.6);
  near(depth(of(capsule(0.5, 1), [0, 1.4, 0], [0, 0, root, root]), of(box(3, 1, 1), [0, 0, 0])), 0.1);
});

test('a depth is that by which a shape must be moved, and a shape that is moved so touches', () => {
  const random = new Random(7);
  const shapes = [box(0.3, 0.2, 0.25), sphere(0.3), capsule(0.2, 0.25), icosahedron(0.35)];
  let deep = 0;
  for (let i = 0; i < 400; ++i) {
    const a = of(shapes[i % 4], [0, 0, 0], random.rotation());
    const rotation = random.rotation();
    const position = [0, 0, 0].map(() => random.between(-0.3, 0.3));
    const b = of(shapes[(i >> 2) % 4], position, rotation);
    const found = depth(a, b);
    near(depth(b, a), found);
    if (found === 0) continue;
    ++deep;
    // Of many directions none parts the shapes by less, and one nearly by as much.
    let least = Infinity;
    for (let k = 0; k < 4000; ++k) {
      const axis = random.rotation().slice(0, 3);
      const size = Math.hypot(...axis);
      const extent = (core, sign) =>
        Math.max(...core.points.map((p) => (sign * (p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2])) / size)) +
        core.radius;
      least = Math.min(least, extent(a, 1) + extent(b, -1));
    }
    assert.ok(found <= least + 1e-9 && found > least - 0.05, `${found} of ${least}`);
  }
  assert.ok(deep > 200);
});

test('an icosahedron has 12 vertices, 20 faces and 30 edges', () => {
  const core = coreOf(icosahedron(2));
  assert.deepEqual([core.points.length, core.triangles.length, core.edges.length], [12, 20, 30]);
  for (const point of icosahedronPoints(2)) near(Math.hypot(...point), 2);
});
