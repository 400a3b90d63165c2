#include "toi/conservative_advancement.h"

#include "toi/axis_by_axis.h"
#include "toi/features.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Vec32 k_no_angular_velocity = {0, 0, 0};

/// The number of axes that the search takes from GJK before it predicts an axis.
constexpr int k_plain_iterations = 1;

/// The time up to which the axis of `nearest`, or an axis predicted from the nearest features, certifies the
/// separation.
int64_t next_time(const MovingPair& pair, ToiMethod method, const Frames& frames, const Simplex& simplex,
                  const GjkResult& nearest, int iteration, int32_t floor, int64_t& progress, TimeOfImpact& result) {
  const int64_t time = frames.time;
  const NearFeatures features(simplex);
  const bool turns = pair.turning_a.turns || pair.turning_b.turns;
  if (method >= ToiMethod::world_space && turns && !features.has_face() && !pair.planar &&
      iteration >= k_plain_iterations) {
    return advance_tracking(pair, frames, simplex, features, nearest, floor, progress, result);
  }
  const Horizon horizon = horizon_from(pair, time, pair.to - time, k_horizon_quarters);
  if (pair.planar) {  // only the plane's normal can separate the shapes
    const Vec32& plane =
        pair.a->type == ShapeType::half_space ? horizon.angular_velocity_a : horizon.angular_velocity_b;
    return advance_on(pair, frames, horizon, nearest.normal, plane, floor, result.passes);
  }
  Vec32 angular_velocity = k_no_angular_velocity;
  switch (method) {
    case ToiMethod::paper:
    case ToiMethod::first_order:
      return horizon.time_at(
          advance_once(pair, frames, horizon, nearest.normal, method == ToiMethod::first_order, floor, result.passes));
    case ToiMethod::second_order:
      break;
    default:  // the axis rotates with a body
      angular_velocity = features.base_angular_velocity(horizon);
      break;
  }
  return advance_on(pair, frames, horizon, nearest.normal, angular_velocity, floor, result.passes);
}

}  // namespace

void conservative_advancement(const MovingPair& pair, ToiMethod method, TimeOfImpact& result, int32_t enough) {
  int64_t progress = k_time_end;  // time gained by the last predicted axis
  const int iterations_max = method >= ToiMethod::world_space ? k_toi_iterations_max : k_toi_iterations_compared_max;
  advance_by_axes(
      pair, iterations_max, enough, result,
      [&](const Frames& frames, const Simplex& simplex, const GjkResult& nearest, int iteration, int32_t floor) {
        return next_time(pair, method, frames, simplex, nearest, iteration, floor, progress, result);
      });
}

Status time_of_impact_on_axes(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                              const Motion& motion_b, TimeOfImpact& result) {
  MovingPair pair;
  if (const Status status = prepare(a, motion_a, b, motion_b, pair); status != Status::ok) return status;
  pair.absolute = moves_both(method, pair);
  conservative_advancement(pair, method, result);
  return Status::ok;
}

Status time_of_impact(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                      TimeOfImpact& result) {
  return time_of_impact_on_axes(k_toi_method, a, motion_a, b, motion_b, result);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
