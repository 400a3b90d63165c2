/** The geometry of a body's shape, in the body's frame. */
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  IcosahedronGeometry,
  LatheGeometry,
  Matrix4,
  PlaneGeometry,
  Quaternion,
  SphereGeometry,
  Vector2,
  Vector3,
} from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';
import { RoundedBoxGeometry } from 'three/addons/geometries/RoundedBoxGeometry.js';
import { mergeGeometries, toCreasedNormals } from 'three/addons/utils/BufferGeometryUtils.js';
import type { Full, OutlinePart, Shape } from '../src/index.js';

const creaseAngle = 0.6;
const up = new Vector3(0, 1, 0);

/** A body of revolution about y: a convex profile (radius, y), from below to above, rounded by a ball. */
function revolve(profile: [number, number][], rounding: number): BufferGeometry {
  const normalAngle = (from: [number, number], to: [number, number]) => Math.atan2(from[0] - to[0], to[1] - from[1]);
  const points: Vector2[] = [];
  profile.forEach((point, i) => {
    const before = i === 0 ? -Math.PI / 2 : normalAngle(profile[i - 1]!, point);
    const after = i === profile.length - 1 ? Math.PI / 2 : normalAngle(point, profile[i + 1]!);
    const steps = rounding > 0 ? Math.max(1, Math.ceil((after - before) / 0.2)) : 0;
    for (let k = 0; k <= steps; ++k) {
      const angle = before + (steps === 0 ? 0 : ((after - before) * k) / steps);
      points.push(
        new Vector2(Math.max(0, point[0] + rounding * Math.cos(angle)), point[1] + rounding * Math.sin(angle)),
      );
    }
  });
  return new LatheGeometry(points, 32);
}

/** The hull of points, rounded by a ball: the hull of balls of few points. */
function convex(points: Float64Array, radius: number): BufferGeometry {
  const cores: Vector3[] = [];
  for (let i = 0; i < points.length; i += 3) cores.push(new Vector3(points[i], points[i + 1], points[i + 2]));
  if (cores.length === 1) return new SphereGeometry(radius, 32, 20).translate(...cores[0]!.toArray());
  if (cores.length === 2) return capsuleBetween(cores[0]!, cores[1]!, radius);
  if (radius === 0) return new ConvexGeometry(cores);
  const ball = directions();
  return new ConvexGeometry(cores.flatMap((core) => ball.map((d) => core.clone().addScaledVector(d, radius))));
}
function capsuleBetween(a: Vector3, b: Vector3, radius: number): BufferGeometry {
  const along = b.clone().sub(a);
  const turn = new Quaternion().setFromUnitVectors(up, along.clone().normalize());
  return new CapsuleGeometry(radius, along.length(), 12, 32).applyMatrix4(
    new Matrix4().compose(a.clone().add(b).multiplyScalar(0.5), turn, new Vector3(1, 1, 1)),
  );
}
function directions(): Vector3[] {
  const at = new IcosahedronGeometry(1, 1).getAttribute('position');
  const known = new Map<string, Vector3>();
  for (let i = 0; i < at.count; ++i) {
    const d = new Vector3().fromBufferAttribute(at, i);
    known.set(
      d
        .toArray()
        .map((x) => x.toFixed(4))
        .join(),
      d,
    );
  }
  // With the axes, along which the faces of many hulls lie.
  for (const axis of [up, new Vector3(1, 0, 0), new Vector3(0, 0, 1)]) {
    known.set(axis.toArray().join(), axis);
    known.set(`-${axis.toArray().join()}`, axis.clone().negate());
  }
  return [...known.values()];
}

function triangles(points: Float64Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** Makes the rotation of a round body visible: a darker tone on every second quarter of it, of a ball on every second octant. */
function withTones(geometry: BufferGeometry, round: 'ball' | 'round' | ''): BufferGeometry {
  const at = geometry.getAttribute('position');
  const tones = new Float32Array(3 * at.count).fill(1);
  for (let i = 0; round !== '' && i < at.count; i += 3) {
    const middle = (axis: 'getX' | 'getY' | 'getZ') => at[axis](i) + at[axis](i + 1) + at[axis](i + 2);
    const above = round === 'ball' && middle('getY') > 0;
    if (middle('getX') > 0 !== (middle('getZ') > 0 !== above)) tones.fill(0.72, 3 * i, 3 * i + 9);
  }
  geometry.setAttribute('color', new BufferAttribute(tones, 3));
  return geometry;
}

/** `outline`: the parts of a shape that has an asset. `planeSize`: how far a half-space is drawn, m. */
export function geometryOf(shape: Full<Shape>, outline: OutlinePart[], planeSize: number): BufferGeometry {
  const { radius, halfLength: h, rounding } = shape;
  const creased = (geometry: BufferGeometry, round: 'ball' | 'round' | '' = '') =>
    withTones(toCreasedNormals(geometry, creaseAngle), round);
  switch (shape.type) {
    case 'sphere':
      return creased(new SphereGeometry(radius, 32, 20), 'ball');
    case 'capsule':
      return creased(
        revolve(
          [
            [0, -h],
            [0, h],
          ],
          radius,
        ),
        'round',
      );
    case 'cylinder':
      return creased(
        revolve(
          [
            [0, -h],
            [radius, -h],
            [radius, h],
            [0, h],
          ],
          rounding,
        ),
        'round',
      );
    case 'cone':
      return creased(
        revolve(
          [
            [0, -h / 2],
            [radius, -h / 2],
            [0, 1.5 * h],
          ],
          rounding,
        ),
        'round',
      );
    case 'half_space':
      return new PlaneGeometry(planeSize, planeSize).rotateX(-Math.PI / 2);
    case 'box': {
      const [x, y, z] = shape.halfExtents;
      const [width, height, depth] = [x, y, z].map((half) => 2 * (half + rounding)) as [number, number, number];
      if (rounding === 0) return creased(new BoxGeometry(width, height, depth));
      return creased(new RoundedBoxGeometry(width, height, depth, 4, rounding));
    }
    default: {
      const parts = outline.map((part) => {
        const geometry = part.kind === 'triangles' ? triangles(part.points) : convex(part.points, part.radius);
        return part.kind === 'triangles' ? withTones(geometry, '') : creased(geometry);
      });
      for (const part of parts) part.deleteAttribute('uv');
      return parts.length === 0 ? creased(new SphereGeometry(0.1)) : mergeGeometries(parts);
    }
  }
}
