/** Digests in Firefox and in Chromium: those of Node.js and of the native tool, with every shape and every joint. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { tool } from './browser.mjs';
import { browsers, withBrowser } from './firefox.mjs';
import { built, configs, load, root } from './support.mjs';

const scene = new URL('every_type.json', import.meta.url);
const missingTool = !existsSync(tool) && `the detent tool is not built: ${tool}`;

/** The digests of all ticks, in hexadecimal. It runs in the page, too. */
function digestsOf(detent, recording, assets) {
  const replay = detent.openRecording(recording);
  replay.start(assets);
  const digests = [];
  while (!replay.step().finished) digests.push(replay.digest().toString(16).padStart(16, '0'));
  replay.close();
  return digests;
}

/** Replays in the browser; posts the digests, or why there are none. */
const page = `<!doctype html><title>Digests</title><script type="module">
const digestsOf = ${digestsOf};
const bytes = async (path) => new Uint8Array(await (await fetch(path)).arrayBuffer());
const result = {};
try {
  const { load } = await import('/package/dist/index.js');
  const assets = await Promise.all((await (await fetch('/assets')).json()).map((_, i) => bytes('/asset/' + i)));
  for (const config of ${JSON.stringify(configs)})
    result[config] = digestsOf(await load(config), await bytes('/recording/' + config), assets);
} catch (error) {
  result.error = String(error);
}
await fetch('/result', { method: 'POST', body: JSON.stringify(result) });
</script>`;

/** The tool's recordings of the scene and the digests that it printed, by configuration; and the scene's assets. */
const recordings = {};
const native = {};
let assets;
before(() => {
  if (missingTool) return;
  const folder = mkdtempSync(join(tmpdir(), 'detent-digests-'));
  for (const config of configs) {
    const file = join(folder, `${config}.rec`);
    const options = ['--config', config, '--print', 'ticks', '--json', '--record', file];
    const printed = execFileSync(tool, ['run', fileURLToPath(scene), ...options], { encoding: 'utf8' });
    const rows = printed
      .trim()
      .split('\n')
      .map((line) => JSON.parse(line));
    assets = rows.pop().assets.map((asset) => new Uint8Array(readFileSync(new URL(asset.file, scene))));
    recordings[config] = new Uint8Array(readFileSync(file));
    native[config] = rows.map((row) => row.digest);
  }
  rmSync(folder, { recursive: true });
});

/** Gives the page, and what it asks for. `result`: what it posts. */
async function serve() {
  let post;
  const result = new Promise((resolve) => (post = resolve));
  const types = { js: 'text/javascript', wasm: 'application/wasm' };
  const server = createServer(async (request, response) => {
    const send = (type, body) => response.writeHead(200, { 'Content-Type': type }).end(body);
    const [kind, ...names] = request.url.slice(1).split('/');
    if (kind === '') send('text/html', page);
    else if (kind === 'assets') send('application/json', JSON.stringify(assets.map((each) => each.length)));
    else if (kind === 'asset') send('application/octet-stream', assets[names[0]]);
    else if (kind === 'recording') send('application/octet-stream', recordings[names[0]]);
    else if (kind === 'package')
      send(types[request.url.split('.').at(-1)], readFileSync(new URL(request.url.slice(1), built)));
    else if (kind === 'result') {
      let text = '';
      for await (const part of request) text += part;
      send('text/plain', '');
      post(JSON.parse(text));
    } else response.writeHead(404).end(); // favicon.ico
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const close = () => (server.close(), server.closeAllConnections());
  return { address: `http://127.0.0.1:${server.address().port}/`, result, close };
}

test('the recording has every shape, every kind of terrain and every joint', { skip: missingTool }, async () => {
  const { shape, joint } = JSON.parse(readFileSync(new URL('docs/scene.schema.json', root), 'utf8')).$defs;
  const replay = (await load('fx64')).openRecording(recordings.fx64);
  replay.start(assets);
  const has = (types) => [...new Set(types)].sort();
  const shapes = replay.bodies().map(({ id }) => replay.body(id).def.shape);
  assert.deepEqual(
    has(shapes.map(({ type }) => type)),
    has(shape.oneOf.map(({ properties }) => properties.type.const)),
  );
  assert.deepEqual(has(replay.jointLines().map(({ type }) => type)), has(joint.properties.type.enum));
  // A mesh and a height field: their files begin with other bytes.
  const terrains = shapes.filter(({ type }) => type === 'terrain').map(({ asset }) => assets[asset].slice(0, 8));
  assert.equal(has(terrains.map(String)).length, 2);
  replay.close();
});

for (const config of configs) {
  test(`every tick has the native digest in Node.js, ${config}`, { skip: missingTool }, async () => {
    assert.equal(native[config].length, 240);
    assert.deepEqual(digestsOf(await load(config), recordings[config], assets), native[config]);
  });
}

for (const [name, browser] of Object.entries(browsers)) {
  test(`every tick has the native digest in ${name}`, { skip: browser.missing || missingTool }, async () => {
    const { address, result, close } = await serve();
    try {
      const found = await withBrowser(browser, address, result);
      assert.equal(found.error, undefined);
      for (const config of configs) assert.deepEqual(found[config], native[config], config);
    } finally {
      close();
    }
  });
}
