#pragma once
#include <detent/toi.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first contact of two polytopes if B moves in A's frame in the screw that leads from the first pose of the motion
/// to the last, the shorter way round: certain for that motion, and so late or early for the step's own where that is
/// another. The normal and the point are left out. Errors: bad_argument for a shape that is no polytope; out_of_range
/// for a relative turn of more than 2.65 rad, and positions 2^10 m apart in a component; as time_of_impact(). Source:
/// S. Redon, A. Kheddar, S. Coquillart, "An algebraic solution to the problem of collision detection for rigid
/// polyhedral objects", ICRA 2000.
Status time_of_impact_by_redon(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                               TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
