#pragma once
#include <detent/detail/state.h>
#include <detent/fraction.h>

#include "math/arithmetic.h"
#include "math/rotation.h"

/// The motion of a body in a step, defined once: constant velocity and constant world spin from the start pose.
/// Where the substeps end is only what chooses the sweep; intermediate and final poses are read from the sweep, so that
/// whatever was certified about it is what happens.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A place `way` from another; beyond the end of the world it is held there.
inline Position moved(const Position& from, const Vec3<Real>& way) {
  bool beyond = false;
  return {coord_advance(from.x, way.x, beyond), coord_advance(from.y, way.y, beyond),
          coord_advance(from.z, way.z, beyond)};
}

struct Sweep {
  Vec3<Real> displacement;  ///< of the centre of mass over the step, m
  Vec3<Real> turn;          ///< rotation vector over the step, world, rad
};

/// The sweep that starts at `start` and ends at rotation `end` after moving by `displacement`. `turn_estimate`, rad,
/// names the number of whole turns: the rotation vector nearest to it that leads to `end` is taken.
Sweep sweep_between(const Quat& start, const Quat& end, const Vec3<Real>& displacement,
                    const Vec3<Real>& turn_estimate);

/// Rotation at the end of the sweep from `start`. Error (fixed): 2^-28 in each component, and of unit length within
/// 2^-29.
Quat sweep_end_rotation(const Quat& start, const Sweep& sweep);

/// Moves a position to the end of the sweep: rounded to nearest; fx32 carries what the rounding leaves.
/// Returns the number of components that were clamped to Coord's range.
uint32_t sweep_end_position(BodyPose& pose, const Sweep& sweep);

/// What of the motion falls on a part of the step. Of the whole step it is the sweep itself, bit for bit.
/// Rounding: to nearest.
Sweep sweep_part(const Sweep& sweep, Fraction part);

/// Moves a pose along the sweep for a part of the step: where time_of_impact() has the body then, but for the rounding
/// of a pose. Returns the number of components that were clamped to Coord's range.
uint32_t advance_along(const Sweep& sweep, Fraction part, BodyPose& pose);

/// a b, rounded down. Range: in [0, 1].
Fraction fraction_product(Fraction a, Fraction b);
inline constexpr Fraction k_whole_step = 1.0;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
