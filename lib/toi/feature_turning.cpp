#include "toi/feature_path.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
Status feature_toi(FeatureKind kind, const Vec3<Real> (&corner)[4], const Motion& motion_a, const Motion& motion_b,
                   FeatureToi& result) {
  if (!is_kind(kind)) return Status::bad_argument;
  SteadyMotion motion;
  if (const Status status = turning_of(motion_a, motion.turning_a); status != Status::ok) return status;
  if (const Status status = turning_of(motion_b, motion.turning_b); status != Status::ok) return status;
  Vec64 raw[4], displacement_a, displacement_b;
  if (!raw_corners(corner, k_range_bits, raw) || !raw_from_real(motion_a.displacement, displacement_a) ||
      !raw_from_real(motion_b.displacement, displacement_b) || !in_range(displacement_a, k_range_bits) ||
      !in_range(displacement_b, k_range_bits) ||
      !raw_difference(motion_b.start.position, motion_a.start.position, motion.offset) ||
      !in_range(motion.offset, k_range_bits)) {
    return Status::out_of_range;
  }
  motion.displacement = add(displacement_b, negate(displacement_a));
  const int split = first_of_b(kind);
  motion.bound_a = {radius_of(raw, split), motion.turning_a.angle};
  motion.bound_b = {radius_of(raw + split, 4 - split), motion.turning_b.angle};
  const FeaturePath<SteadyMotion> path = {
      motion,       {0, k_time_end, motion.at(0), motion.at(k_time_end)}, kind, false, {raw[0], raw[1], raw[2], raw[3]},
      motion.ball()};
  search(path, near_gap(size_of(kind, raw), path.ball), result);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
