/** Times the steps of engines that take turns in one process. */
import { watch } from './measures.mjs';
import { Random } from './scenes.mjs';

const turn = 10; // steps in a row of one engine
const look = 20; // steps from one look at the poses to the next

function shuffled(list, random) {
  const result = [...list];
  for (let i = result.length - 1; i > 0; --i) {
    const j = Math.floor(random.next() * (i + 1));
    [result[i], result[j]] = [result[j], result[i]];
  }
  return result;
}

/** The engines' worlds, one beside the other, in turns whose order is drawn. `each`: called for every turn. */
function play(engines, scene, random, each) {
  const worlds = engines.map((engine) => engine.create(scene));
  for (let first = 0; first < scene.steps; first += turn)
    for (const i of shuffled([...engines.keys()], random))
      each(i, worlds[i], first, Math.min(first + turn, scene.steps));
  const ends = worlds.map((world) => JSON.stringify(world.poses()));
  const settings = worlds.map((world) => world.settings());
  for (const world of worlds) world.destroy();
  return { ends, settings };
}

/**
 * Of each engine: us of each step, the least of the repetitions, and the errors. The first run is not timed: it warms
 * the engines up and is looked at. All runs of an engine must end with the same poses.
 */
export function measure(engines, scene, { repetitions, seed }) {
  const random = new Random(seed);
  const watches = engines.map(() => watch(scene));
  const first = play(engines, scene, random, (i, world, begin, end) => {
    for (let step = begin; step < end; ++step) world.step();
    if (end % look === 0 || end === scene.steps) watches[i].see(world.poses());
  });
  const times = engines.map(() => new Float64Array(scene.steps).fill(Infinity));
  const same = engines.map(() => true);
  for (let repetition = 0; repetition < repetitions; ++repetition) {
    const { ends } = play(engines, scene, random, (i, world, begin, end) => {
      for (let step = begin; step < end; ++step) {
        const start = performance.now();
        world.step();
        times[i][step] = Math.min(times[i][step], 1000 * (performance.now() - start));
      }
    });
    ends.forEach((end, i) => (same[i] &&= end === first.ends[i]));
  }
  return engines.map((engine, i) => ({
    engine,
    times: times[i],
    errors: watches[i].values,
    repeats: same[i],
    settings: first.settings[i],
  }));
}

export function summary(times) {
  const sorted = Float64Array.from(times).sort();
  const at = (part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
  return {
    us_mean: times.reduce((sum, each) => sum + each, 0) / times.length,
    us_median: at(0.5),
    us_p99: at(0.99),
    us_max: sorted.at(-1),
  };
}
