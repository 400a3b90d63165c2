/** ./bench web: the package beside other engines of npm, in Node.js. See --help. */
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { detent } from './engines/detent.mjs';
import { jolt } from './engines/jolt.mjs';
import { rapier } from './engines/rapier.mjs';
import { scenes } from './scenes.mjs';
import { table } from './table.mjs';
import { measure, summary } from './timing.mjs';

const usage = `usage: ./bench web [--scenes LIST] [--engines LIST] [--module NAME=FILE]... [--repetitions N] [--seed S]
                   [--json FILE]

  --scenes       of ${scenes.map(({ name }) => name).join(', ')}; all of them by default
  --engines      of fx64, f32, fx64.small, f32.small (the package), rapier, rapier-deterministic, rapier-simd, jolt;
                 all of them by default
  --module       a further engine: the package with another module
  --repetitions  3: of each step the least time counts
  --seed         1: of the order in which engines take turns
`;
const { values: options } = parseArgs({
  options: {
    scenes: { type: 'string' },
    engines: { type: 'string' },
    module: { type: 'string', multiple: true, default: [] },
    repetitions: { type: 'string', default: '3' },
    seed: { type: 'string', default: '1' },
    json: { type: 'string' },
    built: { type: 'string' }, // where ports/web/build has written
    tool: { type: 'string' },
    help: { type: 'boolean' },
  },
});
if (options.help) {
  console.log(usage);
  process.exit();
}
const refuse = (text) => {
  console.error(`bench: ${text}`);
  process.exit(2);
};
const count = (name) => (/^[1-9]\d{0,3}$/.test(options[name]) ? Number(options[name]) : refuse(`--${name}: 1 to 9999`));
const { built, tool } = options;
const makers = {
  ...Object.fromEntries(
    ['fx64', 'f32', 'fx64.small', 'f32.small'].map((source) => [
      source,
      (name) => detent({ name, source, built, tool }),
    ]),
  ),
  rapier: (name) => rapier({ name, source: '@dimforge/rapier3d-compat' }),
  'rapier-deterministic': (name) => rapier({ name, source: '@dimforge/rapier3d-deterministic-compat' }),
  'rapier-simd': (name) => rapier({ name, source: '@dimforge/rapier3d-simd-compat' }),
  jolt: (name) => jolt({ name }),
};
for (const each of options.module) {
  const [, name, source] = /^([^=]+)=(.+\.wasm)$/.exec(each) ?? refuse(`--module ${each}: NAME=FILE.wasm`);
  makers[name] = () => detent({ name, source, built, tool });
}
/** What an option lists, of what is known; all of it by default. */
const wanted = (name, known) =>
  options[name]
    ?.split(',')
    .map((each) => (known.includes(each) ? each : refuse(`--${name}: ${each} is none of ${known.join(', ')}`))) ??
  known;
const names = wanted('engines', Object.keys(makers));
const chosen = wanted(
  'scenes',
  scenes.map(({ name }) => name),
).map((name) => scenes.find((scene) => scene.name === name));
const run = { repetitions: count('repetitions'), seed: count('seed') };

const engines = [];
for (const name of names) engines.push(await makers[name](name));
const rows = [];
for (const scene of chosen)
  for (const { engine, times, errors, repeats, settings } of measure(engines, scene, run)) {
    if (!repeats) console.error(`bench: ${scene.name}, ${engine.name}: its runs end differently`);
    for (const [row, [begin, end]] of Object.entries(scene.windows))
      rows.push({
        scene: row,
        engine: engine.name,
        version: engine.version,
        bodies: scene.bodies.filter(({ fixed }) => !fixed).length,
        ...summary(times.subarray(begin, end)),
        errors,
        settings,
      });
  }
console.log(table(rows));
if (options.json) writeFileSync(options.json, `[\n${rows.map((row) => JSON.stringify(row)).join(',\n')}\n]\n`);
