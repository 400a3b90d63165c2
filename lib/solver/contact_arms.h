#pragma once
#include "solver/contact_rows.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Moves the arms to the middle of a contact's points to where they are after `time`, s, if the bodies go on moving as
/// they do now. `arm_a` and `arm_b`: from the centres of mass of A and B, world axes, each in the unit of its body.
/// `normal`: from A to B. Returns the angle, rad, by which the points rotate about the normal.
///
/// The points follow the surface of the dynamic body. Only rotation about the normal moves its arm. A body that rotates
/// more about other axes rolls or tips, and will probably touch with another part of its surface; such rotation moves
/// no arm. Cylinders and cones may roll: the plane of their axis and the normal rotates. The arm of a kinematic body
/// leads to the points of the dynamic body, which may slide over it. Between two dynamic bodies no arm moves: both arms
/// must end at one point, so that an impulse does not change their common angular momentum.
///
/// Range: the points rotate by at most k_arm_rotation_max; arm_of_offset() limits the arms.
Unit advance_arms(const RowBody& a, const RowBody& b, const Vec3<Unit>& normal, Real time, Vec3<Unit>& arm_a,
                  Vec3<Unit>& arm_b);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
