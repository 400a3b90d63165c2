#pragma once
#include "distance/simplex.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// How deep two placed cores overlap. Lengths in ulps of the block.
struct Penetration {
  Vec32 normal;            ///< from A to B, Q30: the way B must move
  int32_t depth;           ///< moved by this along the normal, B leaves A, but for k_penetration_slack
  int32_t lower;           ///< no shorter way of B parts the cores, but for k_penetration_slack
  Vec32 point_a, point_b;  ///< the deepest points of A in B and of B in A, each from its own centre
  int supports;            ///< support points asked for
  bool capped;             ///< the cap of vertices was met: between `lower` and `depth` it is not decided
};

/// The polytope holds at most so many vertices. Polytopes of few faces need far fewer (tests/unit/distance).
inline constexpr int k_penetration_vertices_max = 64;

/// Ulps of the block. `depth` and `lower` are those of the placed vertices, rounded up and down; the normal errs by up
/// to k_normalise_error in each component, together below 6 2^-30, and so does the place of a vertex shorter than 2^30
/// along it.
inline constexpr int k_penetration_slack = 8;

/// For a cylinder or cone, the search ends when `depth - lower` is at most so many ulps: their supports err by as much.
inline constexpr int k_penetration_gap = 4;

/// The least translation of B at `offset` that parts it from A at the block's origin, by an expanding polytope (van den
/// Bergen 2001) whose every decision is an exact sign: it stays convex however flat its faces are.
/// Starts from the simplex with which gjk() found the overlap. Cores whose Minkowski difference has no volume (two
/// segments, a point and a triangle, triangles of one plane) have depth 0 across it.
/// Range: gjk() ended with `overlap`. Stack: 4 KB and a little.
Penetration penetration(const Placed& a, const Placed& b, const Vec32& offset, const Simplex& simplex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
