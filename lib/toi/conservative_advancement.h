#pragma once
#include <detent/toi_methods.h>

#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The number of methods that use certified axes (advance.h). They are the first values of ToiMethod.
inline constexpr int k_axis_methods = 6;

/// The method that the library uses. On no kind of query is it much slower than the best method (docs/bench).
#if defined(DETENT_TOI_METHOD)
inline constexpr ToiMethod k_toi_method = ToiMethod::DETENT_TOI_METHOD;
#else
inline constexpr ToiMethod k_toi_method = ToiMethod::constant_angular_velocity;
#endif
static_assert(static_cast<int>(k_toi_method) < k_axis_methods, "of every shape, and never late");

/// Whether the method moves both bodies of a prepared pair in world space (MovingPair::absolute).
constexpr bool moves_both(ToiMethod method, const MovingPair& pair) {
  return method == ToiMethod::world_space && !pair.planar;
}

/// The maximum number of axes of a search. The second limit applies to the methods that exist only for comparison,
/// which need many axes on hard queries.
inline constexpr int k_toi_iterations_max = 24;
inline constexpr int k_toi_iterations_compared_max = 256;

/// Finds the time of impact of a prepared pair by conservative advancement. `method`, one of the first k_axis_methods,
/// decides how the axes are chosen. `enough`, in ulps of the pair's block: the result is clear at once if the distance
/// of the cores is greater than this when the window begins.
void conservative_advancement(const MovingPair& pair, ToiMethod method, TimeOfImpact& result,
                              int32_t enough = INT32_MAX);

/// Does the same as time_of_impact() (toi.h), by one of the first k_axis_methods methods.
Status time_of_impact_on_axes(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                              const Motion& motion_b, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
