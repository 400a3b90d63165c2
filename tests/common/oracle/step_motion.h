#pragma once
#include <detent/numbers.h>

#include "shape/sweep.h"
#include "tests/common/oracle/motions.h"

/// The motion of a step, as the library has it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Where the library has a body at `time` that does a sweep by `poses`; far off if a number is out of range.
inline detent_oracle::Placed step_motion_at(const detent_oracle::PosesOfStep& poses, double time) {
  const detent_oracle::Vector &p = poses.start.position, &displacement = poses.displacement,
                              &rotation_vector = poses.rotation_vector;
  const detent_oracle::Quaternion q = normalised(poses.start.rotation);
  BodyPose pose{};
  Sweep sweep{};
  const Status statuses[] = {
      coord_from_host(p[0], pose.position.x),
      coord_from_host(p[1], pose.position.y),
      coord_from_host(p[2], pose.position.z),
      unit_from_host(q.x, pose.rotation.x),
      unit_from_host(q.y, pose.rotation.y),
      unit_from_host(q.z, pose.rotation.z),
      unit_from_host(q.w, pose.rotation.w),
      real_from_host(displacement[0], sweep.displacement.x),
      real_from_host(displacement[1], sweep.displacement.y),
      real_from_host(displacement[2], sweep.displacement.z),
      real_from_host(rotation_vector[0], sweep.rotation_vector.x),
      real_from_host(rotation_vector[1], sweep.rotation_vector.y),
      real_from_host(rotation_vector[2], sweep.rotation_vector.z),
  };
  bool good = advance_along(sweep, Fraction::from_raw(static_cast<int64_t>(ldexp(time, Fraction::k_frac))), pose) == 0;
  for (const Status status : statuses) good = good && status == Status::ok;
  const Position& at = pose.position;
  const Quat& r = pose.rotation;
  return {good ? detent_oracle::Vector{{coord_to_host(at.x), coord_to_host(at.y), coord_to_host(at.z)}}
               : detent_oracle::Vector{{1e9, 1e9, 1e9}},
          {unit_to_host(r.x), unit_to_host(r.y), unit_to_host(r.z), unit_to_host(r.w)}};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
