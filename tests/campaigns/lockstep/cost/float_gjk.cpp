#include "float_gjk.h"

#include <math.h>

namespace float_gjk {

namespace {

constexpr uint32_t k_iterations_max = 32;
constexpr float k_precision = 1e-6f;  // of the squared distance

Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(const Vector& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Placed {
  const Solid* solid;
  Vector position, column[3];
  uint32_t start = 0;  // of the hill climbing: the last result
};

Placed place(const Solid& solid, const Pose& p) {
  Placed placed;
  placed.solid = &solid;
  placed.position = p.position;
  const float x2 = p.x + p.x, y2 = p.y + p.y, z2 = p.z + p.z;
  const float xx = p.x * x2, yy = p.y * y2, zz = p.z * z2, xy = p.x * y2, xz = p.x * z2, yz = p.y * z2;
  const float wx = p.w * x2, wy = p.w * y2, wz = p.w * z2;
  placed.column[0] = {1 - (yy + zz), xy + wz, xz - wy};
  placed.column[1] = {xy - wz, 1 - (xx + zz), yz + wx};
  placed.column[2] = {xz + wy, yz - wx, 1 - (xx + yy)};
  return placed;
}

uint32_t climb(const Solid& solid, const Vector& d, uint32_t best) {
  float most = dot(solid.vertices[best], d);
  for (bool climbs = true; climbs;) {
    climbs = false;
    const uint32_t from = solid.neighbour_offsets[best], to = solid.neighbour_offsets[best + 1];
    for (uint32_t i = from; i < to; ++i) {
      const float value = dot(solid.vertices[solid.neighbours[i]], d);
      if (!(value > most)) continue;
      most = value;
      best = solid.neighbours[i];
      climbs = true;
    }
  }
  return best;
}

uint32_t search(const Solid& solid, const Vector& d) {
  uint32_t best = 0;
  float most = dot(solid.vertices[0], d);
  for (uint32_t i = 1; i < solid.vertex_count; ++i) {
    const float value = dot(solid.vertices[i], d);
    if (!(value > most)) continue;
    most = value;
    best = i;
  }
  return best;
}

Vector support(Placed& placed, const Vector& direction) {
  const Vector d = {dot(direction, placed.column[0]), dot(direction, placed.column[1]),
                    dot(direction, placed.column[2])};
  Vector local;
  if (placed.solid->is_box) {
    const Vector& h = placed.solid->half_extents;
    local = {d.x < 0 ? -h.x : h.x, d.y < 0 ? -h.y : h.y, d.z < 0 ? -h.z : h.z};
  } else if (placed.solid->neighbours != nullptr) {
    placed.start = climb(*placed.solid, d, placed.start);
    local = placed.solid->vertices[placed.start];
  } else {
    local = placed.solid->vertices[search(*placed.solid, d)];
  }
  return placed.position + placed.column[0] * local.x + placed.column[1] * local.y + placed.column[2] * local.z;
}

struct Vertex {
  Vector difference, a, b;  // difference = b - a
  float weight;
};
struct Simplex {
  Vertex vertex[4];
  uint32_t count = 0;
};

Vector nearest(const Simplex& s) {
  Vector sum = s.vertex[0].difference * s.vertex[0].weight;
  for (uint32_t i = 1; i < s.count; ++i) sum = sum + s.vertex[i].difference * s.vertex[i].weight;
  return sum;
}

void keep(Simplex& s, const Vertex& a) {
  s.vertex[0] = a;
  s.vertex[0].weight = 1;
  s.count = 1;
}

void keep(Simplex& s, const Vertex& a, const Vertex& b, float weight_b) {
  const Vertex second = b;
  s.vertex[0] = a;
  s.vertex[1] = second;
  s.vertex[0].weight = 1 - weight_b;
  s.vertex[1].weight = weight_b;
  s.count = 2;
}

void reduce_segment(Simplex& s) {
  const Vector& a = s.vertex[0].difference;
  const Vector ab = s.vertex[1].difference - a;
  const float t = -dot(a, ab), square = dot(ab, ab);
  if (t <= 0) return keep(s, s.vertex[0]);
  if (t >= square) return keep(s, s.vertex[1]);
  keep(s, s.vertex[0], s.vertex[1], t / square);
}

void reduce_triangle(Simplex& s) {
  const Vertex va = s.vertex[0], vb = s.vertex[1], vc = s.vertex[2];
  const Vector &a = va.difference, &b = vb.difference, &c = vc.difference;
  const Vector ab = b - a, ac = c - a;
  const float d1 = -dot(ab, a), d2 = -dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return keep(s, va);
  const float d3 = -dot(ab, b), d4 = -dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return keep(s, vb);
  const float weight_c = d1 * d4 - d3 * d2;
  if (weight_c <= 0 && d1 >= 0 && d3 <= 0) return keep(s, va, vb, d1 / (d1 - d3));
  const float d5 = -dot(ab, c), d6 = -dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return keep(s, vc);
  const float weight_b = d5 * d2 - d1 * d6;
  if (weight_b <= 0 && d2 >= 0 && d6 <= 0) return keep(s, va, vc, d2 / (d2 - d6));
  const float weight_a = d3 * d6 - d5 * d4;
  if (weight_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return keep(s, vb, vc, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const float scale = 1 / (weight_a + weight_b + weight_c);
  s.vertex[0].weight = weight_a * scale;
  s.vertex[1].weight = weight_b * scale;
  s.vertex[2].weight = weight_c * scale;
}

bool holds(const Simplex& s, const Vector& v) {
  for (uint32_t i = 0; i < s.count; ++i) {
    const Vector& d = s.vertex[i].difference;
    if (d.x == v.x && d.y == v.y && d.z == v.z) return true;
  }
  return false;
}

/// False if the origin is inside.
bool reduce_tetrahedron(Simplex& s) {
  constexpr uint32_t k_faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
  Simplex best;
  float least = INFINITY;
  for (const uint32_t(&face)[4] : k_faces) {
    const Vector& a = s.vertex[face[0]].difference;
    const Vector normal = cross(s.vertex[face[1]].difference - a, s.vertex[face[2]].difference - a);
    const float origin = -dot(normal, a), fourth = dot(normal, s.vertex[face[3]].difference - a);
    if (origin * fourth > 0) continue;
    Simplex triangle;
    for (uint32_t i = 0; i < 3; ++i) triangle.vertex[i] = s.vertex[face[i]];
    triangle.count = 3;
    reduce_triangle(triangle);
    const Vector v = nearest(triangle);
    const float square = dot(v, v);
    if (square >= least) continue;
    least = square;
    best = triangle;
  }
  if (best.count == 0) return false;
  s = best;
  return true;
}

}  // namespace

Result distance(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
  Placed placed_a = place(a, pose_a), placed_b = place(b, pose_b);
  Simplex s;
  Vector v = pose_b.position - pose_a.position;
  Result result = {};
  float square = dot(v, v);
  for (; result.iterations < k_iterations_max; ++result.iterations) {
    const Vector on_a = support(placed_a, v), on_b = support(placed_b, v * -1.0f);
    const Vector difference = on_b - on_a;
    if (s.count != 0 && (square - dot(v, difference) <= k_precision * square || holds(s, difference))) break;
    s.vertex[s.count++] = {difference, on_a, on_b, 1};
    if (s.count == 2) {
      reduce_segment(s);
    } else if (s.count == 3) {
      reduce_triangle(s);
    } else if (s.count == 4 && !reduce_tetrahedron(s)) {
      return result;
    }
    const Vector next = nearest(s);
    const float next_square = dot(next, next);
    if (s.count != 1 && next_square >= square) break;  // not nearer: rounding limit
    v = next;
    square = next_square;
    if (square <= 1e-14f) return result;
  }
  result.distance = sqrtf(square);
  for (uint32_t i = 0; i < s.count; ++i) {
    result.point_a = result.point_a + s.vertex[i].a * s.vertex[i].weight;
    result.point_b = result.point_b + s.vertex[i].b * s.vertex[i].weight;
  }
  return result;
}

}  // namespace float_gjk
