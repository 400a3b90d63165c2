/** The page of two recordings: where they part, in the words of `detent diff`, and what it shows of both. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { Browser, drawn, missing, picture, shows, tool, verdictOf } from './browser.mjs';
import { recording } from './support.mjs';

/** The recorder of tests/tool/first_difference, which introduces faults. */
const faulty =
  process.env.DETENT_FAULTY ?? join(dirname(tool), '../../../tests/tool/first_difference/faulty');
const options = { skip: missing || (!existsSync(faulty) && `the recorder of faults is not built: ${faulty}`) };
let browser;
before(async () => {
  if (!options.skip) browser = await Browser.start();
});
after(() => browser?.stop());

/** A recording of a machine: scene, ticks, trace level, digest interval, keyframe interval, then its fault. */
function machine(scene, ...more) {
  const file = join(browser.folder, 'machine.rec');
  execFileSync(faulty, ['fx64', scene, file, ...more.map(String)]);
  return new Uint8Array(readFileSync(file));
}
const marksOf = (page) => page.evaluate(() => document.body.dataset.marks);
const ghostsOf = (page) => page.evaluate(() => Number(document.body.dataset.ghosts));
const noticeOf = (page) => page.textContent('#notice');

async function withPair(a, b, body) {
  const page = await browser.open(browser.makePair(a, b));
  await body(page);
  assert.deepEqual(page.faults, []);
  await page.close();
}

