#pragma once
#include <detent/contact.h>
#include <detent/detail/state.h>

#include "math/arithmetic.h"
#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A candidate contact point, in the pair's frame.
struct PairPoint {
  Vec3<Unit> point;  ///< midway between the surfaces
  Unit separation;   ///< along the normal; negative when overlapping
  /// Key of the two features (vertices, edges, faces) that touch. It differs between the points of a manifold, stays
  /// the same while the features touch, and is not 0.
  uint32_t feature;
};

/// Contact of a pair: one normal and up to four points, in the pair's frame.
struct PairManifold {
  Vec3<Unit> normal;  ///< from A to B
  uint32_t count = 0;
  bool seam = false, turns = false, near = false;  ///< as in ContactGeometry
  PairPoint point[k_manifold_points_max];

  void add(const PairPoint& candidate) {
    DETENT_VERIFY_RANGE(count < k_manifold_points_max);
    point[count++] = candidate;
  }
};

/// One body of a pair: its shape in the pair's frame (world axes, origin at A's centre, unit of length 2^exponent m).
struct PairShape {
  ShapeType type;
  Vec3<Unit> centre;
  Matrix3 rotation;
  Vec3<Unit> size;  ///< half extents of a box; (radius, half length, 0) of a round shape
};

/// A pair, scaled so that the centres, both shapes and the gap between them lie within the unit ball around A's centre.
/// Every sum of two projections then fits a Unit, and the relative precision is the same for bodies of a millimetre and
/// of a hundred metres.
struct PairFrame {
  int exponent;  ///< the pair's unit of length is 2^exponent m
  Unit margin;   ///< contact margin: a point with a larger separation is left out
  Unit sunk;     ///< as ContactMargins::sunk, in the pair's unit
  bool smooth_seams;
  ManifoldReduction reduction;
  PairShape a, b;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
