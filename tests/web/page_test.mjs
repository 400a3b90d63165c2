/** The page of `detent view` in a browser, opened from the disk without a network. */
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { Browser, drawn, meanDifference, missing, picture, shows, verdictOf } from './browser.mjs';
import { configs, crc32, load, recording, recordings, root, shapes } from './support.mjs';

const options = { skip: missing };
let browser;
before(async () => {
  if (!missing) browser = await Browser.start();
});
after(() => browser?.stop());

/** Opens the page of a recording, runs `body`, and requires that the page had no fault. */
async function withPage(name, bytes, body, by = browser) {
  const page = await by.open(by.make(name, bytes));
  await body(page);
  assert.deepEqual(page.faults, []);
  await page.close();
}

/** Every scene in the package's configurations, and what has most shapes and joints in the others. */
const shown = ({ scene, config }) => configs.includes(config) || ['terrain', 'jointed'].includes(scene);
for (const { scene, config } of recordings.filter(shown)) {
  test(`the page of ${scene} in ${config} says that every tick agrees, and draws it`, options, (t) =>
    withPage(`${scene}.${config}.rec`, recording(scene, config), async (page) => {
      assert.equal(await verdictOf(page), 'every tick agrees');
      assert.ok((await picture(page)).colours > 50);
      t.diagnostic(`first frame after ${await page.evaluate(() => document.body.dataset.firstFrame)} ms`);
    }),
  );
}

test('scrubbing, steps and playing change the tick and the picture', options, () =>
  withPage('jointed.rec', recording('jointed', 'fx64'), async (page) => {
    await verdictOf(page);
    const line = await page.locator('#timeline').boundingBox();
    await page.mouse.click(line.x + 132 + (line.width - 140) / 2, line.y + 9);
    await shows(page, 120);
    const middle = await picture(page);
    await page.keyboard.press('ArrowLeft');
    await shows(page, 119);
    const before119 = await picture(page);
    assert.notDeepEqual(before119.png, middle.png);
    await page.keyboard.press('ArrowRight');
    await shows(page, 120);
    assert.deepEqual((await picture(page)).png, middle.png);
    await page.click('#start');
    await shows(page, 0);
    await page.click('#end');
    await shows(page, 240);
    await page.click('#start');
    await page.selectOption('#speed', '0.0625'); // or it may end before the key that pauses it, on a slow machine
    await page.locator('#speed').blur();
    await page.keyboard.press(' ');
    await page.waitForFunction(() => Number(document.body.dataset.tick) > 5);
    await page.keyboard.press(' ');
    await drawn(page);
    const paused = await page.textContent('#tick');
    await page.waitForTimeout(200);
    assert.equal(await page.textContent('#tick'), paused);
  }),
);

test('a click on a body shows its state, definition and contacts', options, () =>
  withPage('stack.rec', recording('stack', 'fx64'), async (page) => {
    await verdictOf(page);
    await page.click('#end');
    await shows(page, 200);
    const stage = await page.locator('#stage').boundingBox();
    await page.mouse.click(stage.x + stage.width / 2, stage.y + stage.height / 2);
    await page.waitForSelector('#inspector:not([hidden])');
    const text = await page.textContent('#inspector');
    for (const part of ['body ', 'position', 'kg', 'dynamic', 'box', 'half extents', 'friction', 'points']) {
      assert.ok(text.includes(part), `${part} is missing: ${text}`);
    }
    const name = await page.textContent('#inspector h2');
    await page.click('#inspector td.link');
    await page.waitForFunction((old) => document.querySelector('#inspector h2').textContent !== old, name);
    await page.keyboard.press('Escape');
    await page.waitForSelector('#inspector', { state: 'hidden' });
  }),
);

test('colours, contacts, bounds and the followed body change the picture', options, () =>
  withPage('terrain.rec', recording('terrain', 'fx64'), async (page) => {
    await verdictOf(page);
    for (let i = 0; i < 8; ++i) await page.keyboard.press('Shift+ArrowRight');
    await shows(page, 80);
    const seen = new Set();
    for (const key of ['1', '2', '3', 'c', 'b', 'j']) {
      await page.keyboard.press(key);
      seen.add((await picture(page)).png.toString('base64'));
    }
    assert.ok(seen.size >= 5, `${seen.size} different pictures of 6`);
  }),
);

