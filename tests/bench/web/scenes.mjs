/**
 * The scenes, as data that every engine can make: bodies with a shape and a pose, and joints by anchors in the bodies'
 * frames. Units: m, s, rad. Y is up.
 */

/** The generator xorshift32: the same numbers on every machine. */
export class Random {
  constructor(seed) {
    this.state = seed >>> 0 || 1;
  }
  /** In [0, 1). */
  next() {
    for (const [left, by] of [
      [true, 13],
      [false, 17],
      [true, 5],
    ])
      this.state = (this.state ^ (left ? this.state << by : this.state >>> by)) >>> 0;
    return this.state / 2 ** 32;
  }
  between(least, most) {
    return least + (most - least) * this.next();
  }
  rotation() {
    for (;;) {
      const q = [0, 0, 0, 0].map(() => this.between(-1, 1));
      const size = Math.hypot(...q);
      if (size > 0.1 && size <= 1) return q.map((each) => each / size);
    }
  }
}

export const box = (...halfExtents) => ({ kind: 'box', halfExtents });
export const sphere = (radius) => ({ kind: 'sphere', radius });
/** Along y; `half`: of its core segment. */
export const capsule = (radius, half) => ({ kind: 'capsule', radius, half });
/** A hull of 12 vertices at this distance from the centre. */
export const icosahedron = (radius) => ({ kind: 'icosahedron', radius });

