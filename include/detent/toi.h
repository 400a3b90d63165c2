#pragma once
#include <detent/distance.h>
#include <detent/numbers.h>

/// @file
/// Time of impact of two convex shapes that translate and rotate. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The motion of a body in a step, at constant velocity and constant angular velocity, world axes.
struct Motion {
  Pose start = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};  ///< pose at the beginning of the step
  Vec3<Real> displacement = {};     ///< displacement in the whole step, m; each component within 2^14
  Vec3<Real> rotation_vector = {};  ///< rotation in the whole step, rad; length at most 2^16
};

/// Whether two moving shapes collide in a step.
enum class ToiOutcome : uint32_t {
  clear = 1,      ///< the shapes do not touch during the step
  hit = 2,        ///< at `time` the distance of the shapes is at most the tolerance
  undecided = 3,  ///< an iteration cap was reached; the shapes do not touch before `time`
};

/// When and where two moving shapes collide.
struct TimeOfImpact {
  ToiOutcome outcome = ToiOutcome::undecided;  ///< whether the shapes collide
  /// The time as a fraction of the step. Before it the shapes do not touch, unless they touch at the start. 1 if the
  /// outcome is `clear`.
  Fraction time = 0.0;
  Vec3<Unit> normal = {};  ///< normal at `time`, from A to B, world axes; zero if the cores (Convex) touch at the start
  Vec3<Real> point = {};   ///< of a hit: the point on A's surface, m, from A's position at `time`, world axes
  uint32_t gjk_calls = 0;  ///< number of GJK calls; a last call that confirms the hit in one iteration does not count
  uint32_t passes = 0;     ///< number of time intervals tested
};

/// The largest gap at the time of a hit, as a fraction of the larger core diameter. A core is a shape without the ball
/// that rounds it (Convex). The gap can exceed this limit by the rounding errors in SPEC.md.
inline constexpr double k_toi_tolerance = 1e-6;

/// Computes when the distance of two moving shapes first is within the tolerance.
/// Tolerance: k_toi_tolerance times the larger core diameter, plus the rounding errors in SPEC.md. Errors:
/// not_normalised; bad_argument for two half-spaces; out_of_range. Positions that are 2^16 m or more apart in a
/// component are out of range if one shape is a half-space, or if the bounding spheres might touch.
Status time_of_impact(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                      TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