test('a flipped bit is named with its tick, and the ticks before it are shown', options, async () => {
  const damaged = recording('stack', 'fx64').slice();
  damaged[8000] ^= 4;
  await withPage('flipped.rec', damaged, async (page) => {
    const verdict = await verdictOf(page);
    assert.match(verdict, /^damaged at tick \d+$/);
    assert.match(await page.textContent('#notice'), /corrupt at byte \d+, tick \d+: chunk checksum/);
    const tick = Number(/\d+/.exec(verdict)[0]);
    await page.click('#end');
    await shows(page, tick - 1);
    assert.ok((await picture(page)).colours > 50);
  });
});

/** The recording with a recorded digest changed, under a right checksum: as of a machine that computed something else. */
function differingAt(bytes, tick) {
  const changed = bytes.slice();
  const view = new DataView(changed.buffer);
  const [headerBytes, chunkBytes, calls, tickDigested] = [72, 16, 2, 14];
  for (let at = headerBytes; at < changed.length;) {
    const end = at + chunkBytes + view.getUint16(at + 2, true);
    // Records of ticks alone: after its first bodies nothing is called in this scene.
    for (let i = at + chunkBytes, now = Number(view.getBigUint64(at + 8, true)) + 1; i < end; i += 9, ++now) {
      if (view.getUint16(at, true) !== calls || changed[i] !== tickDigested) break;
      if (now !== tick) continue;
      changed[i + 1] ^= 1;
      view.setUint32(end, crc32(changed.subarray(at, end)), true);
      return changed;
    }
    at = end + 4;
  }
  throw new Error('the tick was not found');
}

test('a tick that differs is named', options, async () => {
  await withPage('differs.rec', differingAt(recording('stack', 'fx64'), 123), async (page) => {
    assert.equal(await verdictOf(page), 'tick 123 differs');
    assert.match(await page.textContent('#notice'), /recorded [0-9a-f]{16}, here [0-9a-f]{16}/);
  });
});

test('digests that are rarer than ticks are told, and keyframes are gone to', options, async () => {
  for (const [interval, sentence] of [
    ['10', 'every digest agrees (one in 10 ticks)'],
    ['0', 'the final digest agrees'],
  ]) {
    const bytes = browser.record(
      'dominoes_short',
      '--ticks',
      '300',
      '--digest-interval',
      interval,
      '--keyframe-interval',
      '50',
    );
    await withPage('match.rec', bytes, async (page) => {
      await page.click('#end'); // before all is verified
      await shows(page, 300);
      const last = (await picture(page)).png;
      assert.equal(await verdictOf(page), sentence);
      await page.click('#start');
      await shows(page, 0);
      await page.click('#end');
      await shows(page, 300);
      assert.deepEqual((await picture(page)).png, last);
    });
  }
});

test('what a step loses is told in red', options, async () => {
  const detent = await load('fx64');
  const world = detent.createWorld({ capacity: { bodies: 20, contacts: 3 } });
  world.createBody({ type: 'fixed', shape: shapes.halfSpace() });
  for (let i = 0; i < 19; ++i) world.createBody({ position: [0.9 * i, 0.45, 0], shape: shapes.sphere(0.5) });
  world.record();
  for (let tick = 0; tick < 20; ++tick) world.step();
  await withPage('lost.rec', world.endRecording(), async (page) => {
    await verdictOf(page);
    await page.click('#end');
    await shows(page, 20);
    assert.match(await page.textContent('#lost'), /\d+ contacts dropped/);
  });
});

test('a body within a sensor is seen, and chosen', options, async () => {
  const detent = await load('fx64');
  const world = detent.createWorld({ capacity: { bodies: 2, contacts: 4, sensed: 2 }, gravity: [0, 0, 0] });
  world.createBody({ type: 'fixed', shape: shapes.box([0.8, 0.8, 0.8]), sensor: true });
  world.createBody({ shape: shapes.sphere(0.3), linearVelocity: [0.5, 0, 0] });
  world.record();
  for (let tick = 0; tick < 40; ++tick) world.step();
  await withPage('sensor.rec', world.endRecording(), async (page) => {
    await verdictOf(page);
    const still = (await picture(page)).png;
    await page.click('#end');
    await shows(page, 40);
    assert.notDeepEqual((await picture(page)).png, still);
    // And is chosen: a click goes through the sensor.
    const stage = await page.locator('#stage').boundingBox();
    await page.mouse.click(stage.x + stage.width / 2, stage.y + stage.height / 2);
    await drawn(page);
    assert.match(await page.textContent('#inspector'), /typedynamic/);
  });
});

