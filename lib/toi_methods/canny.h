#pragma once
#include <detent/toi.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first contact of two polytopes if their positions and their quaternions go from the first pose of the motion to
/// the last in straight lines, by the numerical roots of their features' coplanarity, which is then a polynomial of
/// degree five. That motion is another than the step's where bodies turn, and what is coplanar without crossing, or all
/// the time, is passed: so contacts may be missed, and found late or early. The normal and the point are left out.
/// Errors: bad_argument for a shape that is no polytope; out_of_range for a body that turns by more than pi; as
/// time_of_impact(). Source: J. Canny, "Collision detection for moving polyhedra", IEEE Transactions on Pattern
/// Analysis and Machine Intelligence 8(2), 1986.
Status time_of_impact_by_canny(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                               TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
