/** A headless Chromium for a test, with software WebGL and an empty profile; and pages made by `detent view`. */
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { root } from './support.mjs';

export const tool =
  process.env.DETENT_TOOL ?? fileURLToPath(new URL('build/x86-64-gcc/ports/host/detent/detent', root));
export const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
const packages = createRequire(new URL('ports/web/package.json', root));

/** Why the tests of the page cannot run; false if they can. */
export const missing = !existsSync(chromium)
  ? 'Chromium is not installed (Debian: chromium)'
  : !existsSync(tool)
    ? `the detent tool is not built: ${tool}`
    : false;

export const flags = [
  '--headless',
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];

export class Browser {
  /** `scale`: pixels that are drawn for one of the layout's. A processor draws here: its time grows with their number. */
  static async start({ webgl = true, scale = 0.25 } = {}) {
    const { chromium: driver } = packages('playwright-core');
    const folder = mkdtempSync(join(tmpdir(), 'detent-page-'));
    const context = await driver.launchPersistentContext(join(folder, 'profile'), {
      executablePath: chromium,
      args: webgl ? flags : [...flags.slice(0, 8), '--disable-3d-apis'],
      viewport: { width: 1280, height: 800 },
      deviceScaleFactor: scale,
      offline: true,
    });
    context.setDefaultTimeout(120000); // ms: a slow machine, beside other work
    return new Browser(context, folder);
  }
  constructor(context, folder) {
    this.context = context;
    this.folder = folder;
  }
  async stop() {
    await this.context.close();
    rmSync(this.folder, { recursive: true, force: true });
  }

  /** A recording of a scene of the tool's. */
  record(scene, ...options) {
    const file = join(this.folder, 'scene.rec');
    execFileSync(tool, ['record', scene, '-o', file, ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
    return new Uint8Array(readFileSync(file));
  }

  /** Writes a page of these bytes by the tool; returns its address. */
  make(name, bytes, ...options) {
    const recording = join(this.folder, name);
    const page = `${recording}.html`;
    writeFileSync(recording, bytes);
    execFileSync(tool, ['view', recording, '-o', page, ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
    return pathToFileURL(page).href;
  }

  /** As make(), of two recordings, a.rec and b.rec. */
  makePair(a, b) {
    const files = ['a.rec', 'b.rec'].map((name) => join(this.folder, name));
    writeFileSync(files[0], a);
    writeFileSync(files[1], b);
    const page = join(this.folder, 'pair.html');
    execFileSync(tool, ['view', ...files, '-o', page], { stdio: ['ignore', 'pipe', 'pipe'] });
    return pathToFileURL(page).href;
  }
  /** What `detent diff` says of a.rec and b.rec, without the line's start. */
  difference() {
    const run = spawnSync(tool, ['diff', 'a.rec', 'b.rec'], { cwd: this.folder, encoding: 'utf8' });
    return run.stdout.trim();
  }

  /** A page as make() writes it, but with other bytes for its recording: the tool would refuse them. */
  makeOf(name, bytes, instead) {
    const address = this.make(name, bytes);
    const page = readFileSync(new URL(address), 'utf8');
    const base64 = (list) => Buffer.from(list).toString('base64');
    writeFileSync(
      new URL(address),
      page.replace(base64(bytes), () => base64(instead)),
    );
    return address;
  }

  /**
   * Opens a page from the disk. `script`: a function that runs before those of the page. `faults` collects what the page
   * says on its console as an error, and its exceptions.
   */
  async open(address, { viewport, script } = {}) {
    const page = await this.context.newPage();
    if (viewport !== undefined) await page.setViewportSize(viewport);
    if (script !== undefined) await page.addInitScript(script);
    page.faults = [];
    page.on('console', (message) => {
      // A remark of the software renderer, which only a screenshot causes.
      if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall'))
        page.faults.push(message.text());
    });
    page.on('pageerror', (error) => page.faults.push(String(error)));
    page.on('request', (request) => {
      if (!/^(file|data|blob):/.test(request.url())) page.faults.push(`a request to ${request.url()}`);
    });
    await page.goto(address);
    return page;
  }
}

/** Waits for the page to say whether every tick agrees. */
export async function verdictOf(page) {
  await page.waitForFunction(() => ['good', 'bad'].includes(document.body.dataset.verdict));
  return page.textContent('#verdict');
}
/** Waits until the page shows this tick. */
export const shows = (page, tick) =>
  page.waitForFunction((wanted) => document.body.dataset.tick === String(wanted), tick);

/** Runs a function in an empty page, whose policy allows it, with the pixels of PNGs. */
async function withPixels(page, pngs, body) {
  const [empty] = page.context().pages(); // the one that a browser starts with
  return empty.evaluate(
    async ([list, source]) => {
      const pixels = [];
      for (const base64 of list) {
        const image = new Image();
        image.src = `data:image/png;base64,${base64}`;
        await image.decode();
        const to = new OffscreenCanvas(image.width, image.height).getContext('2d');
        to.drawImage(image, 0, 0);
        pixels.push(to.getImageData(0, 0, image.width, image.height).data);
      }
      return new Function(`return ${source}`)()(...pixels);
    },
    [pngs.map((png) => png.toString('base64')), String(body)],
  );
}

/** Waits until the page has drawn what it was told, on a slow machine too. */
export const drawn = (page) =>
  page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))),
  );

/** A picture of the scene alone; how many colours it has, and how many vivid ones: those of bodies that move. */
export async function picture(page) {
  await drawn(page);
  const png = await page.screenshot({
    clip: { x: 310, y: 60, width: 610, height: 480 },
    style: '#tools, #inspector, #notice { visibility: hidden }',
  });
  const [colours, vivid] = await withPixels(page, [png], (data) => {
    const [known, bright] = [new Set(), new Set()];
    for (let i = 0; i < data.length; i += 4) {
      const [red, green, blue] = data.subarray(i);
      const colour = (red << 16) | (green << 8) | blue;
      known.add(colour);
      if (Math.max(red, green, blue) - Math.min(red, green, blue) > 60) bright.add(colour);
    }
    return [known.size, bright.size];
  });
  return { png, colours, vivid };
}

/** Of two pictures: the mean difference of a channel, 0 to 255; 255 if their sizes differ. */
export const meanDifference = (page, a, b) =>
  withPixels(page, [a, b], (left, right) => {
    if (left.length !== right.length) return 255;
    let sum = 0;
    for (let i = 0; i < left.length; ++i) sum += Math.abs(left[i] - right[i]);
    return sum / (left.length * 0.75);
  });
