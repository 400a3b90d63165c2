/** Rollback sessions: machines that agree over a bad network, and calls that are refused. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { configs, load, root, shapes } from './support.mjs';

const { box, halfSpace, sphere } = shapes;

/** Numbers below 1 that the seed decides (a linear congruential generator). */
function seeded(seed) {
  let state = seed >>> 0;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}

/** Two balls that their players push, among crates. The game's own state counts the ticks with an input of each player. */
function start(detent) {
  const world = detent.createWorld({ capacity: { bodies: 16, contacts: 96 } });
  world.createBody({ type: 'fixed', shape: halfSpace() });
  const balls = [-2, 2].map((x) => world.createBody({ position: [x, 0.5, 0], shape: sphere(0.5), angularDamping: 1 }));
  for (let i = 0; i < 6; ++i)
    world.createBody({ position: [(i % 2) * 1.02, 0.5 + Math.floor(i / 2), -0.5], shape: box([0.5, 0.5, 0.5]) });
  return { world, balls };
}
const makerOf =
  (balls, seen = () => {}) =>
  (world, { tick, inputs, predicted, again, game }) => {
    seen({ tick, predicted, again });
    inputs.forEach(([push, up], player) => {
      world.applyForce(balls[player], [(push - 128) * 60, up * 100, (push % 7) * 300 - 900]);
      if (push !== 0) game[player] = (game[player] + 1) & 255;
    });
    world.step();
  };
const def = { inputBytes: 2, game: Uint8Array.of(3, 250) };

/** A link that loses, delays and so reorders messages. */
class Link {
  constructor(random, { loss, delay, jitter }) {
    Object.assign(this, { random, loss, delay, jitter, underway: [] });
  }
  send(now, message) {
    if (this.random() < this.loss) return;
    this.underway.push({ due: now + this.delay + Math.floor(this.random() * this.jitter), message });
  }
  receive(now) {
    const arrived = this.underway.filter(({ due }) => due <= now);
    this.underway = this.underway.filter(({ due }) => due > now);
    return arrived.map(({ message }) => message);
  }
}

class Machine {
  constructor(detent, player, inputOf, options) {
    const { world, balls } = start(detent);
    Object.assign(this, { world, player, inputOf, lacks: 0, waits: 0, again: 0, most: 0, predicted: 0, compared: 0 });
    const seen = ({ predicted, again }) => (this.predicted += predicted !== 0 && !again ? 1 : 0);
    this.session = world.beginRollback({ ...def, local: 1 << player, ...options }, makerOf(balls, seen));
  }
  receive({ first, inputs, lacks, checksums }) {
    const other = 1 - this.player;
    inputs.forEach((input, i) => this.session.addInput(other, first + i, input));
    this.lacks = Math.max(this.lacks, lacks);
    for (const each of checksums) {
      if (each.tick + 64 < this.session.confirmedTick()) continue;
      assert.equal(this.session.addChecksum(other, each), undefined);
      this.compared = Math.max(this.compared, each.tick);
    }
  }
  frame(last) {
    const { session, player } = this;
    if (session.tick() < last) {
      const next = session.nextInput(player); // a machine that waited has added it already
      if (next === session.tick()) session.addLocalInput(player, this.inputOf(player, next));
      const report = session.advance();
      if (report === undefined) ++this.waits;
      this.note(report);
    } else {
      this.note(session.correct());
    }
  }
  note(report) {
    this.again += report?.ticksAgain ?? 0;
    this.most = Math.max(this.most, report?.ticksAgain ?? 0);
  }
  message() {
    const { session, player } = this;
    const inputs = [];
    for (let tick = this.lacks; tick < session.nextInput(player); ++tick) inputs.push(session.getInput(player, tick));
    return { first: this.lacks, inputs, lacks: session.nextInput(1 - player), checksums: session.checksums(16) };
  }
}

/** A player's input at a tick: a direction for some ticks, and now and then a jump. */
const inputs = (seed) => (player, tick) => {
  const random = seeded(seed + 977 * player + 31 * Math.floor(tick / 12));
  random();
  return Uint8Array.of(Math.floor(random() * 256), random() < 0.1 ? 1 : 0);
};

