#include "toi_methods/redon.h"

#include "toi/screw_motion.h"
#include "toi_methods/feature_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The screw motion of B relative to A, in A's axes.
struct RelativeScrew {
  ScrewMotion screw;
  Matrix32 start;      ///< B's rotation at the start
  int64_t bend_whole;  ///< bound on the distance of the path of a point of B from its chord over the step, 2^-46 m
  int64_t angle;       ///< bound on the relative angular speed, Q30 rad per step
  int64_t rounding;

  PlacedPair at(int64_t time) const {
    const int64_t inverse = screw.inverse_weight_at(time);
    PlacedPair pair = {{{{k_one, 0, 0}, {0, k_one, 0}, {0, 0, k_one}}}, {}, screw.at({0, 0, 0}, time, inverse)};
    for (int i = 0; i < 3; ++i) {
      const Vec64 axis = {start.column[i].x, start.column[i].y, start.column[i].z};
      pair.b.column[i] = round_shift(add(axis, screw.turned(add(axis, axis), time, inverse)), 0);
    }
    return pair;
  }
  int64_t bend(int64_t length) const { return over_time(over_time(bend_whole, length) + 1, length) + 1; }
  int64_t angle_in(int64_t length) const { return over_time(angle, length) + 1; }
  int64_t ball() const { return rounding; }
  template <class Path>
  OpenPart roots(const Path& path, int64_t from, int64_t to) const {
    return screw_roots(path, screw, from, to);
  }
};

Status quaternion_of(const Motion& motion, Quat32 (&ends)[2]) {
  Turning turning;
  if (const Status status = turning_of(motion, turning); status != Status::ok) return status;
  ends[0] = turning.start;
  ends[1] = turning.rotation_at(k_time_end);
  return Status::ok;
}

}  // namespace

Status time_of_impact_by_redon(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                               TimeOfImpact& result) {
  if (!Polytope::is_one(a) || !Polytope::is_one(b)) return Status::bad_argument;
  Quat32 of_a[2], of_b[2];
  if (const Status status = quaternion_of(motion_a, of_a); status != Status::ok) return status;
  if (const Status status = quaternion_of(motion_b, of_b); status != Status::ok) return status;
  Vec64 displacement_a, displacement_b, offset;
  if (!raw_from_real(motion_a.displacement, displacement_a) || !raw_from_real(motion_b.displacement, displacement_b) ||
      !raw_difference(motion_b.start.position, motion_a.start.position, offset) ||
      !in_range(offset, k_screw_range_bits) || !in_range(displacement_a, k_screw_range_bits) ||
      !in_range(displacement_b, k_screw_range_bits) || raw_core_radius(a) >> (k_metre_bits + k_screw_range_bits) != 0 ||
      raw_core_radius(b) >> (k_metre_bits + k_screw_range_bits) != 0) {
    return Status::out_of_range;
  }
  const RelativePose start = relative_pose(of_a[0], of_b[0], offset);
  const RelativePose end = relative_pose(of_a[1], of_b[1], add(offset, add(displacement_b, negate(displacement_a))));
  RelativeScrew motion;
  if (const Status status = screw_between(start, end, motion.screw); status != Status::ok) return status;
  motion.start = matrix_from(start.rotation);
  motion.bend_whole = motion.screw.bend(raw_core_radius(b));
  // The angular speed of the screw is 2 |g| / (1 + t^2 g^2).
  motion.angle = motion.screw.tangent_length() << (1 + 30 - k_tangent_bits);
  motion.rounding = screw_ball(raw_core_radius(b), start, end) + (raw_core_radius(a) >> 26);
  FeaturePairs<RelativeScrew>(a, b, motion).first_contact({0, k_time_end}, result);
  result.normal = {};
  result.point = {};
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