/** The bodies that a text names, in the order of their first places. */
const bodiesIn = (text) => [...new Set([...text.matchAll(/body (\d+) \(/g)].map((found) => found[1]))].join(' ');

/**
 * The page says at once what `detent diff` says; it plays to the tick and stops there, or is there at the start. It
 * marks the bodies that it names, if `marks` does not say others.
 */
async function parts(a, b, { verdict, at, says, marks }) {
  await withPair(a, b, async (page) => {
    assert.equal(await verdictOf(page), verdict);
    const told = await noticeOf(page);
    assert.match(told, says);
    assert.equal(told, browser.difference());
    if (at !== 0) {
      await page.selectOption('#speed', '8');
      await page.click('#play');
      await page.waitForFunction(() => !document.querySelector('#play').classList.contains('on'));
    }
    await shows(page, at);
    assert.equal(await marksOf(page), marks ?? bodiesIn(told));
    assert.ok((await picture(page)).colours > 50);
  });
}

const values = '0x[0-9a-f]+ \\(-?[0-9.e-]+ m/s\\) and 0x[0-9a-f]+ \\(-?[0-9.e-]+ m/s\\)';

test('one wrong bit of a velocity is shown with both values', options, () =>
  parts(machine('stack', 40, 0, 1, 0), machine('stack', 40, 2, 1, 0, 'flip', 17, 4, 20), {
    verdict: 'tick 17 differs',
    at: 17,
    says: new RegExp(`tick 17 differs, first at stage calls: body 4 \\(generation 1\\), linear_velocity.y: ${values}$`),
    marks: '4',
  }),
);

for (const [fault, tick, body, verdict, says, marks] of [
  ['contact', 17, 0, 'tick 17 differs', /stage collide_pairs: contact of bodies 1 .* and 2 .*, normal.y: 0x/, '1 2'],
  ['solve', 18, 3, 'tick 18 differs', /stage solve_islands: body 3 \(generation 1\), linear_velocity.y: 0x/, '3'],
  ['sweep', 19, 2, 'tick 19 differs', /stage advance: body 2 \(generation 1\), sweep, displacement.y: 0x/, '2'],
]) {
  test(`a fault within a stage is found there: ${fault}`, options, () =>
    parts(machine('stack', 30, 2, 1, 0), machine('stack', 30, 2, 1, 0, fault, tick, body, 20), {
      verdict,
      at: tick,
      says,
      marks,
    }),
  );
}

test('without a trace of the machine whose recording does not verify, the page names the tick and the trace to make', options, () =>
  parts(machine('stack', 40, 0, 1, 0), machine('stack', 40, 0, 1, 0, 'flip', 17, 4, 20), {
    verdict: 'tick 17 differs',
    at: 17,
    says: /tick 17 differs\n  to know more, on the machine that recorded it: detent trace b.rec -o b.trace.rec --level 2 --from 17 --to 17$/,
    marks: '',
  }),
);

test('if the first recording does not verify, the page stops before the tick that it cannot show', options, () =>
  parts(machine('stack', 40, 2, 1, 0, 'flip', 17, 4, 20), machine('stack', 40, 0, 1, 0), {
    verdict: 'tick 17 differs',
    at: 16,
    says: new RegExp(`tick 17 differs, first at stage calls: body 4 \\(generation 1\\), linear_velocity.y: ${values}$`),
    marks: '4',
  }),
);

test('a keyframe tells the fields', options, () =>
  parts(machine('stack', 40, 0, 1, 0), machine('stack', 40, 0, 1, 5, 'flip', 20, 4, 20), {
    verdict: 'tick 20 differs',
    at: 20,
    says: /tick 20 differs, first at stage end: body \d+ \(generation 1\), .*: 0x/,
  }),
);

test('sparse digests leave a window of ticks', options, () =>
  parts(machine('stack', 40, 0, 10, 0), machine('stack', 40, 0, 10, 0, 'flip', 14, 4, 20), {
    verdict: 'one of the ticks 11 to 20 differs',
    at: 20,
    says: /equal up to tick 10; one of the ticks 11 to 20 differs\n/,
    marks: '',
  }),
);

test('an input that comes a tick late is found, and both go on', options, async () => {
  const [good, late] = [machine('traffic', 60, 0, 1, 0), machine('traffic', 60, 0, 1, 0, 'late', 31)];
  await parts(good, late, {
    verdict: 'tick 31 differs',
    at: 31,
    says: /tick 31 differs, first at stage calls: call 1 before tick 31: sleep_body .*, only in a.rec\n/,
    marks: '6',
  });
});

test('another order of creations is found, and ghosts show it', options, async () => {
  const made = (order, tick) => machine('stack', 60, 0, 1, 0, order, tick);
  await parts(made('created', 20), made('created-in-other-order', 20), {
    verdict: 'tick 20 differs',
    at: 20,
    says: /first at stage calls: call 1 before tick 20: create_body, position.x: .*\(3\) and .*\(5\), shape type: 1 and 3\n/,
    marks: '7 8',
  });
  await parts(made('created', 0), made('created-in-other-order', 0), {
    verdict: 'the seeds differ',
    at: 0,
    says: /their seeds differ: body 7 \(generation 1\), position.x: .*\(3 m\) and .*\(5 m\)\n/,
    marks: '7 8',
  });
});

test('another setting is found', options, async () => {
  const good = machine('stack', 40, 0, 1, 0);
  await parts(good, machine('stack', 40, 0, 1, 0, 'setting'), {
    verdict: 'the seeds differ',
    at: 0,
    says: /their seeds differ: world, iterations: 1 and 2$/,
    marks: '',
  });
  await parts(good, machine('stack', 40, 0, 1, 0, 'changed-setting', 20), {
    verdict: 'tick 20 differs',
    at: 20,
    says: /call 1 before tick 20: set_settings .*, only in b.rec\n/,
    marks: '2 3 4 5 6',
  });
});

test('equal recordings are said to be equal in all ticks of both', options, async () => {
  for (const scene of ['stack', 'terrain']) {
    await withPair(machine(scene, 60, 0, 1, 0), machine(scene, 60, 2, 7, 20), async (page) => {
      assert.equal(await verdictOf(page), 'all ticks of both agree');
      assert.match(await page.getAttribute('#verdict', 'title'), /^a.rec and b.rec: equal in ticks 1 to 60/);
      assert.ok(await page.isHidden('#notice'));
      assert.ok(await page.isDisabled('#difference'));
    });
  }
  await withPair(machine('stack', 80, 0, 1, 0), machine('stack', 60, 0, 1, 0), async (page) => {
    assert.equal(await verdictOf(page), 'both agree in the ticks 1 to 60');
    assert.match(await page.getAttribute('#verdict', 'title'), /b.rec ends at tick 60/);
    await page.click('#end');
    await shows(page, 80);
    assert.equal(await page.textContent('#ghosts'), 'b.rec ends at tick 60');
  });
  // Two that are equal, of a machine with a fault: they agree with each other, and not with this page.
  const flipped = machine('stack', 40, 0, 1, 0, 'flip', 17, 4, 20);
  await withPair(flipped, flipped, async (page) => {
    assert.equal(await verdictOf(page), 'a.rec: tick 17 differs');
  });
});

/** Drops a file on the page, as a reader does. */
const drop = (page, name, bytes) =>
  page.evaluate(
    ([file, base64]) => {
      const data = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([data], file));
      document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
    },
    [name, Buffer.from(bytes).toString('base64')],
  );
