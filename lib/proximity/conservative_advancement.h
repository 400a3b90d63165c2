#pragma once
#include "proximity/advance.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// More axes than this are not looked for.
inline constexpr int k_toi_iterations_max = 24;

/// The time of impact of a prepared pair by conservative advancement along axes of the method's kind.
void conservative_advancement(const MovingPair& pair, ToiMethod method, TimeOfImpact& result);

/// time_of_impact() (toi.h) by a method of choice, for comparison.
Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
