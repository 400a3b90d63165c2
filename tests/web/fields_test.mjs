/** Every field of a definition passes through both lists of fields, that of C++ and that of TypeScript. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { configs, load, root, shapes } from './support.mjs';

/** Equal but for the rounding of the configuration. */
function near(actual, expected, path = 'def') {
  if (typeof expected === 'number') {
    const error = Math.abs(actual - expected);
    assert.ok(error <= 1e-6 * Math.max(1, Math.abs(expected)), `${path}: ${actual} instead of ${expected}`);
  } else if (typeof expected === 'object') {
    for (const key of Object.keys(expected)) near(actual[key], expected[key], `${path}.${key}`);
  } else {
    assert.equal(actual, expected, path);
  }
}

const worldDef = {
  capacity: { bodies: 7, contacts: 19, assets: 0, manifolds: true, joints: 3, sensed: 2 },
  gravity: [0.5, -3, 1.25],
  tick: 1 / 128,
  substeps: 5,
  substepsMax: 17,
  restingPenetration: 1 / 64,
  iterations: 3,
  convergence: 9,
  stabilisation: 'post',
  relaxation: 1.25,
  contactFrequency: 0.125,
  dampingRatio: 4,
  restitutionThreshold: 0.5,
  continuous: false,
  sleeping: false,
  contactMargin: 1 / 32,
  contactRecycleDistance: 1 / 512,
  reduction: 'deepest_area',
};
const bodyDef = {
  type: 'dynamic',
  position: [1.5, 2.25, -3.75],
  rotation: [0, 0.6, 0, 0.8],
  linearVelocity: [1, 2, 3],
  angularVelocity: [0.5, 0, 0],
  material: { friction: 0.25, restitution: 0.75, rollingResistance: 0.125, restitutionRule: 'smaller' },
  linearDamping: 0.5,
  angularDamping: 0.75,
  gravityScale: -2,
  userData: 4000000000,
  rotationLocks: 2,
  filter: { category: 6, mask: 0xfffffff0, group: -7 },
  sensor: false,
};
const jointDef = {
  type: 'hinge',
  anchorA: [0.5, 0.25, 0],
  anchorB: [-0.5, 0, 0.25],
  frameA: [0, 0.6, 0, 0.8],
  frameB: [0.8, 0, 0, 0.6],
  axis: {
    limited: true,
    lower: -0.5,
    upper: 0.75,
    frequency: 3,
    dampingRatio: 0.5,
    target: 0.25,
    speed: 2,
    forceMax: 1000,
  },
  second: { limited: false, lower: 0, upper: 0, frequency: 0, dampingRatio: 1, target: 0, speed: 0, forceMax: 0 },
  frictionForce: 0,
  frictionTorque: 8,
  collide: true,
  breakForce: 4096,
  breakTorque: 2048,
  userData: 9,
};
const someShapes = [
  shapes.sphere(0.75),
  shapes.capsule(0.25, 0.5),
  shapes.rounded(shapes.box([0.5, 0.75, 1]), 0.125),
  shapes.rounded(shapes.cylinder(0.5, 0.25), 0.0625),
  shapes.rounded(shapes.cone(0.5, 0.75), 0.03125),
];

for (const config of configs) {
  const detent = await load(config);
  test(`a world, bodies of each shape and a joint are read as they were written in ${config}`, () => {
    const world = detent.createWorld(worldDef);
    near(world.settings(), worldDef, 'world');
    const ids = someShapes.map((shape, i) => {
      const def = { ...bodyDef, shape, position: [10 * i, 0, 0] };
      const id = world.createBody(def);
      near(world.body(id).def, def, shape.type);
      return id;
    });
    const def = { ...jointDef, a: ids[0], b: ids[1] };
    near(world.joint(world.createJoint(def)).def, def, 'joint');
    assert.deepEqual(
      world.bodies().map((row) => row.id),
      ids,
    );
    world.destroy();
  });

  test(`what is not a number is refused and changes nothing in ${config}`, () => {
    const world = detent.createWorld({ capacity: { bodies: 2, contacts: 4 } });
    const digest = world.digest();
    for (const def of [
      { position: [0, NaN, 0] },
      { position: [0, 1] },
      { position: 'here' },
      { density: Infinity },
      { type: 'liquid' },
      { shape: { type: 'sphere', radius: -1 } },
      { shape: { type: 'tube' } },
      { userData: -1 },
      { userData: 1.5 },
      { rotation: [0, 0, 0, 0] },
    ]) {
      assert.throws(() => world.createBody(def), { name: 'DetentError' }, JSON.stringify(def));
    }
    assert.equal(world.digest(), digest);
    world.destroy();
  });
}

/** The same wrong order in putting and taking would pass the tests above, so the names in both lists are compared. */
const source = (path) => readFileSync(new URL(`ports/web/${path}`, root), 'utf8');
const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const native = source('native/fields.h');
const typescript = source('src/fields.ts');

for (const name of [
  'Shape',
  'Material',
  'Filter',
  'Capacity',
  'WorldDef',
  'JointAxis',
  'JointDef',
  'BodyDef',
  'Explosion',
  'RollbackDef',
  'QueryFilter',
]) {
  test(`the fields of ${name} have one order in C++ and in TypeScript`, () => {
    const variable = name[0].toLowerCase() + name.slice(1);
    const [, argument, body] = new RegExp(`void visit\\(F& f, ${name}& (\\w+)\\) {([^}]*)}`).exec(native);
    const members = [...body.matchAll(new RegExp(`\\b${argument}\\.(\\w+)`, 'g'))].map(([, member]) => camel(member));
    const [, list] = new RegExp(`const ${variable} = record<[^]*?>\\({([^]*?)\\n}`).exec(typescript);
    const keys = [...list.matchAll(/^ {2}(\w+)[:,]/gm)].map(([, key]) => key);
    assert.deepEqual(keys, members);
  });
}

test('the counts of a step report have one order in C++ and in TypeScript', () => {
  const [, body] = /void give\(Giver& out, const StepReport& report\) {([^]*?)\n}/.exec(native);
  const members = [...body.matchAll(/\b(?:report|contacts|ccd|lost|events|joints)\.(\w+)(?=[,)])/g)].map(([, member]) =>
    camel(member),
  );
  const [, list] = /const stepReport = ([^]*?) as never\);/.exec(typescript);
  const keys = [...list.matchAll(/'(\w+)'/g)].map(([, key]) => key);
  assert.deepEqual(keys, members);
});
