#pragma once
#include <detent/distance.h>

#include "math/root.h"
#include "math/rotation_integer.h"
#include "shape/hull.h"

/// Support mappings. A pair of shapes is placed in a *block*: world axes, integers in 2^-30 of the pair's unit of
/// length. The unit is so large that the Minkowski difference of the cores lies within 2^30 ulps of the origin.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A point of a core in the shape's own axes, in 2^-30 of its own unit.
struct CorePoint {
  Vec32 local;
  uint8_t feature;  ///< number of a vertex of the core; k_no_feature on a cylinder or cone
};
inline constexpr uint8_t k_no_feature = 255;

/// Sets `point` to the vertex `feature` of the core. Returns false if there is no such vertex.
bool core_vertex(const Convex& convex, uint8_t feature, CorePoint& point);

/// A view of the convex's hull; empty for other shapes.
inline HullView hull_of(const Convex& convex) {
  return convex.type == ShapeType::hull ? hull_view(convex.hull) : HullView{};
}

/// Computes the coordinates of a hull's vertices along a direction: exact dot products, in the hull's axes.
class HullHeights {
 public:
#if defined(__OPTIMIZE_SIZE__)
  HullHeights(const HullView& hull, const Vec32& direction) : hull_(hull), direction_(direction) {}
  int64_t of(uint32_t i) const { return dot(hull_.vertex(i), direction_); }

 private:
  const HullView& hull_;
  const Vec32& direction_;
#else
  HullHeights(const HullView& hull, const Vec32& direction)
      : x_(hull.bytes + hull.at.x),
        y_(hull.bytes + hull.at.y),
        z_(hull.bytes + hull.at.z),
        dx_(direction.x),
        dy_(direction.y),
        dz_(direction.z) {}
  int64_t of(size_t i) const {
    return dx_ * cooked_i32(x_ + 4 * i) + dy_ * cooked_i32(y_ + 4 * i) + dz_ * cooked_i32(z_ + 4 * i);
  }

 private:
  const uint8_t *x_, *y_, *z_;
  int64_t dx_, dy_, dz_;
#endif
};

/// Returns the core's point farthest along `direction`; both are in the shape's axes. `hull`: hull_of(convex), computed
/// once for many calls. `start`: the vertex from which hill climbing starts on a large hull; any value is safe, and the
/// last result is the fastest. Ties: the same arguments always give the same point. Exact except for cylinders and
/// cones, whose points err by 1 in each component. Range: 0 < |direction| < 2^31. The result for a half-space is its
/// origin.
CorePoint local_support(const Convex& convex, const HullView& hull, const Vec32& direction, uint8_t start);
inline CorePoint local_support(const Convex& convex, const Vec32& direction) {
  return local_support(convex, hull_of(convex), direction, 0);
}
/// As local_support(), for a hull.
CorePoint hull_support(const HullView& hull, const Vec32& direction, uint32_t start);
/// Hulls with more vertices than this use hill climbing instead of a linear search.
inline constexpr uint32_t k_climbing_vertices = 8;

/// A core in a pair's block: rotated to world axes and scaled to ulps (2^-30 of the pair's unit of length). Its points
/// are relative to the core's own centre.
class Placed {
 public:
  const Convex* convex;
  HullView hull;  ///< hull_of(*convex)
  Matrix32 rotation;
  int shift;      ///< >= 0: the pair's unit of length is 2^shift times the shape's own unit
  Vec32 axis[3];  ///< box and capsule: the rotation's columns times the half extents

  /// Converts a core point from the shape's axes to world axes and ulps. Error: k_placing_error in each component.
  Vec32 point(const Vec32& local) const {
    if (convex->type == ShapeType::box) return box_point(local.x >> 31, local.y >> 31, local.z >> 31);
    return other_point(local);
  }
  /// As point(), for hulls, triangles, cylinders and cones.
  Vec32 turned(const Vec32& local) const {
    return shift > 32 ? Vec32{0, 0, 0} : round_shift(multiply(rotation, local), 30 + shift);
  }
  /// Returns a vertex of a box, in world axes, in ulps from the box's centre. The arguments are the signs of the
  /// vertex's coordinates in the box's axes: -1 for negative, 0 for positive.
  Vec32 box_point(int32_t x, int32_t y, int32_t z) const {
    const auto sum = [&](int32_t a, int32_t b, int32_t c) { return ((a ^ x) - x) + ((b ^ y) - y) + ((c ^ z) - z); };
    return {sum(axis[0].x, axis[1].x, axis[2].x), sum(axis[0].y, axis[1].y, axis[2].y),
            sum(axis[0].z, axis[1].z, axis[2].z)};
  }

