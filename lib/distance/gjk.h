#pragma once
#include "distance/simplex.h"
#include "distance/support.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Iteration cap: gjk() evaluates at most this many support points. The tests (tests/unit/distance) need at most 13 for
/// polytopes.
inline constexpr int k_gjk_iterations_max = 24;

enum class GjkOutcome {
  /// The cores are separate, or the search stopped at GjkLimits::below. `lower` and `upper` bound their distance.
  apart,
  overlap,  ///< the cores overlap or touch; the simplex contains the origin
  capped,   ///< the iteration cap was reached; `lower` and `upper` are still valid bounds
};

/// The result of gjk(). Lengths are in ulps: 2^-30 of the pair's unit of length (support.h).
struct GjkResult {
  GjkOutcome outcome;
  Vec32 normal;    ///< unit vector from A to B, Q30; each component errs by at most k_normalise_error
  int32_t upper;   ///< distance of the witness points, rounded up
  int32_t lower;   ///< no point of A's core is nearer to a point of B's core than lower - k_gjk_slack
  int iterations;  ///< number of support points evaluated
};

/// Bounds at which gjk() stops early, before it has found the nearest points.
struct GjkLimits {
  int32_t below = -1;         ///< stop once upper <= below
  int32_t above = INT32_MAX;  ///< stop once lower > above
};

/// Finds where the cores of A (centre at the origin) and B (centre at `offset`) are nearest (Gilbert, Johnson, Keerthi
/// 1988). The decisions of the simplex are exact (simplex.h). The search starts from the core points in `simplex`,
/// which may be empty. On return, `simplex` is the last simplex.
GjkResult gjk(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex, const GjkLimits& limits);

/// As gjk(), but a capped search continues from its last simplex, up to k_gjk_rounds_max rounds in all. Two rims that
/// nearly touch may need more than 24 support points.
GjkResult gjk_on(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex, const GjkLimits& limits);
inline constexpr int k_gjk_rounds_max = 4;

/// The witness points (the nearest points of the two cores), each relative to the centre of its shape, in ulps. offset
/// + on_b - on_a is the simplex's point nearest to the origin.
struct NearestPoints {
  Vec32 on_a, on_b;
};
NearestPoints nearest_points(const Placed& a, const Placed& b, const Simplex& simplex);

/// The number of ulps (2^-30 of the pair's unit of length) by which GjkResult::lower may exceed the least distance of
/// the true cores along the normal. The sources of this error: the rounding of rotated points (1.5 sqrt 3 for each
/// core, k_placing_error), the rounding of the normal and of the local direction, and the choice of the support point.
/// Derived in docs/design/time_of_impact.md, "A known axis replaces the search".
inline constexpr int k_gjk_slack = 16;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
