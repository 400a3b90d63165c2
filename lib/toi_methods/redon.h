#pragma once
#include <detent/toi.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first contact of two polytopes if B moves in A's frame by the screw motion from its first pose to its last. Of
/// the two possible screw motions, the one with the smaller rotation angle is used. The result is certified for the
/// screw motion. If the step's own motion differs from the screw motion, the result may be late or early for the step's
/// motion. The normal and the point are zero. Errors: bad_argument for a shape that is not a polytope; out_of_range for
/// a relative rotation of more than 2.65 rad, for an initial offset or a displacement of more than 2^10 m in a
/// component, and for a core radius of 2^10 m or more; other errors as time_of_impact(). Source: S. Redon, A. Kheddar,
/// S. Coquillart, "An algebraic solution to the problem of collision detection for rigid polyhedral objects", ICRA
/// 2000.
Status time_of_impact_by_redon(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                               TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
