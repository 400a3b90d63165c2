/** The package `detent`, with its own modules or another one. */
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { icosahedronPoints } from '../depth.mjs';
import { hullRadii } from '../scenes.mjs';

/** The hulls of the scenes, cooked by the tool. */
function cookHulls(tool) {
  const folder = mkdtempSync(join(tmpdir(), 'detent-bench-'));
  try {
    return hullRadii.map((radius) => {
      const files = ['hull.obj', 'hull.hull'].map((name) => join(folder, name));
      writeFileSync(
        files[0],
        icosahedronPoints(radius)
          .map((point) => `v ${point.join(' ')}\n`)
          .join(''),
      );
      const said = execFileSync(tool, ['cook', '--json', '--exact', ...files], { encoding: 'utf8' });
      // All axes of an icosahedron are principal, so the tool has no reason to turn it.
      if (JSON.parse(said).rotation[3] !== 1) throw new Error('a hull has another frame than its points');
      return new Uint8Array(readFileSync(files[1]));
    });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** `source`: 'fx64', 'f32', or the path of a module. */
export async function detent({ name, source, built, tool }) {
  const api = await import(new URL('package/dist/index.js', pathToFileURL(`${built}/`)));
  const library = await api.load(source.endsWith('.wasm') ? pathToFileURL(source) : source);
  const hulls = cookHulls(tool);
  const shapes = {
    box: ({ halfExtents }) => api.box(halfExtents),
    sphere: ({ radius }) => api.sphere(radius),
    capsule: ({ radius, half }) => api.capsule(radius, half),
    icosahedron: ({ radius }) => api.hull(hullRadii.indexOf(radius)),
  };

  return {
    name,
    version: `simulation version ${library.simulationVersion}`,
    create(scene) {
      const count = scene.bodies.length;
      const capacity = { bodies: count, contacts: 12 * count + 64, joints: scene.joints.length, assets: hulls.length };
      const world = library.createWorld({ capacity, sleeping: false }, hulls);
      hulls.forEach((_, i) => world.bindAsset(i));
      const ids = scene.bodies.map(({ shape, position, rotation, density, fixed }) =>
        world.createBody({
          type: fixed ? 'fixed' : 'dynamic',
          shape: shapes[shape.kind](shape),
          position,
          rotation,
          density,
          ...(scene.collisions === false && { filter: { mask: 0 } }),
        }),
      );
      for (const { type, a, b, anchorA, anchorB, lower, upper } of scene.joints) {
        const axis = type === 'hinge' ? { limited: true, lower, upper } : {};
        world.createJoint({ type, a: ids[a], b: ids[b], anchorA, anchorB, axis });
      }
      return {
        step() {
          const { lost } = world.step();
          if (lost.pairs + lost.contacts > 0) throw new Error(`${name}: too little room for contacts`);
        },
        poses: () => ids.map((id) => world.pose(id)),
        settings: () => world.settings(),
        destroy: () => world.destroy(),
      };
    },
  };
}
