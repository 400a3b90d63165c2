#pragma once
#include <detent/convex.h>

#include "math/rotation_integer.h"

/// Support mappings. A pair of shapes is placed in a *block*: world axes, integers in 2^-30 of the pair's unit of length,
/// which is so large that the Minkowski difference of the cores lies within 2^30 of the origin.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A point of a core in the shape's own axes, in 2^-30 of its own unit.
struct CorePoint {
  Vec32 local;
  uint8_t feature;  ///< names a vertex of the core; k_no_feature on a cylinder or cone
};
inline constexpr uint8_t k_no_feature = 255;

/// The vertex `feature` of the core. False if it has none of that name.
bool core_vertex(const Convex& convex, uint8_t feature, CorePoint& point);

/// The core's point farthest along `direction`, both in the shape's axes.
/// Of equally far points always the same one. Exact but for cylinder and cone, whose points err by 1 in each component.
/// Range: 0 < |direction| < 2^31. A half-space gives its origin.
CorePoint local_support(const Convex& convex, const Vec32& direction);

/// A core in a block, relative to its own centre.
struct Placed {
  const Convex* convex;
  Matrix32 rotation;
  int shift;       ///< own coordinates lose this many bits in the block, >= 0
  Vec32 axis[3];   ///< box and capsule: the columns times the half extents

  /// Where a local core point lies. Error: k_placing_error in each component.
  Vec32 point(const Vec32& local) const;
};
inline constexpr double k_placing_error = 1.5;  ///< ulps of the block: a box's point is the sum of three rounded axes

/// The largest value of direction . p over the core, and rate . p for the p that has it; both in the shape's axes.
struct SupportValue {
  int64_t value, rate;
};
SupportValue support_value(const Convex& convex, const Vec32& direction, const Vec32& rate);

Placed place(const Convex& convex, const Matrix32& rotation, int pair_exponent);

struct SupportPoint {
  Vec32 point;  ///< in the block, from the shape's centre
  CorePoint core;
};
/// The placed core's point farthest along `direction`, world axes. Range: 0 < |direction| < 2^31.
SupportPoint support(const Placed& placed, const Vec32& direction);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