/** Plays a match; `before` is called before each frame. */
function play(detent, seed, ticks, network, options = {}, before = () => {}) {
  const machines = [0, 1].map((player) => new Machine(detent, player, inputs(seed), options));
  const links = [0, 1].map((i) => new Link(seeded(seed + 7 + i), network));
  for (let now = 0; machines.some(({ session }) => session.confirmedTick() < ticks); ++now) {
    assert.ok(now < 20 * ticks, 'the match does not end');
    before(now, machines);
    machines.forEach((machine, i) => links[1 - i].receive(now).forEach((message) => machine.receive(message)));
    machines.forEach((machine, i) => {
      machine.frame(ticks);
      links[i].send(now, machine.message());
    });
  }
  return machines;
}
/** The same inputs in a world without a network. */
function alone(detent, seed, ticks) {
  const { world, balls } = start(detent);
  const make = makerOf(balls);
  const game = def.game.slice();
  const inputOf = inputs(seed);
  for (let tick = 0; tick < ticks; ++tick) make(world, { tick, inputs: [inputOf(0, tick), inputOf(1, tick)], game });
  return { world, game };
}
function close(machines) {
  for (const { session, world } of machines) {
    session.end();
    world.destroy();
  }
}

for (const config of configs) {
  const detent = await load(config);
  test(`two machines agree over 3,600 ticks with 5 % loss, and with a world without a network, in ${config}`, (t) => {
    const ticks = 3600;
    const machines = play(detent, 1, ticks, { loss: 0.05, delay: 3, jitter: 4 }, { window: 16 });
    const expected = alone(detent, 1, ticks);
    for (const { world, session, player, again, most, waits, predicted, compared } of machines) {
      assert.equal(world.digest(), expected.world.digest());
      assert.deepEqual(session.game(), expected.game);
      assert.equal(session.desync(), undefined);
      assert.ok(compared > ticks - 40, `compared up to ${compared}`);
      assert.ok(again > 100 && predicted > ticks / 2, `${again} ticks again, ${predicted} predicted`);
      assert.equal(waits, 0);
      t.diagnostic(`${config}, player ${player}: ${again} ticks again, at most ${most} at once, ${predicted} predicted`);
    }
    // The inputs of both are kept, to be sent.
    const [a, b] = machines;
    assert.deepEqual(a.session.getInput(1, ticks - 1), b.session.getInput(1, ticks - 1));
    assert.deepEqual(a.session.checksums(32), b.session.checksums(32));
    close(machines);
    expected.world.destroy();
  });

  test(`a session waits for inputs beyond its window, and goes on when they arrive, in ${config}`, () => {
    const machines = play(detent, 2, 300, { loss: 0.3, delay: 6, jitter: 6 }, { window: 4 });
    const expected = alone(detent, 2, 300);
    for (const { world, waits, most } of machines) {
      assert.equal(world.digest(), expected.world.digest());
      assert.ok(waits > 100, `${waits} waits`);
      assert.ok(most <= 4);
    }
    close(machines);
    expected.world.destroy();
  });
}

const detent = await load('f32');
/** One machine of two players, with the player 1 far away. */
function single(options = {}, make) {
  const { world, balls } = start(detent);
  return { world, balls, session: world.beginRollback({ ...def, ...options }, make ?? makerOf(balls)) };
}
const input = Uint8Array.of(200, 0);

test('a world that one machine changes is named with its tick by the other one', () => {
  let changed;
  const machines = [0, 1].map((player) => new Machine(detent, player, inputs(3), {}));
  const links = [0, 1].map((i) => new Link(seeded(i), { loss: 0, delay: 0, jitter: 1 }));
  let found;
  for (let now = 0; found === undefined && now < 200; ++now) {
    machines.forEach((machine, i) => {
      for (const { first, inputs: list, lacks, checksums } of links[1 - i].receive(now)) {
        list.forEach((each, k) => machine.session.addInput(1 - i, first + k, each));
        machine.lacks = lacks;
        for (const each of checksums.reverse()) found ??= machine.session.addChecksum(1 - i, each);
      }
      machine.frame(Infinity);
      links[i].send(now, machine.message());
    });
    if (now === 50) {
      // A change beside the session's inputs, in a final state.
      machines.forEach(({ session }, i) => {
        for (const { first, inputs: list } of links[1 - i].receive(Infinity))
          list.forEach((each, k) => session.addInput(1 - i, first + k, each));
        session.correct();
      });
      changed = machines[0].session.tick();
      assert.equal(machines[0].session.confirmedTick(), changed);
      const [{ id }] = machines[0].world.bodies().slice(-1);
      machines[0].world.setVelocity(id, [0, 1, 0]);
    }
  }
  assert.equal(found?.tick, changed);
  assert.notEqual(found.own, found.theirs);
  close(machines);
});

