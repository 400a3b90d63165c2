#pragma once
#include <detent/detail/state.h>

#include "contact/terrain_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Compares the bounds of the parts (ConvexParts) of two bodies, in A's axes, to find the pairs of parts that cannot
/// come near each other.
class PartCulling {
 public:
  /// `displacement`: how far B moves relative to A, m, world axes. Two parts that stay farther apart than `distance`,
  /// m, during this motion are culled; `distance` must include the motion that rotations add. No part is culled if a
  /// body is a half-space, or if a value is out of range.
  PartCulling(const BodyProperties& a, const Pose& pose_a, const BodyProperties& b, const Pose& pose_b, Real distance,
              const Vec3<Real>& displacement);

  /// Converts a box, given by its middle and half extents, 2^-46 m, from B's axes to A's axes, and extends it to
  /// contain the box during all of B's displacement relative to A.
  void bring(Vec64& middle, Vec64& half) const;
  /// Whether parts with these boxes may come near each other. `middle_b` and `half_b`: as bring() returns them.
  bool meet(const Vec64& middle_a, const Vec64& half_a, const Vec64& middle_b, const Vec64& half_b) const;

 private:
  TerrainPlace place_;
  int64_t margin_ = 0;                   ///< 2^-46 m
  Vec64 half_displacement_ = {0, 0, 0};  ///< half of B's displacement relative to A, in A's axes, 2^-46 m
  bool known_;                           ///< false: no part is culled
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
