#pragma once
#include <detent/convex.h>
#include <detent/fraction.h>

/// @file
/// Time of impact of two convex shapes that move and turn. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A motion over a step: constant velocity of the position and constant spin, world axes.
struct Motion {
  Pose start = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};  ///< at the beginning of the step
  Vec3<Real> displacement = {};                          ///< m over the step; each component within 2^14
  Vec3<Real> turn = {};                                  ///< rotation vector over the step, rad; |turn| <= 2^16
};

/// What is known of a step.
enum class ToiOutcome : uint32_t {
  clear = 1,      ///< the shapes do not meet during the step
  hit = 2,        ///< at `time` they are at most the tolerance apart
  undecided = 3,  ///< a cap was met; up to `time` they do not meet
};

/// When and where two moving shapes meet.
struct TimeOfImpact {
  ToiOutcome outcome = ToiOutcome::undecided;  ///< whether they do
  Fraction time = 0.0;     ///< never late: up to here the shapes do not meet, unless they did at the start; 1 if clear
  Vec3<Unit> normal = {};  ///< at `time`, from A to B, world axes; zero where the cores meet at the start
  Vec3<Real> point = {};   ///< of a hit, on A's surface, m, from A's position at `time`, world axes
  uint32_t gjk_calls = 0;  ///< not counting one that a single support point was enough for, to confirm the hit
  uint32_t passes = 0;     ///< intervals of time tried
};

/// A hit is at most this part of the larger core diameter early in gap, beside the ulps stated in SPEC.md.
inline constexpr double k_toi_tolerance = 1e-6;

/// When two moving shapes first come within the tolerance.
/// Tolerance: k_toi_tolerance of the larger core diameter, and the ulps stated in SPEC.md.
/// Errors: not_normalised; out_of_range, also for positions 2^16 m apart if the bounding spheres might meet, and always
/// so far from a half-space's; bad_argument for two half-spaces.
Status time_of_impact(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                      TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