test('wrong messages are refused, and change nothing', () => {
  const { world, session } = single();
  for (let i = 0; i < 5; ++i) {
    session.addLocalInput(0, input);
    session.advance();
  }
  const digest = world.digest();
  const checksum = { tick: 0, checksum: 1 };
  const refused = (status, call) => {
    assert.throws(call, { name: 'DetentError', status }, String(call));
    assert.equal(world.digest(), digest, String(call));
    assert.equal(session.nextInput(1), 0, String(call));
    assert.equal(session.desync(), undefined, String(call));
    assert.equal(session.correct().ticksAgain, 0, String(call));
  };
  for (const player of [0, 2, 16, -1, 0.5, NaN, 2 ** 32 + 1, '1', undefined]) {
    refused('bad_argument', () => session.addInput(player, 0, input));
    refused('bad_argument', () => session.addChecksum(player, checksum));
    if (player !== 0) {
      refused('bad_argument', () => session.getInput(player, 0));
      refused('bad_argument', () => session.addLocalInput(player, input));
    }
  }
  for (const bytes of [new Uint8Array(), new Uint8Array(1), new Uint8Array(3), new Uint8Array(1e6), [1, 2], 'ab', null]) {
    refused('bad_argument', () => session.addInput(1, 0, bytes));
    refused('bad_argument', () => session.addLocalInput(0, bytes));
  }
  for (const tick of [-1, 0.5, NaN, Infinity, 2 ** 53, 5 + 6 * 8 + 2, Number.MAX_SAFE_INTEGER, '0', undefined]) {
    refused('out_of_range', () => session.addInput(1, tick, input));
    refused('out_of_range', () => session.addChecksum(1, { tick, checksum: 1 }));
    refused('out_of_range', () => session.getInput(1, tick));
  }
  for (const value of [-1, 2 ** 32, 0.5, '1']) {
    refused('out_of_range', () => session.addChecksum(1, { tick: 0, checksum: value }));
    refused('out_of_range', () => session.checksums(value));
  }
  refused('out_of_range', () => session.getInput(1, 0));
  session.addLocalInput(0, input);
  refused('bad_argument', () => session.addLocalInput(0, input)); // twice for one tick
  session.addInput(1, 0, input);
  assert.equal(session.correct().ticksAgain, 5);
  assert.notEqual(world.digest(), digest);
  close([{ session, world }]);
});

test('definitions out of range are refused, and the world can have a session afterwards', () => {
  const { world, balls } = start(detent);
  for (const [status, wrong] of [
    ['out_of_range', { players: 0 }],
    ['out_of_range', { players: 17 }],
    ['out_of_range', { players: -1 }],
    ['out_of_range', { inputBytes: 0 }],
    ['out_of_range', { inputBytes: 1025 }],
    ['out_of_range', { window: 0 }],
    ['out_of_range', { window: 65 }],
    ['out_of_range', { delay: 9 }],
    ['out_of_range', { players: 1.5 }],
    ['out_of_range', { window: 'eight' }],
    ['bad_argument', { local: 4 }],
    ['bad_argument', { game: [1, 2] }],
  ]) {
    assert.throws(() => world.beginRollback(wrong, makerOf(balls)), { name: 'DetentError', status }, JSON.stringify(wrong));
  }
  assert.throws(() => world.beginRollback({}, undefined), { status: 'bad_argument' });
  world.record();
  assert.throws(() => world.beginRollback({}, makerOf(balls)), { status: 'bad_argument' });
  world.endRecording();
  const session = world.beginRollback(def, makerOf(balls));
  assert.throws(() => world.beginRollback(def, makerOf(balls)), { status: 'bad_argument' });
  assert.throws(() => world.record(), { status: 'bad_argument' });
  session.end();
  session.end();
  assert.throws(() => session.advance(), { status: 'bad_argument' });
  world.record();
  world.endRecording();
  world.destroy();
});

