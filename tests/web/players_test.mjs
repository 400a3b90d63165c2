/** The page of two players: their machines agree over a bad network, and the page names the tick if they do not. */
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { Browser, drawn, meanDifference, missing } from './browser.mjs';
import { built, root } from './support.mjs';

const address = new URL('players.html', built);
const options = { skip: missing || (!existsSync(address) && `ports/web/build has not made ${address}`) };
/** A processor draws here, and takes most of the time for it: most tests need no picture. */
let browser, blind;
before(async () => {
  if (options.skip) return;
  browser = await Browser.start();
  blind = await Browser.start({ webgl: false });
});
after(() => Promise.all([browser?.stop(), blind?.stop()]));

const open = (settings, by = blind) =>
  by.open(`${address.href}#${settings}`, { viewport: { width: 720, height: 440 } });
const agrees = (page, ticks) =>
  page.waitForFunction((wanted) => Number(document.body.dataset.agreed) >= wanted, ticks);
const is = (page, verdict) =>
  page.waitForFunction((wanted) => document.body.dataset.verdict === wanted, verdict);
const paused = async (page) => {
  await page.waitForSelector('#pause.on');
  await drawn(page);
};
/** The numbers in a row of a player's table. */
const numbers = async (page, player, row) => {
  const cell = page.locator('.player').nth(player).locator('tr', { hasText: row }).locator('td').nth(1);
  return (await cell.textContent()).match(/\d+/g).map(Number);
};
/** Besides those of three.js, which finds no WebGL. */
const noFaults = (page) =>
  assert.deepEqual(
    page.faults.filter((text) => !/WebGL/.test(text)),
    [],
  );
const both = (page, row) => Promise.all([0, 1].map(async (player) => (await numbers(page, player, row))[0]));
/** Sets a slider, as the mouse does. */
const slide = (slider, value) =>
  slider.evaluate((input, to) => {
    input.value = to;
    input.dispatchEvent(new Event('input'));
  }, String(value));

test('two players agree over 3,600 ticks with 5 % loss', options, async (t) => {
  const page = await open('fast&loss=5&delay=80&jitter=40', browser);
  const then = performance.now();
  await agrees(page, 3600);
  t.diagnostic(`${((performance.now() - then) / 1000).toFixed(1)} s`);
  assert.match(await page.textContent('#verdict'), /^both agree after \d+ ticks$/);
  assert.ok(Number((await page.textContent('#verdict')).match(/\d+/)) >= 3600);
  assert.equal(await page.getAttribute('#verdict', 'class'), 'good');
  for (const count of await both(page, 'ticks rolled back')) assert.ok(count > 300, `${count} ticks rolled back`);
  for (const count of await both(page, 'predicted ticks')) assert.ok(count > 3000, `${count} ticks predicted`);
  assert.deepEqual(await both(page, 'waits'), [0, 0]);
  assert.deepEqual(page.faults, []);
  await page.close();
});

test('the same match has the same counts each time', options, async () => {
  const counts = [];
  for (const speed of ['fast&', '']) {
    const page = await open(`${speed}pause=150`);
    await paused(page);
    counts.push(await page.locator('.player table').allTextContents());
    await page.close();
  }
  assert.deepEqual(counts[0], counts[1]);
});

test('a setting of one machine only is named with its tick, and a new match agrees again', options, async () => {
  const page = await open('fast&pause=300');
  await paused(page);
  const [made, final] = await numbers(page, 1, 'tick');
  assert.equal(made, 300);
  await slide(page.locator('.gravity').nth(1), -5);
  await page.click('#pause');
  await is(page, 'bad');
  const text = await page.textContent('#verdict');
  const [tick] = text.match(/\d+/).map(Number);
  assert.equal(text, `they differ since tick ${tick}`);
  // It takes part in the first tick that is made, or made again, after the change.
  assert.ok(tick > final && tick <= made + 1, `tick ${tick} of ${final} to ${made}`);
  const agreed = Number(await page.evaluate(() => document.body.dataset.agreed));
  assert.ok(agreed < tick, `agreed after ${agreed}`);
  await drawn(page);
  assert.equal(await page.textContent('#verdict'), text);
  await page.click('#start');
  await is(page, 'good');
  assert.equal(await page.locator('.gravity').nth(1).inputValue(), '-10'); // -9.81, in steps of 0.5
  noFaults(page);
  await page.close();
});

