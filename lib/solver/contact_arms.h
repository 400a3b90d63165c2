#pragma once
#include "solver/contact_rows.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Updates the arms of a contact to those after `time`, s, if the bodies keep their current velocities. `arm_a` and
/// `arm_b`: from the centres of mass of A and B to the middle of the contact's points, world axes, each in the unit of
/// its body. `normal`: from A to B. Returns the angle, rad, by which the points rotate about the normal.
///
/// The points follow the surface of the dynamic body. Only rotation about the normal moves its arm. If a body rotates
/// more about other axes, it rolls or tips, and will probably touch with another part of its surface; its arm does not
/// move. Cylinders and cones may roll: their points rotate with the plane of their axis and the normal. The arm of a
/// kinematic body leads to the points of the dynamic body, which may slide over it. Between two dynamic bodies no arm
/// moves: both arms must end at one point, so that an impulse does not change their common angular momentum.
///
/// Overflow: clamps the rotation of the points to k_arm_rotation_max, and the arm of a kinematic body as
/// arm_of_offset() does.
Unit advance_arms(const RowBody& a, const RowBody& b, const Vec3<Unit>& normal, Real time, Vec3<Unit>& arm_a,
                  Vec3<Unit>& arm_b);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
