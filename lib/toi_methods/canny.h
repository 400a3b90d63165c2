#pragma once
#include <detent/toi.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first contact of two polytopes whose positions and quaternions move in straight lines from the first pose of the
/// motion to the last. The contact is found at a numerical root of the volume that the corners of two features span; it
/// is zero when the features are coplanar. For this motion, the volume is a polynomial of degree five. If the bodies
/// rotate, this motion differs from that of the step. The search also ignores features that are coplanar without
/// crossing, or coplanar at all times. The method can therefore miss contacts or find them late or early. The normal
/// and the point are zero. Errors: bad_argument for a shape that is not a polytope; out_of_range for a body that
/// rotates by more than pi; other errors as time_of_impact(). Source: J. Canny, "Collision detection for moving
/// polyhedra", IEEE Transactions on Pattern Analysis and Machine Intelligence 8(2), 1986.
Status time_of_impact_by_canny(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                               TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
