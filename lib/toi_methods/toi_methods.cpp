#include <detent/toi_methods.h>

#include "toi/conservative_advancement.h"
#include "toi_methods/ballistic.h"
#include "toi_methods/canny.h"
#include "toi_methods/feature_pairs.h"
#include "toi_methods/redon.h"
#include "toi_methods/witness_axis.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The time of impact by a method that takes a prepared pair.
template <void (*method)(const MovingPair&, TimeOfImpact&)>
Status time_of_impact_of(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                         TimeOfImpact& result) {
  MovingPair pair;
  if (const Status status = prepare(a, motion_a, b, motion_b, pair); status != Status::ok) return status;
  method(pair, result);
  return Status::ok;
}

}  // namespace

Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result) {
  switch (method) {
    case ToiMethod::paper:
    case ToiMethod::first_order:
    case ToiMethod::second_order:
    case ToiMethod::corotating:
    case ToiMethod::world_space:
    case ToiMethod::constant_angular_velocity:
      return time_of_impact_on_axes(method, a, motion_a, b, motion_b, result);
    case ToiMethod::mirtich:
      return time_of_impact_of<ballistic_advancement>(a, motion_a, b, motion_b, result);
    case ToiMethod::baraff:
      return time_of_impact_of<witness_axes>(a, motion_a, b, motion_b, result);
    case ToiMethod::feature_pairs:
      return time_of_impact_by_features(a, motion_a, b, motion_b, result);
    case ToiMethod::redon:
      return time_of_impact_by_redon(a, motion_a, b, motion_b, result);
    case ToiMethod::canny:
      return time_of_impact_by_canny(a, motion_a, b, motion_b, result);
    default:
      return Status::bad_argument;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