test('without delay and loss nothing is rolled back; with loss, something is', options, async () => {
  const page = await open('fast&delay=0&jitter=0&loss=0&pause=600');
  await paused(page);
  assert.deepEqual(await both(page, 'ticks rolled back'), [0, 0]);
  for (const count of await both(page, 'predicted ticks')) assert.ok(count <= 2, `${count} ticks predicted`);
  await page.close();
  const lossy = await open('fast&delay=0&jitter=0&loss=40&pause=600');
  await paused(lossy);
  for (const count of await both(lossy, 'ticks rolled back')) assert.ok(count > 0, `${count} ticks rolled back`);
  await lossy.close();
});

test('beyond the window the machines wait, and still agree', options, async () => {
  const page = await open('fast&delay=300&jitter=200&loss=50');
  await agrees(page, 600);
  for (const count of await both(page, 'waits')) assert.ok(count > 50, `${count} waits`);
  assert.equal(await page.getAttribute('#verdict', 'class'), 'good');
  noFaults(page);
  await page.close();
});

test('a key is a player’s input, and the other machine rolls back', options, async () => {
  const page = await open('loss=0&jitter=0&delay=100');
  for (const player of [0, 1]) await page.locator('.auto').nth(player).click();
  // Every input from before the clicks has come once both agree over later ticks than those made by now.
  const now = Math.max(...(await both(page, 'tick')));
  await agrees(page, now + 1);
  const before = await both(page, 'ticks rolled back');
  await agrees(page, now + 60);
  assert.deepEqual(await both(page, 'ticks rolled back'), before); // no key is pressed
  await page.keyboard.down('d');
  await page.waitForFunction(
    (count) => parseInt(document.querySelectorAll('.player')[1].querySelectorAll('td')[5].textContent) > count,
    before[1],
  );
  assert.equal((await both(page, 'ticks rolled back'))[0], before[0]);
  await page.keyboard.up('d');
  await page.keyboard.down('ArrowUp');
  await page.waitForFunction(
    (count) => parseInt(document.querySelectorAll('.player')[0].querySelectorAll('td')[5].textContent) > count,
    before[0],
  );
  await page.keyboard.up('ArrowUp');
  noFaults(page);
  await page.close();
});

test('a key of a player that plays by itself ends that', options, async () => {
  const page = await open('');
  await agrees(page, 10);
  assert.equal(await page.locator('.auto.on').count(), 2);
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.querySelectorAll('.auto.on').length === 1);
  await page.close();
});

test('without WebGL the match runs', options, async () => {
  const page = await open('fast');
  await agrees(page, 300);
  assert.match(await page.textContent('#notice'), /^This browser has no WebGL/);
  await page.close();
});

test('the picture in the documentation is that of the page', options, async (t) => {
  const sharp = await Browser.start({ scale: 1 });
  t.after(() => sharp.stop());
  const page = await open('fast&delay=200&pause=505', sharp);
  await paused(page);
  const png = await page.screenshot();
  const file = new URL('docs/players.png', root);
  if (process.env.DETENT_RENEW_PICTURE) writeFileSync(file, png);
  const difference = await meanDifference(page, png, readFileSync(file));
  assert.ok(difference < 2, `the pixels differ by ${difference} of 255: renew it with DETENT_RENEW_PICTURE=1 tests/web/run`);
  assert.ok(readFileSync(file).length < 120e3);
  await page.close();
});

test('the page keeps to its size', options, (t) => {
  const page = readFileSync(address);
  const packed = gzipSync(page, { level: 9 }).length;
  t.diagnostic(`players.html: ${page.length} bytes, ${packed} with gzip`);
  assert.ok(packed <= 400e3, `${packed} bytes`);
});