/** The header of another simulation version, under a right checksum. */
function ofVersion(bytes, version) {
  const changed = bytes.slice();
  const view = new DataView(changed.buffer);
  view.setUint32(12, version, true);
  view.setUint32(68, crc32(changed.subarray(0, 68)), true);
  return changed;
}

test('what cannot be shown is refused in a sentence', options, async () => {
  const cases = [
    [ofVersion(recording('stack', 'fx64'), 3), /is of simulation version 3, and this page replays version \d+/],
    [recording('stack', 'f32'), /is of the configuration f32/],
    [new Uint8Array(0), /is damaged/],
    [
      new TextEncoder().encode('not a recording, but a text that is longer than a header of seventy-two bytes'),
      /not a recording/,
    ],
    [recording('terrain', 'fx64'), /needs cooked files/],
    [recording('stack', 'fx64').slice(0, 500), /is damaged: truncated/],
  ];
  for (const [bytes, sentence] of cases) {
    const page = await browser.open(browser.makeOf('stack.rec', recording('stack', 'fx64'), bytes));
    assert.equal(await verdictOf(page), 'not shown');
    assert.match(await page.textContent('#notice'), sentence);
    assert.deepEqual(page.faults, []);
    await page.close();
  }
});

test('a browser without WebGL verifies, and says that it does not draw', options, async (t) => {
  const plain = await Browser.start({ webgl: false });
  t.after(() => plain.stop());
  const page = await plain.open(plain.make('stack.rec', recording('stack', 'fx64')));
  assert.equal(await verdictOf(page), 'every tick agrees');
  assert.match(await page.textContent('#notice'), /no WebGL/);
  await page.close();
});

test('a name that looks like markup stays a name', options, () =>
  withPage('<b>&"\'.rec', recording('tiny', 'fx64'), async (page) => {
    assert.equal(await verdictOf(page), 'every tick agrees');
    assert.equal(await page.textContent('#name'), '<b>&"\'.rec');
  }),
);

test('the picture of docs/view.md is what the page shows', options, async (t) => {
  const sharp = await Browser.start({ scale: 1 });
  t.after(() => sharp.stop());
  const body = async (page) => {
    await verdictOf(page);
    await page.setViewportSize({ width: 1060, height: 680 });
    for (let i = 0; i < 6; ++i) await page.keyboard.press('Shift+ArrowRight');
    await shows(page, 60);
    await page.keyboard.press('c');
    // The car, wherever the camera has it.
    for (const [x, y] of [
      [370, 330],
      [390, 310],
      [350, 330],
      [400, 340],
      [380, 350],
    ]) {
      await page.mouse.click(x, y);
      await drawn(page);
      if ((await page.textContent('#inspector')).includes('dynamic')) break;
    }
    await page.mouse.move(600, 640);
    await drawn(page);
    const png = await page.screenshot();
    const file = new URL('docs/view.png', root);
    if (process.env.DETENT_RENEW_PICTURE) writeFileSync(file, png);
    const difference = await meanDifference(page, png, readFileSync(file));
    assert.ok(
      difference < 2,
      `the pixels differ by ${difference} of 255: renew it with DETENT_RENEW_PICTURE=1 tests/web/run`,
    );
  };
  await withPage('jointed.rec', recording('jointed', 'fx64'), body, sharp);
});

test('the camera turns with the mouse, and follows a body', options, () =>
  withPage('balls.rec', recording('balls', 'fx64'), async (page) => {
    await verdictOf(page);
    const still = (await picture(page)).png;
    await page.mouse.move(700, 300);
    await page.mouse.down();
    await page.mouse.move(860, 340, { steps: 4 });
    await page.mouse.up();
    assert.notDeepEqual((await picture(page)).png, still);
    await page.keyboard.press('r');
    assert.deepEqual((await picture(page)).png, still);
    // A body that was chosen and is followed stays where it is in the picture: a click there finds it again.
    for (let y = 200; y < 500; y += 15) {
      await page.mouse.click(640, y);
      await drawn(page);
      if ((await page.textContent('#inspector')).includes('dynamic')) break;
    }
    await page.keyboard.press('f');
    const name = await page.textContent('#inspector h2');
    for (let i = 0; i < 4; ++i) await page.keyboard.press('Shift+ArrowRight');
    await shows(page, 40);
    const stage = await page.locator('#stage').boundingBox();
    await page.mouse.click(stage.x + stage.width / 2, stage.y + stage.height / 2);
    await drawn(page);
    assert.equal(await page.textContent('#inspector h2'), name);
    assert.equal(await page.getAttribute('#follow', 'aria-pressed'), 'true');
  }),
);