test('a tick function that does not step the world once, or calls the session, ends or is refused', () => {
  for (const steps of [0, 2]) {
    const { world, session } = single({}, (to) => {
      for (let i = 0; i < steps; ++i) to.step();
    });
    session.addLocalInput(0, input);
    assert.throws(() => session.advance(), { status: 'bad_argument' });
    assert.throws(() => session.addInput(1, 0, input), { status: 'bad_argument' });
    close([{ session, world }]);
  }
  let own;
  let refusals = 0;
  const { world, session } = single({}, (to) => {
    for (const call of [() => own.advance(), () => own.end(), () => own.addInput(1, 0, input)]) {
      try {
        call();
      } catch ({ status }) {
        refusals += status === 'bad_argument' ? 1 : 0;
      }
    }
    to.step();
  });
  own = session;
  session.addLocalInput(0, input);
  assert.equal(session.advance().tick, 1);
  assert.equal(refusals, 3);
  close([{ session, world }]);
});

test('an exception of the tick function reaches the caller and ends the session; others go on', () => {
  const good = single();
  for (const late of [false, true]) {
    const { world, session } = single({}, (to) => {
      if (late) to.step();
      throw new RangeError('mine');
    });
    session.addLocalInput(0, input);
    assert.throws(() => session.advance(), { name: 'RangeError', message: 'mine' });
    assert.throws(() => session.advance(), { status: 'bad_argument' });
    close([{ session, world }]);
  }
  good.session.addLocalInput(0, input);
  assert.equal(good.session.advance().tick, 1);
  close([good]);
});

test('the inputs of a tick are those that were given, with what is predicted and what is repeated', () => {
  const seen = [];
  const { world, session } = single({ delay: 1 }, (to, { tick, inputs: given, predicted, again }) => {
    seen.push([tick, ...given.map((each) => [...each]), predicted, again]);
    for (const each of given) each.fill(9); // a copy
    to.step();
  });
  assert.equal(session.addLocalInput(0, input), 1);
  session.advance();
  session.addLocalInput(0, Uint8Array.of(1, 2));
  session.advance();
  session.addInput(1, 0, Uint8Array.of(3, 4));
  session.addInput(1, 1, Uint8Array.of(3, 4));
  assert.deepEqual(session.correct(), { tick: 2, ticksAgain: 2, wentBack: 0 });
  assert.equal(session.confirmedTick(), 2);
  assert.deepEqual(seen, [
    [0, [0, 0], [0, 0], 2, false],
    [1, [200, 0], [0, 0], 2, false],
    [0, [0, 0], [3, 4], 0, true],
    [1, [200, 0], [3, 4], 0, true],
  ]);
  close([{ session, world }]);
});

test('a machine that only watches needs no local input', () => {
  const { world, session } = single({ local: 0 });
  for (let tick = 0; tick < 10; ++tick) for (const player of [0, 1]) session.addInput(player, tick, input);
  for (let tick = 0; tick < 10; ++tick) session.advance();
  assert.equal(session.confirmedTick(), 10);
  close([{ session, world }]);
});

test('sessions that are ended give their memory back', async () => {
  const own = await load('f32');
  const one = () => {
    const { world, balls } = start(own);
    const session = world.beginRollback(def, makerOf(balls));
    close([{ session, world }]);
  };
  one();
  const before = own.module.native.memory.buffer.byteLength;
  for (let i = 0; i < 50; ++i) one();
  assert.equal(own.module.native.memory.buffer.byteLength, before);
});

test('the example of the README plays a match of two machines that agree', () => {
  const readme = readFileSync(new URL('ports/web/README.md', root), 'utf8');
  const [begin, frame, receive] = /## Rollback[^]*?```js\n([^]*?)```/.exec(readme)[1].split(/^\/\/ .*:\n/m);
  const body = `${begin}
    return { session, frame: (keys) => { ${frame} }, receive: (message) => { ${receive} } };`;
  const machines = [0, 1].map((me) => {
    const { world, balls } = start(detent);
    const sent = [];
    const send = (message) => sent.push(message);
    return { world, sent, ...new Function('world', 'balls', 'me', 'other', 'send', body)(world, balls, me, 1 - me, send) };
  });
  for (let tick = 0; tick < 60; ++tick) {
    machines.forEach(({ frame: make }, me) => make(tick % 7 < 3 + me ? 1 : 0));
    machines.forEach(({ receive: take }, me) => machines[1 - me].sent.splice(0).forEach(take));
  }
  const [a, b] = machines;
  assert.ok([a, b].some(({ session }) => session.correct().ticksAgain > 0));
  assert.equal(a.session.confirmedTick(), 60);
  assert.equal(a.world.digest(), b.world.digest());
  assert.equal(a.session.desync(), undefined);
  close(machines);
});
