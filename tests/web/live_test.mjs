/** Live scenes: the page of samples, bodies that are thrown, settings, and what is saved. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { Browser, drawn, missing, picture, tool } from './browser.mjs';
import { built, root } from './support.mjs';

const samplesPage = new URL('samples.html', built);
const options = { skip: missing };
const sampleOptions = {
  skip: missing || (!existsSync(samplesPage) && `ports/web/build has had no tool: there is no ${samplesPage}`),
};
let browser;
before(async () => {
  if (!missing) browser = await Browser.start();
});
after(() => browser?.stop());

const samples = readFileSync(new URL('ports/web/samples.txt', root), 'utf8')
  .split('\n')
  .filter((line) => line !== '' && !line.startsWith('#'));
const titleOf = (file) => basename(file, '.json').replaceAll('_', ' ');
const run = (...list) => execFileSync(tool, list, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

/** Opens a page in a small window. */
const open = (address, script) => browser.open(address, { viewport: { width: 930, height: 560 }, script });
/**
 * As open(), but each scene is paused when it begins, before its first tick: Playwright's keys come later, on a slow
 * machine after any number of ticks.
 */
const openPaused = (address) =>
  open(address, () => {
    const pause = () => window.dispatchEvent(new KeyboardEvent('keydown', { key: ' ' }));
    const attributes = { subtree: true, attributeFilter: ['data-scene'] };
    new MutationObserver(pause).observe(document, attributes);
  });
const tickOf = (page) => page.evaluate(() => Number(document.body.dataset.tick));
const passes = (page, tick) =>
  page.waitForFunction((wanted) => Number(document.body.dataset.tick) >= wanted, tick);
/** Waits for the start of this scene, in a page that openPaused() has opened. */
const starts = (page, name) =>
  page.waitForFunction(
    (wanted) => document.body.dataset.scene === wanted && document.body.dataset.tick === '0',
    name,
  );
/** Steps a paused scene to a tick, by keys between two frames; returns the digest that the page shows there. */
async function digestAt(page, tick) {
  await page.evaluate((wanted) => {
    const left = wanted - Number(document.body.dataset.tick);
    const press = (shiftKey) => window.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', shiftKey }));
    for (let i = 0; i < Math.floor(left / 10); ++i) press(true);
    for (let i = 0; i < left % 10; ++i) press(false);
  }, tick);
  await page.waitForFunction((wanted) => Number(document.body.dataset.tick) === wanted, tick);
  return page.textContent('#digest');
}

test('there are samples of each kind', () => {
  assert.ok(samples.length >= 40);
  assert.equal(new Set(samples.map(titleOf)).size, samples.length);
});

test('every sample loads, is drawn, and has the digest of detent run after 60 ticks', sampleOptions, async (t) => {
  // It begins with another scene than the first that is clicked, which would begin twice.
  const page = await openPaused(`${samplesPage.href}#${basename(samples.at(-1), '.json')}`);
  for (const file of samples) {
    const name = titleOf(file);
    await page.locator('#list button', { hasText: new RegExp(`^${name}$`) }).click();
    await starts(page, name);
    const digest = await digestAt(page, 60);
    const summary = JSON.parse(run('run', fileURLToPath(new URL(file, root)), '--ticks', '60', '--json').split('\n')[0]);
    assert.equal(digest, summary.digest, name);
    assert.equal(await page.textContent('#verdict'), 'as recorded', name);
    const { colours } = await picture(page);
    assert.ok(colours > 50, `${name}: ${colours} colours`);
    assert.deepEqual(page.faults, [], name);
  }
  t.diagnostic(`${samples.length} samples`);
  await page.close();
});

test('the list is searched by names and descriptions', sampleOptions, async () => {
  const page = await open(samplesPage.href);
  await page.locator('#list button').first().waitFor();
  const shown = () => page.locator('#list button:visible').allTextContents();
  assert.equal((await shown()).length, samples.length);
  await page.fill('#search', 'stones arch');
  assert.deepEqual(await shown(), ['arch of 13 stones', 'arch of 13 stones with a load']);
  await page.fill('#search', 'mortar'); // of a description
  assert.deepEqual(await shown(), ['arch of 13 stones']);
  await page.fill('#search', 'no such words');
  assert.deepEqual(await shown(), []);
  assert.ok(await page.isVisible('#none'));
  await page.close();
});

test('an address names a scene, and bodies behind walls are seen through glass', sampleOptions, async () => {
  const page = await openPaused(`${samplesPage.href}#eight_fast_bodies_in_a_room`);
  await starts(page, 'eight fast bodies in a room');
  await drawn(page);
  assert.equal(await page.getAttribute('[data-look=glass]', 'aria-pressed'), 'true');
  const glass = (await picture(page)).vivid;
  assert.ok(glass > 50, `${glass} colours of bodies through glass`);
  await page.keyboard.press('g');
  const walls = (await picture(page)).vivid;
  assert.equal(walls, 0, 'the walls do not hide the bodies');
  await page.locator('#list button', { hasText: /^door sprung$/ }).click();
  await starts(page, 'door sprung');
  assert.equal(new URL(page.url()).hash, '#door_sprung');
  await page.evaluate(() => (location.hash = '%zz'));
  await page.waitForFunction(() => document.body.dataset.scene === 'stack');
  await drawn(page);
  assert.equal(await page.getAttribute('[data-look=glass]', 'aria-pressed'), 'false');
  assert.deepEqual(page.faults, []);
  await page.close();
});

