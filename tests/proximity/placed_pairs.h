#pragma once
#include <math.h>

#include <vector>

#include "proximity/gjk.h"
#include "tests/geometry/hull_bytes.h"
#include "tests/math/samples.h"
#include "tests/support/test.h"

/// Random placed cores for the tests of lib/proximity, and what all their vertices say in long double.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Arrow {
  long double x, y, z;
};
inline Arrow arrow(const Vec32& v) {
  return {static_cast<long double>(v.x), static_cast<long double>(v.y), static_cast<long double>(v.z)};
}
inline Arrow operator-(const Arrow& a, const Arrow& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline long double dot(const Arrow& a, const Arrow& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Arrow cross(const Arrow& a, const Arrow& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline long double length(const Arrow& a) { return sqrtl(dot(a, a)); }

/// A placed polytope: its vertices in the block from its own centre, its edges and its faces' normals (any length).
struct Solid {
  std::vector<Arrow> vertices, edges, normals;
};

inline Solid solid_of(const Placed& placed) {
  Solid solid;
  CorePoint core;
  for (int i = 0; i < 255 && core_vertex(*placed.convex, static_cast<uint8_t>(i), core); ++i) {
    solid.vertices.push_back(arrow(placed.point(core.local)));
  }
  const auto& v = solid.vertices;
  const auto add_triangle = [&](uint32_t i, uint32_t j, uint32_t k) {
    solid.edges.insert(solid.edges.end(), {v[j] - v[i], v[k] - v[j], v[i] - v[k]});
    solid.normals.push_back(cross(v[j] - v[i], v[k] - v[i]));
  };
  switch (placed.convex->type) {
    case ShapeType::capsule:
      solid.edges = {v[1] - v[0]};
      break;
    case ShapeType::box:
      solid.edges = {v[1] - v[0], v[2] - v[0], v[4] - v[0]};
      for (int i = 0; i < 3; ++i) solid.normals.push_back(cross(solid.edges[static_cast<size_t>(i)],
                                                                solid.edges[static_cast<size_t>((i + 1) % 3)]));
      break;
    case ShapeType::triangle:
      add_triangle(0, 1, 2);
      break;
    case ShapeType::hull: {
      const HullView hull = hull_of(*placed.convex);
      for (uint32_t f = 0; f < hull.face_count; ++f) {
        const HullIndices t = hull.triangles(f);
        for (uint32_t i = 0; i < t.count; i += 3) add_triangle(t.index[i], t.index[i + 1], t.index[i + 2]);
      }
      break;
    }
    default:
      break;
  }
  return solid;
}

/// How far B must move against `normal` to leave A: the greatest normal.(b + offset - a) over the vertices, over |normal|.
inline long double reach_along(const Solid& a, const Solid& b, const Vec32& offset, const Arrow& normal) {
  long double most_b = -HUGE_VALL, least_a = HUGE_VALL;
  for (const Arrow& v : b.vertices) most_b = std::max(most_b, dot(normal, v));
  for (const Arrow& v : a.vertices) least_a = std::min(least_a, dot(normal, v));
  return (most_b - least_a + dot(normal, arrow(offset))) / length(normal);
}

/// The least way out, tried along every face's normal and every pair of edges. HUGE_VALL if there are none.
inline long double least_depth(const Solid& a, const Solid& b, const Vec32& offset) {
  long double least = HUGE_VALL;
  const auto consider = [&](const Arrow& normal) {
    if (length(normal) == 0) return;
    least = std::min(least, reach_along(a, b, offset, normal));
    least = std::min(least, reach_along(a, b, offset, {-normal.x, -normal.y, -normal.z}));
  };
  for (const Arrow& n : a.normals) consider(n);
  for (const Arrow& n : b.normals) consider(n);
  for (const Arrow& e : a.edges) {
    for (const Arrow& f : b.edges) consider(cross(e, f));
  }
  return least;
}

inline Matrix32 random_rotation(Samples& samples) {
  for (;;) {
    const auto component = [&] { return static_cast<int64_t>(samples.bits() >> 33) - (1 << 30); };
    const int64_t q[4] = {component(), component(), component(), component()};
    long double square = 0;
    for (const int64_t c : q) square += static_cast<long double>(c) * static_cast<long double>(c);
    const long double size = sqrtl(square) / 0x1p30L;
    if (size > 1 || size < 0.1L) continue;
    const auto scaled = [&](int64_t c) { return static_cast<int32_t>(llroundl(static_cast<long double>(c) / size)); };
    return matrix_from(normalise(Quat32{scaled(q[0]), scaled(q[1]), scaled(q[2]), scaled(q[3])}));
  }
}

/// One of the 24 rotations that permute the axes.
inline Matrix32 random_quarter_turns(Samples& samples) {
  const int first = static_cast<int>(samples.below(3)), second = (first + 1 + static_cast<int>(samples.below(2))) % 3;
  const auto unit = [&](int axis) {
    const int32_t one = samples.below(2) == 0 ? 1 << 30 : -(1 << 30);
    return Vec32{axis == 0 ? one : 0, axis == 1 ? one : 0, axis == 2 ? one : 0};
  };
  const Vec32 x = unit(first), y = unit(second);
  return {{x, y, round_shift(detent::cross(x, y), 30)}};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
