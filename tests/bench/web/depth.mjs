/**
 * How deep two convex shapes overlap: the least distance by which one must move so that they only touch. Exact for
 * boxes, icosahedra, balls and capsules, whose cores are polytopes, points and segments.
 */
import { rotate } from './scenes.mjs';

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a, b, times = 1) => [a[0] + b[0] * times, a[1] + b[1] * times, a[2] + b[2] * times];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const size = (a) => Math.sqrt(dot(a, a));
const clamp = (value) => Math.min(1, Math.max(0, value));

/** The vertices of an icosahedron, whose distance from the centre is `radius`. */
export function icosahedronPoints(radius) {
  const golden = (1 + Math.sqrt(5)) / 2;
  const [a, b] = [1, golden].map((each) => (radius * each) / Math.hypot(1, golden));
  const signs = [-1, 1].flatMap((s) => [-1, 1].map((t) => [s * a, t * b]));
  return signs.flatMap(([s, t]) => [
    [0, s, t],
    [s, t, 0],
    [t, 0, s],
  ]);
}

/** Triangles of a polytope whose faces' corners are those that lie farthest along each normal. */
function polytope(points, normals) {
  const triangles = normals.flatMap((normal) => {
    const most = Math.max(...points.map((point) => dot(point, normal)));
    const corners = points.map((_, i) => i).filter((i) => dot(points[i], normal) > most - 1e-9);
    const start = minus(points[corners[0]], plus([0, 0, 0], normal, dot(points[corners[0]], normal)));
    const side = cross(normal, start);
    const angle = (i) => Math.atan2(dot(points[i], side) / size(side), dot(points[i], start) / size(start));
    corners.sort((i, j) => angle(i) - angle(j));
    return corners.slice(2).map((corner, i) => [corners[0], corners[i + 1], corner]);
  });
  const edges = [];
  for (const [a, b, c] of triangles)
    for (const [i, j] of [
      [a, b],
      [b, c],
      [c, a],
    ])
      if (i < j) edges.push([i, j]);
  return { points, triangles, edges, normals: half(normals), radius: 0 };
}
/** One of each two directions that are opposite. */
const half = (directions) => directions.filter((a, i) => !directions.slice(0, i).some((b) => dot(a, b) < -0.999999));

export function coreOf(shape) {
  const none = { triangles: [], edges: [], normals: [] };
  if (shape.kind === 'sphere') return { ...none, points: [[0, 0, 0]], radius: shape.radius };
  if (shape.kind === 'capsule') {
    return {
      ...none,
      points: [
        [0, -shape.half, 0],
        [0, shape.half, 0],
      ],
      edges: [[0, 1]],
      radius: shape.radius,
    };
  }
  if (shape.kind === 'box') {
    const [x, y, z] = shape.halfExtents;
    const points = [-1, 1].flatMap((i) => [-1, 1].flatMap((j) => [-1, 1].map((k) => [i * x, j * y, k * z])));
    return polytope(points, [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
      [-1, 0, 0],
      [0, -1, 0],
      [0, 0, -1],
    ]);
  }
  const points = icosahedronPoints(shape.radius);
  const near = (a, b) => a !== b && size(minus(a, b)) < 1.1 * shape.radius;
  const normals = [];
  points.forEach((a, i) =>
    points.forEach((b, j) =>
      points.forEach((c, k) => {
        if (i < j && j < k && near(a, b) && near(b, c) && near(c, a)) normals.push(plus(plus(a, b), c));
      }),
    ),
  );
  return polytope(
    points,
    normals.map((normal) => normal.map((each) => each / size(normal))),
  );
}

/** The core at a pose: the argument of depth(). */
export function placed(core, position, rotation) {
  const points = core.points.map((point) => plus(rotate(rotation, point), position));
  const along = core.edges
    .map(([i, j]) => minus(points[j], points[i]))
    .map((edge) => plus([0, 0, 0], edge, 1 / size(edge)));
  const directions = along.filter((a, i) => !along.slice(0, i).some((b) => Math.abs(dot(a, b)) > 0.999999));
  return { ...core, points, directions, normals: core.normals.map((normal) => rotate(rotation, normal)) };
}

/** Along an axis: by how much the cores overlap; below 0: how far they are apart. */
function overlapAlong(a, b, axis) {
  let [aLow, aHigh, bLow, bHigh] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const point of a.points) {
    const at = dot(point, axis);
    if (at < aLow) aLow = at;
    if (at > aHigh) aHigh = at;
  }
  for (const point of b.points) {
    const at = dot(point, axis);
    if (at < bLow) bLow = at;
    if (at > bHigh) bHigh = at;
  }
  return Math.min(aHigh - bLow, bHigh - aLow);
}

/** The separating axis theorem: the least overlap of the cores along the normals and the products of edges. */
function leastOverlap(a, b) {
  let least = Infinity;
  for (const axis of [...a.normals, ...b.normals]) {
    least = Math.min(least, overlapAlong(a, b, axis));
    if (least < 0) return least;
  }
  for (const u of a.directions)
    for (const v of b.directions) {
      const axis = cross(u, v);
      const length = size(axis);
      if (length < 1e-6) continue;
      least = Math.min(least, overlapAlong(a, b, plus([0, 0, 0], axis, 1 / length)));
      if (least < 0) return least;
    }
  return least;
}

function segments([p, q], [r, s]) {
  const [u, v, w] = [minus(q, p), minus(s, r), minus(p, r)];
  const [a, b, c, d, e] = [dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)];
  const determinant = a * c - b * b;
  let x = determinant > 1e-12 * a * c ? clamp((b * e - c * d) / determinant) : 0;
  const y = c > 0 ? clamp((b * x + e) / c) : 0;
  x = a > 0 ? clamp((b * y - d) / a) : 0;
  return size(minus(plus(p, u, x), plus(r, v, y)));
}

/** Only over the inside of the triangle: its edges are segments(). */
function aboveTriangle(point, [a, b, c]) {
  const [u, v, w] = [minus(b, a), minus(c, a), minus(point, a)];
  const normal = cross(u, v);
  const scale = dot(normal, normal);
  const [s, t] = [dot(cross(w, v), normal) / scale, dot(cross(u, w), normal) / scale];
  return s >= 0 && t >= 0 && s + t <= 1 ? Math.abs(dot(w, normal)) / Math.sqrt(scale) : Infinity;
}

/** The distance of two cores that do not overlap, one of which is a point or a segment. */
function distance(a, b) {
  if (a.points.length > 2) return distance(b, a);
  const ends = [a.points[0], a.points.at(-1)];
  if (b.points.length <= 2) return segments(ends, [b.points[0], b.points.at(-1)]);
  let least = Infinity;
  for (const [i, j] of b.edges) least = Math.min(least, segments(ends, [b.points[i], b.points[j]]));
  for (const triangle of b.triangles)
    for (const point of a.points)
      least = Math.min(
        least,
        aboveTriangle(
          point,
          triangle.map((i) => b.points[i]),
        ),
      );
  return least;
}

/** 0 or more. */
export function depth(a, b) {
  const radius = a.radius + b.radius;
  const overlap = a.normals.length + b.normals.length > 0 ? leastOverlap(a, b) : -1;
  if (overlap >= 0) return overlap + radius;
  return radius > 0 ? Math.max(0, radius - distance(a, b)) : 0;
}