/** Writes a scene and its page. */
function pageOf(name, scene, ...more) {
  const file = join(browser.folder, `${name}.json`);
  writeFileSync(file, JSON.stringify({ format: 1, ...scene }));
  run('view', file, '-o', `${file}.html`, ...more);
  return { file, address: `file://${file}.html` };
}
const ground = { name: 'ground', type: 'fixed', shape: { type: 'half_space' } };
const crate = { name: 'crate', position: [0, 0.5, 0], shape: { type: 'box', half_extents: [0.5, 0.5, 0.5] } };
/** The position of the chosen body, as the page shows it. */
const position = async (page) => {
  const text = await page.textContent('#inspector table tr:first-child td:nth-child(2)');
  return text.replace(' m', '').split(', ').map(Number);
};
const middle = async (page) => {
  const { x, y, width, height } = await page.locator('#stage').boundingBox();
  return [x + width / 2, y + height / 2];
};
/** The recording that the page saves, verified by the tool; returns its file. */
async function saved(page, name) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  assert.equal(download.suggestedFilename(), `${name}.rec`);
  const file = join(browser.folder, 'saved.rec');
  await download.saveAs(file);
  assert.match(run('verify', file), /ticks equal/);
  return file;
}
/** Sets a slider, as the mouse does. */
const slide = (page, id, value) =>
  page.evaluate(
    ([slider, to]) => {
      const input = document.getElementById(slider);
      input.value = to;
      input.dispatchEvent(new Event('input'));
      input.dispatchEvent(new Event('change'));
    },
    [id, String(value)],
  );

test('a body is picked up with the mouse, moved and thrown, and the recording of it verifies', options, async () => {
  const { address } = pageOf('crate', { ticks: 3000, bodies: [ground, crate] });
  const page = await open(address);
  await passes(page, 5);
  const [x, y] = await middle(page);
  // A click chooses the body, and changes nothing.
  await page.mouse.move(x, y);
  await page.mouse.down();
  await passes(page, (await tickOf(page)) + 10);
  await page.mouse.up();
  await page.waitForSelector('#inspector:not([hidden])');
  assert.equal(await page.textContent('#verdict'), 'as recorded');
  await page.mouse.down();
  await page.mouse.move(x, y - 200, { steps: 5 });
  await page.waitForFunction(() => document.body.dataset.held === '2');
  const from = await tickOf(page);
  await passes(page, from + 60);
  const held = await position(page);
  assert.ok(held[1] > 0.7, `held at ${held}`);
  assert.equal(await page.textContent('#verdict'), 'live, changed');
  // It is let go in its flight to the mouse, however many ticks lie between two frames.
  await page.mouse.move(x + 400, y - 200, { steps: 2 });
  while ((await position(page))[0] < 0.6) await passes(page, (await tickOf(page)) + 1);
  await page.mouse.up();
  await page.waitForFunction(() => document.body.dataset.held === '');
  await passes(page, (await tickOf(page)) + 60);
  const thrown = await position(page);
  assert.ok(Math.hypot(thrown[0], thrown[2]) > 0.5, `thrown to ${thrown}`);
  const file = await saved(page, 'crate');
  // The saved recording has the whole: what was seen, from the scene's start on.
  const ticks = await tickOf(page);
  const length = Number(/(\d+) ticks/.exec(run('info', file))[1]);
  assert.ok(length >= from + 120 && length <= ticks, `${length} of ${ticks} ticks`);
  // It goes on, and can be saved again.
  await passes(page, ticks + 5);
  await saved(page, 'crate');
  assert.deepEqual(page.faults, []);
  await page.close();
});

test('the camera turns where no body is held', options, async () => {
  const { address } = pageOf('turned', { bodies: [ground, crate] });
  const page = await openPaused(address);
  await starts(page, 'turned');
  const still = (await picture(page)).png;
  const [x, y] = await middle(page);
  await page.mouse.move(x + 300, y - 150);
  await page.mouse.down();
  await page.mouse.move(x + 380, y - 130, { steps: 3 });
  await page.mouse.up();
  assert.equal(await page.evaluate(() => document.body.dataset.held), '');
  assert.notDeepEqual((await picture(page)).png, still);
  await page.close();
});

test('the camera turns again after a restart has taken the body from the mouse', options, async () => {
  const { address } = pageOf('restarted', { bodies: [ground, crate] });
  const page = await open(address);
  await passes(page, 5);
  const [x, y] = await middle(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - 20, { steps: 3 });
  await page.waitForFunction(() => document.body.dataset.held === '2');
  await page.keyboard.press('Home');
  await page.waitForFunction(() => document.body.dataset.held === '');
  await page.mouse.up();
  await page.keyboard.press(' ');
  await drawn(page);
  const still = (await picture(page)).png;
  await page.mouse.move(x + 300, y - 150);
  await page.mouse.down();
  await page.mouse.move(x + 380, y - 130, { steps: 3 });
  await page.mouse.up();
  assert.notDeepEqual((await picture(page)).png, still);
  await page.close();
});

