#pragma once
#include "distance/simplex.h"
#include "distance/support.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// More support points than this are never asked for; 13 is the most that a polytope was seen to need
/// (tests/unit/distance).
inline constexpr int k_gjk_iterations_max = 24;

enum class GjkOutcome {
  apart,    ///< the cores are apart, by at least `lower` and at most `upper`
  overlap,  ///< the cores meet or touch; the simplex holds the origin
  capped,   ///< the iteration cap was met: `lower` and `upper` still hold
};

/// Lengths in ulps of the block.
struct GjkResult {
  GjkOutcome outcome;
  Vec32 normal;    ///< from A to B, Q30, within k_normalise_error of the direction of the nearest point
  int32_t upper;   ///< distance of the witness points, rounded up
  int32_t lower;   ///< no two core points are nearer than this, less k_gjk_slack
  int iterations;  ///< support points asked for
};

/// When to be content with less than the nearest points.
struct GjkLimits {
  int32_t below = -1;         ///< stop once upper <= below
  int32_t above = INT32_MAX;  ///< stop once lower > above
};

/// Where the cores of A at the block's origin and B at `offset` are nearest (Gilbert, Johnson, Keerthi 1988), on the
/// exact simplex. Starts from the core points in `simplex` (may be empty) and leaves the last one there.
GjkResult gjk(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex, const GjkLimits& limits);

/// As gjk(), and where the cap was met again from there: on rims that nearly touch, 24 supports may not do.
GjkResult gjk_on(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex, const GjkLimits& limits);
inline constexpr int k_gjk_rounds_max = 4;

/// The points that the simplex' nearest point is the difference of, in the block, each from its shape's centre.
struct NearestPoints {
  Vec32 on_a, on_b;
};
NearestPoints nearest_points(const Placed& a, const Placed& b, const Simplex& simplex);

/// Ulps of the block by which `lower` may exceed the least distance of the true cores along the normal: placing (1.5
/// sqrt 3 each core), the normal's and the local direction's rounding, and the support's choice. Derived in DESIGN.md.
inline constexpr int k_gjk_slack = 16;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