const pairVerdict = async (page, wanted) => {
  await page.waitForFunction((text) => document.querySelector('#verdict').textContent === text, wanted);
};

test('a file dropped on the page is the second recording, and the ghosts of what differs are drawn', options, async () => {
  const made = (order) => machine('stack', 60, 0, 1, 0, order, 20);
  const page = await browser.open(browser.make('first.rec', made('created')));
  assert.equal(await verdictOf(page), 'every tick agrees');
  await page.click('#end');
  await shows(page, 60);
  const alone = await picture(page);
  await drop(page, 'second.rec', made('created-in-other-order'));
  await pairVerdict(page, 'tick 20 differs');
  assert.match(await noticeOf(page), /^first.rec and second.rec: equal up to tick 19; tick 20 differs, first at stage calls/);
  await page.waitForFunction(() => document.querySelector('#ghosts').textContent.startsWith('ghosts: second.rec'));
  assert.notDeepEqual((await picture(page)).png, alone.png);
  assert.equal(await ghostsOf(page), 2); // the ball and the box, which have each other's place
  await page.keyboard.press('d');
  await shows(page, 20);
  assert.equal(await ghostsOf(page), 2);
  await page.keyboard.press('ArrowLeft');
  await shows(page, 19);
  assert.equal(await ghostsOf(page), 0);
  // Another file replaces it, also one of the same name.
  await drop(page, 'first.rec', made('created'));
  await pairVerdict(page, 'all ticks of both agree');
  assert.equal(await page.textContent('#name'), 'first.rec and first.rec (second)');
  assert.ok(await page.isHidden('#notice'));
  await page.click('#end');
  await shows(page, 60);
  assert.deepEqual((await picture(page)).png, alone.png);
  assert.deepEqual(page.faults, []);
  await page.close();
});

test('what cannot be compared is refused in one sentence', options, async () => {
  const good = machine('stack', 200, 0, 1, 0);
  const flipped = good.slice();
  flipped[flipped.length - 200] ^= 4;
  const page = await browser.open(browser.make('good.rec', good));
  await verdictOf(page);
  for (const [name, bytes, verdict, sentence] of [
    ['float.rec', recording('stack', 'f32'), 'not compared', /^float.rec is of the configuration f32, which this page/],
    ['text.rec', new TextEncoder().encode('x'.repeat(100)), 'not compared', /^text.rec is not a recording of Detent.$/],
    ['empty.rec', new Uint8Array(0), 'not compared', /^empty.rec is damaged: truncated/],
    ['short.rec', good.slice(0, 500), 'not compared', /^short.rec is damaged: truncated/],
    ['packed.rec.zst', new Uint8Array([0x28, 0xb5, 0x2f, 0xfd, 0]), 'not compared', /^packed.rec.zst is compressed/],
    ['terrain.rec', recording('terrain', 'fx64'), 'not compared', /^terrain.rec needs cooked files/],
    ['other.rec', recording('tiny', 'fx64'), 'the seeds differ', /^good.rec and other.rec: their seeds differ: /],
  ]) {
    await drop(page, name, bytes);
    await pairVerdict(page, verdict);
    await page.waitForFunction(
      (source) => new RegExp(source).test(document.querySelector('#notice').textContent),
      sentence.source,
    );
  }
  // The same file once more is told once more.
  const text = new TextEncoder().encode('x'.repeat(100));
  for (let i = 0; i < 2; ++i) {
    await drop(page, 'text.rec', text);
    await pairVerdict(page, 'not compared');
    await drawn(page);
    assert.match(await noticeOf(page), /^text.rec is not a recording of Detent.$/);
  }
  await drop(page, 'flipped.rec', flipped);
  await page.waitForFunction(() =>
    /^equal up to tick \d+, then damaged$/.test(document.querySelector('#verdict').textContent),
  );
  assert.match(await noticeOf(page), /equal in ticks 1 to \d+\n  flipped.rec: corrupt at byte \d+, tick \d+: chunk checksum$/);
  assert.deepEqual(page.faults, []);
  await page.close();
});
