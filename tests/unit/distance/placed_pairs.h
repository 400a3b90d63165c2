#pragma once
#include <math.h>

#include <algorithm>
#include <vector>

#include "distance/gjk.h"
#include "tests/common/support/test.h"
#include "tests/unit/math/samples.h"
#include "tests/unit/shape/hull_bytes.h"

/// Random placed cores for the tests of lib/distance and lib/toi, and their penetration depth from all vertices.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Arrow {
  double x, y, z;
};
inline Arrow arrow(const Vec32& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Arrow operator-(const Arrow& a, const Arrow& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double dot(const Arrow& a, const Arrow& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Arrow cross(const Arrow& a, const Arrow& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Arrow& a) { return sqrt(dot(a, a)); }

/// A placed polytope: its vertices in the block, from its own centre, its edges, and the normals of its faces (of any
/// length).
struct Solid {
  std::vector<Vec32> vertices, edges;
  std::vector<Vec64> normals;
};

inline Solid solid_of(const Placed& placed) {
  Solid solid;
  CorePoint core;
  for (int i = 0; i < 255 && core_vertex(*placed.convex, static_cast<uint8_t>(i), core); ++i) {
    solid.vertices.push_back(placed.point(core.local));
  }
  const auto& v = solid.vertices;
  const auto add_triangle = [&](uint32_t i, uint32_t j, uint32_t k) {
    for (const Vec32& edge : {subtract(v[j], v[i]), subtract(v[k], v[j]), subtract(v[i], v[k])})
      solid.edges.push_back(edge);
    solid.normals.push_back(cross(subtract(v[j], v[i]), subtract(v[k], v[i])));
  };
  switch (placed.convex->type) {
    case ShapeType::capsule:
      solid.edges = {subtract(v[1], v[0])};
      break;
    case ShapeType::box:
      solid.edges = {subtract(v[1], v[0]), subtract(v[2], v[0]), subtract(v[4], v[0])};
      solid.normals = {cross(solid.edges[0], solid.edges[1]), cross(solid.edges[1], solid.edges[2]),
                       cross(solid.edges[2], solid.edges[0])};
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

/// The distance by which B must move against `normal` to leave A: the greatest normal.(b + offset - a) over the
/// vertices, over |normal|.
inline double reach_along(const Solid& a, const Solid& b, const Vec32& offset, const Arrow& normal) {
  double most_b = -HUGE_VAL, least_a = HUGE_VAL;
  for (const Vec32& v : b.vertices) most_b = std::max(most_b, dot(normal, arrow(v)));
  for (const Vec32& v : a.vertices) least_a = std::min(least_a, dot(normal, arrow(v)));
  return (most_b - least_a + dot(normal, arrow(offset))) / length(normal);
}

/// The least penetration depth, over the normals of all faces and all pairs of edges; HUGE_VAL if there are none. The
/// normals are exact before they become doubles, so the error is below 1e-5 ulps, however thin the shapes are.
inline double least_depth(const Solid& a, const Solid& b, const Vec32& offset) {
  double least = HUGE_VAL;
  const auto consider = [&](const Vec64& normal) {
    if (is_zero(normal)) return;
    const Arrow n = {static_cast<double>(normal.x), static_cast<double>(normal.y), static_cast<double>(normal.z)};
    least = std::min(least, reach_along(a, b, offset, n));
    least = std::min(least, reach_along(a, b, offset, {-n.x, -n.y, -n.z}));
  };
  for (const Vec64& n : a.normals) consider(n);
  for (const Vec64& n : b.normals) consider(n);
  for (const Vec32& e : a.edges) {
    for (const Vec32& f : b.edges) consider(cross(e, f));
  }
  return least;
}

inline constexpr int k_exponent = 2;  ///< of the block, so that the hulls fit into it

/// A random coordinate: from a small grid, so that points coincide and planes are shared; next to a grid value; or of
/// any size.
inline int32_t coordinate(Samples& samples, int kind, int bits) {
  const int32_t grid = static_cast<int32_t>(samples.below(5)) - 2;
  if (kind == 0) return grid;
  if (kind == 1) return grid * (1 << (bits - 3)) + static_cast<int32_t>(samples.below(3)) - 1;
  return static_cast<int32_t>(samples.integer(bits - 1));
}

/// A core whose axis-parallel integer coordinates a block represents exactly.
inline Convex random_convex(Samples& samples, ShapeType type, int kind) {
  Convex convex;
  if (type == ShapeType::hull) {
    const bool small = samples.below(2) == 0;
    const Asset asset = small ? Asset{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron}
                              : Asset{detent_hulls::k_prism, sizeof detent_hulls::k_prism};
    EXPECT_OK(make_hull(asset, Real(0.0), convex));
    return convex;
  }
  convex.type = type;
  convex.exponent = k_exponent;
  convex.core_radius = 1;
  for (int32_t& s : convex.size) {
    s = coordinate(samples, kind, 27);
    s = s < 0 ? -s : s == 0 ? 1 : s;
  }
  for (auto& corner : convex.corner) {
    for (int32_t& c : corner) c = coordinate(samples, kind, 27);
  }
  if (type == ShapeType::triangle && samples.below(8) == 0) {  // a segment
    for (int i = 0; i < 3; ++i) convex.corner[2][i] = convex.corner[1][i];
  }
  return convex;
}

inline Matrix32 random_rotation(Samples& samples) {
  for (;;) {
    const auto component = [&] { return static_cast<int64_t>(samples.bits() >> 33) - (1 << 30); };
    const int64_t q[4] = {component(), component(), component(), component()};
    double square = 0;
    for (const int64_t c : q) square += static_cast<double>(c) * static_cast<double>(c);
    const double size = sqrt(square) / 0x1p30;
    if (size > 1 || size < 0.1) continue;
    const auto scaled = [&](int64_t c) { return static_cast<int32_t>(llround(static_cast<double>(c) / size)); };
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
