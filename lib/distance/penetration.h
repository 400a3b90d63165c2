#pragma once
#include "distance/simplex.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// How deeply two placed cores overlap. Lengths are in ulps: 2^-30 of the pair's unit of length (support.h).
struct Penetration {
  Vec32 normal;            ///< from A to B, Q30: the direction in which B must move
  int32_t depth;           ///< moving B by `depth` along the normal separates the cores, within k_penetration_slack
  int32_t lower;           ///< no translation shorter than `lower` separates them, within k_penetration_slack
  Vec32 point_a, point_b;  ///< A's point deepest in B, and B's point deepest in A; each from its own shape's centre
  int supports;            ///< number of support points evaluated
  bool capped;             ///< the vertex cap was reached; the true depth lies between `lower` and `depth`
};

/// The expanding polytope has at most this many vertices. Shapes with few faces need far fewer (tests/unit/distance).
inline constexpr int k_penetration_vertices_max = 64;

/// Error of Penetration::depth and Penetration::lower, ulps. Both are computed from the placed vertices; `depth` is
/// rounded up and `lower` down. Each component of the normal errs by up to k_normalise_error, the normal as a vector by
/// less than 6 2^-30. So the coordinate of a vertex along the normal errs by less than 6 ulps, because a vertex is
/// shorter than 2^30 ulps.
inline constexpr int k_penetration_slack = 8;

/// If a core is a cylinder or cone, the search ends when `depth - lower` is at most this many ulps. The support points
/// of such a core err by as much.
inline constexpr int k_penetration_gap = 4;

/// Finds the least translation of B (centre at `offset`) that separates it from A (centre at the origin), by an
/// expanding polytope (van den Bergen 2001). An exact sign makes every decision, so the polytope stays convex however
/// flat its faces are. Starts from the simplex with which gjk() found the overlap. If the Minkowski difference of the
/// cores has no volume (two segments, a point and a triangle, triangles in one plane), the depth is 0 and the normal is
/// perpendicular to the difference. Range: gjk() ended with `overlap`. Stack: slightly more than 4 KB.
Penetration penetration(const Placed& a, const Placed& b, const Vec32& offset, const Simplex& simplex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
