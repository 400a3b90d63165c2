/** Worlds in node: bodies, joints, queries, events, snapshots, recordings of their own. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { configs, load, sceneAssets, shapes } from './support.mjs';

const capacity = { bodies: 16, contacts: 64, joints: 4, sensed: 8, assets: 4 };

for (const config of configs) {
  const detent = await load(config);
  const create = (def = {}) => detent.createWorld({ capacity, ...def }, sceneAssets);
  const withGround = () => {
    const world = create();
    world.createBody({ type: 'fixed', shape: shapes.halfSpace() });
    return world;
  };

  test(`a ball falls, touches the ground and falls asleep in ${config}`, () => {
    const world = withGround();
    const ball = world.createBody({ position: [0, 2, 0], shape: shapes.sphere(0.5) });
    const types = [];
    for (let tick = 0; tick < 200; ++tick) {
      world.step();
      const events = world.events();
      types.push(...events.contacts.map((event) => event.type), ...events.bodies.map((event) => event.type));
    }
    for (const type of ['begin', 'touch', 'hit', 'fell_asleep']) assert.ok(types.includes(type), `${type}: ${types}`);
    assert.ok(Math.abs(world.pose(ball).position[1] - 0.5) < 1e-3);
    assert.equal(world.body(ball).awake, false);
    const [contact] = world.contacts(ball);
    assert.ok(Math.abs(contact.normalForce / (world.body(ball).mass * 9.81) - 1) < 0.02);
    assert.equal(world.report().tick, 200);
    world.destroy();
  });

  test(`poses are written relative to a camera, far from the origin too, in ${config}`, () => {
    const world = create();
    const far = 1e6;
    const body = world.createBody({
      position: [far + 0.25, 1, 2],
      shape: shapes.box([1, 1, 1]),
      rotation: [0, 0.6, 0, 0.8],
    });
    world.createBody({ position: [far, 5, 2] });
    const poses = new Float32Array(2 * 10).fill(-1);
    assert.equal(world.writePoses(poses, [far, 0, 0], 10), 2);
    assert.deepEqual([...poses.slice(0, 3)], [0.25, 1, 2]);
    assert.ok(Math.abs(poses[4] - 0.6) < 1e-6 && Math.abs(poses[6] - 0.8) < 1e-6);
    assert.deepEqual([...poses.slice(7, 10)], [-1, -1, -1]);
    assert.deepEqual([...poses.slice(10, 13)], [0, 5, 2]);
    assert.equal(world.writePoses(new Float32Array(7)), 1);
    world.destroyBody(body);
    assert.equal(world.has(body), false);
    world.destroy();
  });

  test(`queries find what is there in ${config}`, () => {
    const world = withGround();
    const box = world.createBody({ position: [0, 3, 0], shape: shapes.box([0.5, 0.5, 0.5]) });
    const ray = world.castRay([0, 10, 0], [0, -20, 0], { all: true });
    assert.deepEqual(
      ray.hits.map((hit) => hit.body.slot),
      [2, 1],
    );
    assert.ok(Math.abs(ray.hits[0].fraction - 6.5 / 20) < 1e-5);
    assert.deepEqual(ray.hits[0].normal.map(Math.round), [0, 1, 0]);
    const cast = world.castShape({ shape: shapes.sphere(0.25), position: [0, 10, 0] }, [0, -20, 0]);
    assert.ok(Math.abs(cast.hits[0].fraction - 6.25 / 20) < 1e-4);
    assert.equal(world.overlap({ shape: shapes.sphere(1), position: [0, 4, 0] }).hits[0].body.slot, box.slot);
    assert.equal(world.overlapBounds([-1, 2, -1], [1, 4, 1], { all: true }).hits.length, 2);
    const nearest = world.closest({ shape: shapes.sphere(0.5), position: [3, 3, 0] }, 10, {
      filter: { ignore: { slot: 1, generation: 1 } },
    });
    assert.ok(Math.abs(nearest.hits[0].distance - 2) < 1e-4);
    assert.equal(world.castRay([0, 10, 0], [0, -20, 0], { filter: { category: 2, mask: 2 } }).hits.length, 0);
    world.destroy();
  });

  test(`joints hold, are read, and break in ${config}`, () => {
    const world = create();
    const post = world.createBody({ type: 'fixed', position: [0, 5, 0], shape: shapes.sphere(0.1) });
    const weight = world.createBody({ position: [0, 3, 0], shape: shapes.sphere(0.5), mass: 10 });
    const def = world.placeJoint({ type: 'ball', a: post, b: weight }, [0, 5, 0]);
    assert.deepEqual(def.anchorB, [0, 2, 0]);
    const joint = world.createJoint({ ...def, breakForce: 500 });
    for (let tick = 0; tick < 60; ++tick) world.step();
    assert.ok(Math.abs(Math.hypot(...world.joint(joint).force) - 98.1) < 1);
    assert.equal(world.jointLines()[0].type, 'ball');
    world.applyForce(weight, [0, -1000, 0]);
    world.step();
    assert.deepEqual(
      world.events().joints.map((event) => event.joint),
      [joint],
    );
    assert.deepEqual(world.joints(), []);
    world.destroy();
  });

  test(`a sensor sees what comes and goes in ${config}`, () => {
    const world = create({ gravity: [0, 0, 0] });
    const gate = world.createBody({ type: 'fixed', shape: shapes.box([1, 1, 1]), sensor: true });
    const ball = world.createBody({ position: [-3, 0, 0], linearVelocity: [6, 0, 0], shape: shapes.sphere(0.25) });
    const seen = [];
    for (let tick = 0; tick < 90; ++tick) {
      world.step();
      seen.push(...world.events().sensors.map((event) => event.type));
      if (tick === 30) assert.deepEqual(world.sensed(gate), [ball]);
    }
    assert.deepEqual(seen, ['enter', 'leave']);
    world.destroy();
  });

  test(`a snapshot restores a world, and damaged ones are refused in ${config}`, () => {
    const world = withGround();
    for (let i = 0; i < 4; ++i)
      world.createBody({ position: [0.1 * i, 1 + 1.1 * i, 0], shape: shapes.box([0.5, 0.5, 0.5]) });
    for (let tick = 0; tick < 30; ++tick) world.step();
    const saved = world.save();
    const digest = world.digest();
    for (let tick = 0; tick < 30; ++tick) world.step();
    const later = world.digest();
    world.load(saved);
    assert.equal(world.digest(), digest);
    for (let tick = 0; tick < 30; ++tick) world.step();
    assert.equal(world.digest(), later);
    let refused = 0;
    for (let at = 0; at < saved.length; at += 211) {
      const damaged = saved.slice();
      damaged[at] ^= 0x40;
      try {
        world.load(damaged);
      } catch (error) {
        assert.equal(error.name, 'DetentError');
        ++refused;
      }
    }
    assert.ok(refused > 0);
    world.load(saved.slice());
    assert.throws(() => world.load(saved.slice().fill(0xff, 400, 2000)), { status: 'corrupt' });
    assert.equal(world.digest(), digest);
    assert.throws(() => world.load(saved.slice(0, 100)), { status: 'truncated' });
    world.destroy();
  });

  test(`every call can be recorded, and its recording agrees in ${config}`, () => {
    const world = create();
    world.record({ keyframeInterval: 20 });
    [0, 1, 2, 3].forEach((index) => world.bindAsset(index));
    const ground = world.createBody({ type: 'fixed', shape: shapes.terrain(1) });
    const ids = [shapes.hull(2), shapes.compound(3), shapes.box([0.2, 0.2, 0.2]), shapes.sphere(0.3)].map((shape, i) =>
      world.createBody({ shape, position: [2 * i - 3, 4, 0] }),
    );
    const [a, b, c, d] = ids;
    const platform = world.createBody({ type: 'kinematic', position: [0, 8, 0], shape: shapes.box([1, 0.1, 1]) });
    const joint = world.createJoint(
      world.placeJoint({ type: 'distance', a, b, axis: { limited: true, upper: 3 } }, [-2, 4, 0]),
    );
    const changes = [
      () => world.setVelocity(c, [1, 2, 0], [0, 1, 0]),
      () => world.applyForce(a, [0, 50, 0]),
      () => world.applyForce(a, [0, 50, 0], [-3, 4, 0]),
      () => world.applyForceAt(a, [0, 5, 0], [0.1, 0, 0]),
      () => world.applyTorque(b, [0, 5, 0]),
      () => world.applyImpulse(b, [0, 1, 0]),
      () => world.applyImpulseAt(b, [0, 1, 0], [0.1, 0, 0]),
      () => world.applyAngularImpulse(b, [0, 1, 0]),
      () => world.setGravity([0, -5, 0]),
      () => world.setUserData(c, 7),
      () => world.sleepBody(c),
      () => world.wakeBody(c),
      () => world.setType(d, 'kinematic'),
      () => world.setType(d, 'dynamic'),
      () => world.setShape(d, shapes.sphere(0.4)),
      () => world.setMass(d, 3),
      () =>
        world.setInertia(
          c,
          [1, 1, 1].map((x) => x * world.body(c).inertia[0]),
        ),
      () => world.setDensity(d, 500),
      () => world.setMaterial(d, { friction: 0.1 }),
      () => world.setDamping(d, 0.1, 0.2),
      () => world.setGravityScale(d, 0.5),
      () => world.setRotationLocks(d, 1),
      () => world.setFilter(d, { group: 3 }),
      () => world.setSensor(d, true),
      () => world.setSensor(d, false),
      () => world.setSettings({ substeps: 4 }),
      () => world.explode({ centre: [0, 0, 0], radius: 10, impulse: 5 }),
      () => world.moveKinematic(platform, [0, 8.1, 0]),
      () => world.setJoint(joint, { ...world.joint(joint).def, userData: 3 }),
      () => world.setPose(d, [3, 5, 0]),
      () => world.castRay([0, 9, 0], [0, -9, 0]),
      () => world.destroyJoint(joint),
      () => world.destroyBody(d),
    ];
    for (const change of changes) {
      change();
      world.step();
    }
    const digest = world.digest();
    const recorded = world.endRecording();
    assert.equal(world.outline(a)[0].kind, 'convex');
    assert.equal(world.outline(ground)[0].kind, 'triangles');
    assert.ok(world.outline(b).length > 1);
    const replay = detent.openRecording(recorded);
    replay.start(sceneAssets);
    assert.equal(replay.verify(), changes.length);
    assert.equal(replay.digest(), digest);
    replay.close();
    world.destroy();
  });
}