 private:
  Vec32 other_point(const Vec32& local) const;
};
/// Error of Placed::point() in each component, in ulps: a box's point is the sum of three rounded axes.
inline constexpr double k_placing_error = 1.5;

/// Returns an upper bound of |v|, which exceeds |v| by at most 1.6 % plus 2. Range: |v|^2 < 2^63.
inline int64_t length_bound_32(const Vec32& v) { return square_root_bound(static_cast<uint64_t>(dot(v, v))); }
/// The length of (v.x, v.z), rounded to nearest.
inline int64_t length_across(const Vec32& v) {
  return square_root_nearest(static_cast<uint64_t>(int64_t{v.x} * v.x) + static_cast<uint64_t>(int64_t{v.z} * v.z));
}

/// The result of support_value(). `value`: the largest dot product of `direction` and a point p of the core. `rate`:
/// the dot product of the argument `rate` and that p. Both arguments are in the shape's axes. `start`: as for
/// local_support(); set to the feature of p, unless the shape is a sphere, half-space, capsule or box.
struct SupportValue {
  int64_t value, rate;
};
SupportValue support_value(const Convex& convex, const HullView& hull, const Vec32& direction, const Vec32& rate,
                           uint8_t& start);

/// Places a core in a block whose unit of length is 2^pair_exponent m. `rotation`: from the shape's axes to the
/// world's. `convex` must outlive the result.
Placed place(const Convex& convex, const Matrix32& rotation, int pair_exponent);

struct SupportPoint {
  Vec32 point;  ///< from the shape's centre, in world axes, ulps
  CorePoint core;
};
/// Returns the placed core's point farthest along `direction` (world axes). `start`: as for local_support().
/// Range: 0 < |direction| < 2^31.
inline SupportPoint support(const Placed& placed, const Vec32& direction, uint8_t start = 0);

/// Returns the vertex of a box whose coordinates have the given signs (-1: negative, 0: positive). Bit i of its
/// `feature` is set if coordinate i is negative.
inline CorePoint box_vertex(const Convex& box, int32_t x, int32_t y, int32_t z) {
  const int32_t* size = box.size;
  return {{(size[0] ^ x) - x, (size[1] ^ y) - y, (size[2] ^ z) - z}, static_cast<uint8_t>((x & 1) | (y & 2) | (z & 4))};
}

inline SupportPoint support(const Placed& placed, const Vec32& direction, uint8_t start) {
  const Convex& convex = *placed.convex;
  if (convex.type == ShapeType::box) {
    const auto sign = [&](const Vec32& axis) { return static_cast<int32_t>(dot(direction, axis) >> 63); };
    const int32_t x = sign(placed.axis[0]), y = sign(placed.axis[1]), z = sign(placed.axis[2]);
    return {placed.box_point(x, y, z), box_vertex(convex, x, y, z)};
  }
  if (convex.type == ShapeType::sphere) return {{0, 0, 0}, {{0, 0, 0}, 0}};
  if (convex.type == ShapeType::capsule) {
    const Vec32& axis = placed.axis[1];
    const int32_t back = static_cast<int32_t>(dot(direction, axis) >> 63);
    return {{(axis.x ^ back) - back, (axis.y ^ back) - back, (axis.z ^ back) - back},
            {{0, (convex.size[1] ^ back) - back, 0}, static_cast<uint8_t>(back & 1)}};
  }
#if !defined(__OPTIMIZE_SIZE__)
  if (convex.type == ShapeType::hull) {
    const CorePoint vertex = hull_support(placed.hull, rotate_inverse(placed.rotation, direction), start);
    return {placed.turned(vertex.local), vertex};
  }
#endif
  const CorePoint core = local_support(convex, placed.hull, rotate_inverse(placed.rotation, direction), start);
  return {placed.point(core.local), core};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
