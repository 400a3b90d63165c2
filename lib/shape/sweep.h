#pragma once
#include <detent/detail/state.h>
#include <detent/numbers.h>

#include "math/arithmetic.h"
#include "math/rotation.h"

/// The motion of a body in a step: constant velocity and constant angular velocity in world axes from the start pose.
/// Only this file defines it. The substeps only determine the sweep. Intermediate and final poses are computed from the
/// sweep, so what is proved for the sweep holds for the simulated motion.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// `from` translated by `displacement`, clamped to Coord's range.
inline Position moved(const Position& from, const Vec3<Real>& displacement) {
  bool beyond = false;
  return {coord_advance(from.x, displacement.x, beyond), coord_advance(from.y, displacement.y, beyond),
          coord_advance(from.z, displacement.z, beyond)};
}

struct Sweep {
  Vec3<Real> displacement;     ///< displacement of the centre of mass over the step, m
  Vec3<Real> rotation_vector;  ///< rotation vector of the whole step, world axes, rad
};

/// The sweep that starts at `start` and ends at rotation `end` after moving by `displacement`. Several rotation vectors
/// lead to `end`; they differ by full revolutions. The sweep gets the one nearest to `angle_estimate` (rotation vector,
/// rad).
Sweep sweep_between(const Quat& start, const Quat& end, const Vec3<Real>& displacement,
                    const Vec3<Real>& angle_estimate);

/// Rotation at the end of the sweep from `start`. Error in fixed point: 2^-28 in each component. The result has unit
/// length within 2^-29.
Quat sweep_end_rotation(const Quat& start, const Sweep& sweep);

/// Moves a position to the end of the sweep, rounded to nearest. In fx32 the pose keeps the remainder of the rounding.
/// Returns the number of components that were clamped to Coord's range.
uint32_t sweep_end_position(BodyPose& pose, const Sweep& sweep);

/// `whole` times `part`, rounded to nearest.
Real part_of(Real whole, Fraction part);
Vec3<Real> part_of(const Vec3<Real>& whole, Fraction part);

/// The part of the sweep up to the fraction `part` of the step, rounded to nearest. For the whole step, this is the
/// sweep itself, bit for bit.
Sweep sweep_part(const Sweep& sweep, Fraction part);

/// Moves a pose along the sweep up to the fraction `part` of the step. At the same fraction, time_of_impact() uses this
/// pose, except for the rounding of the pose. Returns the number of components that were clamped to Coord's range.
uint32_t advance_along(const Sweep& sweep, Fraction part, BodyPose& pose);

/// a b, rounded down. Range: a and b in [0, 1].
Fraction fraction_product(Fraction a, Fraction b);
inline constexpr Fraction k_whole_step = 1.0;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
