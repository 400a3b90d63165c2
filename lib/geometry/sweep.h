#pragma once
#include <detent/detail/state.h>

#include "math/rotation.h"

/// The motion of a body in a step, defined once: constant velocity and constant world spin from the start pose.
/// Where the substeps end is only what chooses the sweep; intermediate and final poses are read from the sweep, so that
/// whatever was certified about it is what happens.
namespace detent {
inline namespace DETENT_NAMESPACE {

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

}  // namespace DETENT_NAMESPACE
}  // namespace detent