const body = (shape, position, rotation = [0, 0, 0, 1]) => ({ shape, position, rotation, density: 1000 });
const fixed = (shape, position) => ({ ...body(shape, position), fixed: true });
const floor = () => fixed(box(100, 1, 100), [0, -1, 0]);
const about = ([x, y, z], angle) => {
  const s = Math.sin(angle / 2);
  return [x * s, y * s, z * s, Math.cos(angle / 2)];
};
export function rotate([x, y, z, w], [a, b, c]) {
  const [tx, ty, tz] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

function pyramid(base) {
  const bodies = [floor()];
  for (let row = 0; row < base; ++row)
    for (let i = 0; i < base - row; ++i)
      bodies.push(body(box(0.5, 0.5, 0.5), [(i - (base - row - 1) / 2) * 1.1, row + 0.5, 0]));
  return { bodies, joints: [] };
}

/** Boxes, balls, capsules and hulls, a quarter each, in layers of 8 x 8 over a pit of 10 x 10 m. */
function pit(count) {
  const random = new Random(1);
  const side = 8;
  const half = 5;
  const height = ((Math.floor(count / side ** 2) + 3) * 1.1) / 2;
  const bodies = [fixed(box(half + 1, 1, half + 1), [0, -1, 0])];
  for (const sign of [-1, 1]) {
    bodies.push(fixed(box(0.5, height, half + 1), [sign * (half + 0.5), height, 0]));
    bodies.push(fixed(box(half, height, 0.5), [0, height, sign * (half + 0.5)]));
  }
  // Few sizes of hulls, for Detent has them cooked.
  const makes = [
    () => box(...[0, 0, 0].map(() => random.between(0.2, 0.35))),
    () => sphere(random.between(0.25, 0.4)),
    () => capsule(random.between(0.15, 0.25), random.between(0.15, 0.25)),
    () => icosahedron(hullRadii[Math.floor(random.next() * hullRadii.length)]),
  ];
  for (let i = 0; i < count; ++i) {
    const [x, z] = [i % side, Math.floor(i / side) % side].map((at) => (at - (side - 1) / 2) * 1.2);
    const shape = makes[(i + Math.floor(i / side)) % 4]();
    bodies.push(body(shape, [x, (Math.floor(i / side ** 2) + 1) * 1.1, z], random.rotation()));
  }
  return { bodies, joints: [] };
}
export const hullRadii = [0.3, 0.3375, 0.375, 0.4125, 0.45];

/** Links of 0.5 m that are released level, and a box of `ratio` times a link's mass. Nothing collides. */
function chain(links, ratio) {
  const bodies = [fixed(sphere(0.1), [0, 0, 0])];
  const joints = [];
  const hang = (next, anchorA, anchorB) => {
    joints.push({ type: 'ball', a: bodies.length - 1, b: bodies.length, anchorA, anchorB });
    bodies.push(next);
  };
  for (let i = 0; i < links; ++i)
    hang(
      body(capsule(0.05, 0.2), [i / 2 + 0.25, 0, 0], about([0, 0, 1], -Math.PI / 2)),
      [0, i && 0.25, 0],
      [0, -0.25, 0],
    );
  const weight = body(box(0.3, 0.3, 0.3), [links / 2 + 0.3, 0, 0]);
  const link = Math.PI * 0.05 ** 2 * 0.4 + (4 / 3) * Math.PI * 0.05 ** 3; // m^3
  weight.density = (1000 * ratio * link) / 0.6 ** 3;
  hang(weight, [0, 0.25, 0], [-0.3, 0, 0]);
  return { bodies, joints, collisions: false };
}

function dominoes(count) {
  const bodies = [floor()];
  for (let i = 0; i < count; ++i) bodies.push(body(box(0.05, 0.5, 0.25), [(i - (count - 1) / 2) * 0.4, 0.5, 0]));
  // The first is tilted about its lower edge.
  const first = bodies[1];
  first.rotation = about([0, 0, 1], -0.2);
  const centre = rotate(first.rotation, [-0.05, 0.5, 0]);
  first.position = [first.position[0] + 0.05 + centre[0], centre[1], 0];
  return { bodies, joints: [] };
}

/** The parts of a figure that stands on the ground, and its joints; hinges turn about x. */
const sides = [-1, 1];
const figure = {
  parts: [
    [box(0.15, 0.08, 0.1), [0, 1, 0]],
    [box(0.13, 0.08, 0.09), [0, 1.18, 0]],
    [box(0.16, 0.14, 0.1), [0, 1.42, 0]],
    [sphere(0.11), [0, 1.7, 0]],
    ...sides.flatMap((side) => [
      [capsule(0.05, 0.1), [side * 0.24, 1.4, 0]],
      [capsule(0.045, 0.1), [side * 0.24, 1.1, 0]],
      [capsule(0.07, 0.14), [side * 0.09, 0.7, 0]],
      [capsule(0.055, 0.14), [side * 0.09, 0.285, 0]],
      [box(0.05, 0.035, 0.12), [side * 0.09, 0.045, 0.05]],
    ]),
  ],
  joints: [
    ['ball', 0, 1, [0, 1.09, 0]],
    ['ball', 1, 2, [0, 1.27, 0]],
    ['ball', 2, 3, [0, 1.57, 0]],
    ...sides.flatMap((side, i) => [
      ['ball', 2, 4 + 5 * i, [side * 0.2, 1.5, 0]],
      ['hinge', 4 + 5 * i, 5 + 5 * i, [side * 0.24, 1.25, 0], -2.2, 0],
      ['ball', 0, 6 + 5 * i, [side * 0.09, 0.92, 0]],
      ['hinge', 6 + 5 * i, 7 + 5 * i, [side * 0.09, 0.485, 0], 0, 2.2],
      ['hinge', 7 + 5 * i, 8 + 5 * i, [side * 0.09, 0.085, 0], -0.5, 0.5],
    ]),
  ],
};

/** Figures of 14 bodies and 13 joints in layers of four, 2 m apart, that fall on the floor and on each other. */
function figures(count) {
  const random = new Random(1);
  const bodies = [floor()];
  const joints = [];
  for (let i = 0; i < count; ++i) {
    const first = bodies.length;
    const at = [(i % 2) * 1.2, 1.2 + Math.floor(i / 4) * 2, (Math.floor(i / 2) % 2) * 1.2];
    const angle = random.between(0, 2 * Math.PI);
    const rotation = about([Math.cos(angle), 0, Math.sin(angle)], random.between(0.05, 0.2));
    for (const [shape, place] of figure.parts) {
      const turned = rotate(rotation, [place[0], place[1] - 1, place[2]]);
      bodies.push({
        ...body(
          shape,
          at.map((each, k) => each + turned[k]),
          rotation,
        ),
        figure: i,
        part: bodies.length - first,
      });
    }
    for (const [type, a, b, point, lower, upper] of figure.joints) {
      const from = (part) => point.map((each, k) => each - figure.parts[part][1][k]);
      joints.push({ type, a: first + a, b: first + b, anchorA: from(a), anchorB: from(b), lower, upper });
    }
  }
  return { bodies, joints };
}

/** `windows`: the steps whose times make a row. `errors`: which of measures.mjs are told. */
export const scenes = [
  { name: 'pyramid', ...pyramid(20), steps: 600, windows: { pyramid: [60, 600] }, errors: ['drift', 'penetration'] },
  {
    name: 'pit',
    ...pit(500),
    steps: 600,
    windows: { 'pit, falling': [60, 300], 'pit, at rest': [450, 600] },
    errors: ['escaped', 'penetration'],
  },
  { name: 'chain-1', ...chain(30, 1), steps: 1800, windows: { 'chain-1': [60, 1800] }, errors: ['stretch'] },
  {
    name: 'chain-100',
    ...chain(30, 100),
    steps: 1800,
    windows: { 'chain-100': [60, 1800] },
    errors: ['stretch'],
  },
  {
    name: 'dominoes',
    ...dominoes(200),
    steps: 1800,
    windows: { dominoes: [60, 1800] },
    errors: ['standing', 'sideways', 'penetration'],
  },
  { name: 'figures', ...figures(10), steps: 400, windows: { figures: [60, 400] }, errors: ['gap', 'penetration'] },
];
