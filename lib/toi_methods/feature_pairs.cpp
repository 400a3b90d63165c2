#include "toi_methods/feature_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Status time_of_impact_by_features(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                                  TimeOfImpact& result) {
  if (!Polytope::is_one(a) || !Polytope::is_one(b)) return Status::bad_argument;
  MovingPair pair;
  if (const Status status = prepare(a, motion_a, b, motion_b, pair); status != Status::ok) return status;
  const SteadyMotion motion = {{{raw_core_radius(a), pair.turning_a.angle}, {raw_core_radius(b), pair.turning_b.angle}},
                               pair.turning_a,
                               pair.turning_b,
                               pair.offset,
                               pair.displacement};
  FeaturePairs<SteadyMotion>(a, b, motion).first_contact({pair.from, pair.to}, result);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
