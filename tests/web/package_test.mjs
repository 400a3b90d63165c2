/** The package as its users get it: its example, its types, its sizes. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { built, configs, root } from './support.mjs';

const example = /```js\n([^]*?)```/.exec(readFileSync(new URL('ports/web/README.md', root), 'utf8'))[1];

/** Runs `body` in a project that has the package installed, and the example as a file. */
function inProject(body) {
  const folder = mkdtempSync(join(tmpdir(), 'detent-package-'));
  try {
    mkdirSync(join(folder, 'node_modules'));
    symlinkSync(fileURLToPath(new URL('package', built)), join(folder, 'node_modules/detent'));
    writeFileSync(join(folder, 'package.json'), '{"type": "module"}');
    writeFileSync(join(folder, 'example.js'), example);
    return body(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

test('the example of the README runs, and prints what it says', () => {
  const said = inProject((folder) => execFileSync('node', ['example.js'], { cwd: folder, encoding: 'utf8' }));
  assert.match(said, /^0\.500 m\nevery one of 120 ticks agrees\n$/);
});

test('the example of the README has the types of the package', () => {
  const tsc = fileURLToPath(new URL('ports/web/node_modules/.bin/tsc', root));
  const flags = [
    '--noEmit',
    '--allowJs',
    '--checkJs',
    '--strict',
    '--target',
    'es2022',
    '--module',
    'nodenext',
    '--types',
    '',
  ];
  const check = (text) =>
    inProject((folder) => {
      writeFileSync(join(folder, 'example.js'), text);
      execFileSync(tsc, [...flags, 'example.js'], { cwd: folder, encoding: 'utf8', stdio: 'pipe' });
    });
  check(example);
  assert.throws(
    () => check(example.replace('sphere(0.5)', "sphere('large')")),
    ({ stdout }) => /example\.js.*TS2345/.test(stdout),
  );
});

test('modules import nothing, and keep to their sizes', (t) => {
  for (const config of configs) {
    for (const [name, most] of [
      [config, 290e3],
      [`${config}.small`, 175e3],
    ]) {
      const bytes = readFileSync(new URL(`package/dist/detent.${name}.wasm`, built));
      assert.deepEqual(WebAssembly.Module.imports(new WebAssembly.Module(bytes)), []);
      const packed = gzipSync(bytes, { level: 9 }).length;
      t.diagnostic(`detent.${name}.wasm: ${bytes.length} bytes, ${packed} with gzip`);
      assert.ok(packed <= most, `${name}: ${packed} bytes`);
    }
  }
});

test('pages keep to their size', (t) => {
  for (const config of configs) {
    const page = readFileSync(new URL(`view/${config}.html`, built));
    const packed = gzipSync(page, { level: 9 }).length;
    t.diagnostic(`${config}.html: ${page.length} bytes, ${packed} with gzip`);
    assert.ok(packed <= 400e3, `${config}: ${packed} bytes`);
  }
});

test('the lock file names no registry', () => {
  assert.doesNotMatch(readFileSync(new URL('ports/web/package-lock.json', root), 'utf8'), /"resolved"/);
});
