/** Errors of a scene, from the poses of its bodies: the same for every engine. */
import { coreOf, depth, placed } from './depth.mjs';
import { rotate } from './scenes.mjs';

const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const radiusOf = ({ points, radius }) => radius + Math.max(...points.map((point) => Math.hypot(...point)));

/** By name: a measure of a scene's poses, which is taken from time to time. The greatest value counts, or `last`. */
const kinds = {
  /** m: of two bodies; not of the two of a joint. */
  penetration(scene) {
    const cores = scene.bodies.map(({ shape }) => coreOf(shape));
    const radii = cores.map(radiusOf);
    const joined = new Set(scene.joints.map(({ a, b }) => a * scene.bodies.length + b));
    return (poses) => {
      const shapes = poses.map(({ position, rotation }, i) => placed(cores[i], position, rotation));
      let most = 0;
      for (let i = 0; i < poses.length; ++i)
        for (let j = i + 1; j < poses.length; ++j)
          if (
            !(scene.bodies[i].fixed && scene.bodies[j].fixed) &&
            apart(poses[i].position, poses[j].position) < radii[i] + radii[j] &&
            !joined.has(i * poses.length + j)
          )
            most = Math.max(most, depth(shapes[i], shapes[j]));
      return most;
    };
  },
  /** m: of a body from its start. */
  drift: (scene) => (poses) => Math.max(...poses.map(({ position }, i) => apart(position, scene.bodies[i].position))),
  /** m: of a joint's two anchors. */
  gap: (scene) => (poses) => Math.max(...gaps(scene, poses)),
  /** The sum of all gaps over the length of the links. */
  stretch: (scene) => (poses) =>
    gaps(scene, poses).reduce((sum, each) => sum + each) / (0.5 * (scene.joints.length - 1)),
  /** Bodies that are outside the walls. */
  escaped: () => (poses) =>
    poses.filter(({ position: [x, y, z] }, i) => i > 4 && (Math.max(Math.abs(x), Math.abs(z)) > 5 || y < 0)).length,
  /** Bodies that are turned by less than 60 degrees at the end. */
  standing: (scene) =>
    last(
      (poses) =>
        poses.filter(({ rotation }, i) => !scene.bodies[i].fixed && rotate(rotation, [0, 1, 0])[1] > 0.5).length,
    ),
  /** m: along z. */
  sideways: () => (poses) => Math.max(...poses.map(({ position }) => Math.abs(position[2]))),
};
const last = (measure) => Object.assign(measure, { last: true });

function gaps(scene, poses) {
  const end = (i, anchor) => rotate(poses[i].rotation, anchor).map((each, k) => each + poses[i].position[k]);
  return scene.joints.map(({ a, b, anchorA, anchorB }) => apart(end(a, anchorA), end(b, anchorB)));
}

/** `see(poses)` from time to time; then `values`, by name. */
export function watch(scene) {
  const measures = scene.errors.map((name) => [name, kinds[name](scene)]);
  const values = Object.fromEntries(scene.errors.map((name) => [name, 0]));
  return {
    values,
    see(poses) {
      for (const [name, measure] of measures) {
        const value = measure(poses);
        values[name] = measure.last ? value : Math.max(values[name], value);
      }
    },
  };
}