test('a recording that is saved after a call and before the next step verifies', options, async () => {
  const { address } = pageOf('between', { ticks: 100, bodies: [ground, crate] });
  const page = await openPaused(address);
  await starts(page, 'between');
  await digestAt(page, 60);
  await slide(page, 'gravity', 5);
  await drawn(page);
  await saved(page, 'between');
  await page.close();
});

test('two scenes of one name are both in the list', options, async () => {
  const { file, address } = pageOf('twice', { bodies: [ground, crate] });
  run('view', file, file, '-o', fileURLToPath(address));
  const page = await open(address);
  assert.deepEqual(await page.locator('#list button').allTextContents(), ['twice', 'twice (2)']);
  await page.click('#list button:nth-child(2)');
  await page.waitForSelector('#list button:nth-child(2).on');
  await page.close();
});

test('sliders change gravity, substeps and friction by recorded calls', options, async () => {
  const slope = { name: 'slope', type: 'fixed', rotation: { axis: [0, 0, 1], degrees: 20 }, shape: { type: 'half_space' } };
  const at = { ...crate, position: [0, 0.55, 0], rotation: { axis: [0, 0, 1], degrees: 20 } };
  const { address } = pageOf('slope', { ticks: 600, bodies: [slope, at] });
  const page = await openPaused(address);
  await starts(page, 'slope');
  await digestAt(page, 60);
  const [x, y] = await middle(page);
  await page.mouse.click(x, y);
  const rests = await position(page);
  assert.ok(Math.abs(rests[0]) < 0.3, `it stands at ${rests}`);
  await slide(page, 'friction', 0);
  await digestAt(page, 120);
  assert.ok((await position(page))[0] < -0.7, 'it does not slide without friction');
  assert.equal(await page.textContent('#friction-value'), '× 0');
  assert.equal(await page.textContent('#verdict'), 'live, changed');
  await slide(page, 'gravity', 5);
  await digestAt(page, 180);
  assert.equal(await page.textContent('#gravity-value'), '5.0 m/s²');
  assert.ok((await position(page))[1] > 1, 'it does not rise');
  await slide(page, 'substeps', 7);
  await digestAt(page, 181);
  assert.equal(await page.textContent('#substeps-value'), '7');
  await saved(page, 'slope');
  // From the start again, all is as the scene says.
  await page.keyboard.press('Home');
  await starts(page, 'slope');
  await drawn(page);
  assert.equal(await page.textContent('#gravity-value'), '-9.8 m/s²');
  assert.equal(await page.textContent('#friction-value'), '× 1');
  assert.equal(await page.textContent('#verdict'), 'as recorded');
  await page.close();
});

test('a scene makes its calls at their ticks, and goes on live after its last one', options, async () => {
  const lift = { tick: 20, call: 'set_gravity', gravity: [0, 3, 0] };
  const { file, address } = pageOf('lift', { ticks: 30, bodies: [ground, crate], actions: [lift] }, '--config', 'f32');
  const page = await openPaused(address);
  await starts(page, 'lift');
  const digest = await digestAt(page, 30);
  assert.equal(digest, JSON.parse(run('run', file, '--config', 'f32', '--json').split('\n')[0]).digest);
  assert.equal(await page.textContent('#verdict'), 'as recorded');
  assert.equal(await page.textContent('#gravity-value'), '3.0 m/s²');
  await digestAt(page, 40);
  assert.equal(await page.textContent('#verdict'), 'live');
  await page.close();
});

test('a call of the scene that the changed world refuses is told', options, async () => {
  // An impulse at a point that the body has left.
  const push = { tick: 90, call: 'apply_impulse', body: 'crate', impulse: [1, 0, 0], point: [0, 0.5, 0] };
  const { address } = pageOf('pushed', { ticks: 100, bodies: [ground, crate], actions: [push] });
  const page = await openPaused(address);
  await starts(page, 'pushed');
  await slide(page, 'gravity', 10);
  await digestAt(page, 100);
  assert.equal(await page.textContent('#lost'), '1 calls of the scene refused');
  await saved(page, 'pushed');
  await page.close();
});

test('a page with a damaged scene says so', options, async () => {
  const { address } = pageOf('damaged', { bodies: [ground, crate] });
  const file = fileURLToPath(address);
  const text = readFileSync(file, 'utf8');
  writeFileSync(file, text.replace(/(class="scene"[^>]*>.{400})..../, '$1////'));
  const page = await open(address);
  await page.waitForSelector('#notice:not([hidden])');
  assert.match(await page.textContent('#notice'), /^This scene cannot be shown: corrupt/);
  await page.mouse.click(...(await middle(page)));
  await page.keyboard.press('r');
  assert.deepEqual(page.faults, []);
  await page.close();
});
