#pragma once
#include <detent/numbers.h>
#include <detent/world.h>
#include <math.h>

/// The error of a joint, m: the distance between the anchors of A and B, without the part along a sliding axis. Not
/// valid for `distance` joints.
inline double joint_error(const detent::World& world, detent::JointId id) {
  using namespace detent;
  JointDef joint;
  Pose a, b;
  if (get_joint(world, id, joint) != Status::ok || get_pose(world, joint.a, a) != Status::ok ||
      get_pose(world, joint.b, b) != Status::ok)
    return INFINITY;
  const Pose anchor_a = {to_world(a, joint.anchor_a), a.rotation};
  const Vec3<Real> gap = vector_to_local(joint.frame_a, to_local(anchor_a, to_world(b, joint.anchor_b)));
  const bool slides = joint.type == JointType::slider || joint.type == JointType::wheel;
  return hypot(slides ? 0 : real_to_host(gap.x), hypot(real_to_host(gap.y), real_to_host(gap.z)));
}
