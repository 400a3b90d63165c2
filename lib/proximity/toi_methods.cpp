#include "proximity/toi_methods.h"

#include "proximity/canny.h"
#include "proximity/conservative_advancement.h"
#include "proximity/feature_pairs.h"
#include "proximity/redon.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Status time_of_impact_by(ToiMethod method, const Convex& a, const Motion& motion_a, const Convex& b,
                         const Motion& motion_b, TimeOfImpact& result) {
  switch (method) {
    case ToiMethod::paper:
    case ToiMethod::first_order:
    case ToiMethod::second_order:
    case ToiMethod::corotating:
    case ToiMethod::world_space:
    case ToiMethod::constant_spin:
      return time_of_impact_on_axes(method, a, motion_a, b, motion_b, result);
    case ToiMethod::feature_pairs:
      return time_of_impact_by_features(a, motion_a, b, motion_b, result);
    case ToiMethod::canny:
      return time_of_impact_by_canny(a, motion_a, b, motion_b, result);
    case ToiMethod::redon:
      return time_of_impact_by_redon(a, motion_a, b, motion_b, result);
    case ToiMethod::mirtich:
    case ToiMethod::baraff:
    default:
      return Status::bad_argument;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
