#include "examples/ragdoll/ragdoll.h"

#include <detent/numbers.h>

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace ragdoll {
namespace {

constexpr Quat k_upright = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)};
constexpr Quat k_along_x = {Unit(0.0), Unit(0.0), Unit(-0.70710678118), Unit(0.70710678118)};  ///< y to x
constexpr Quat k_x_is_up = {Unit(0.5), Unit(0.5), Unit(0.5), Unit(0.5)};                       ///< x to y, y to z
constexpr uint32_t k_middle = 0;

struct Part {
  Shape shape;
  Vec3<Real> place;  ///< from the point between the feet, m
  Quat rotation;
};

constexpr Vec3<Real> at(Real x, Real y) { return {x, y, Real(0.0)}; }
constexpr Part trunk(const Vec3<Real>& half_extents, Real y) {
  return {box(half_extents), at(Real(0.0), y), k_upright};
}
constexpr Part limb(Real radius, Real half_length, Real x, Real y, const Quat& rotation) {
  return {capsule(radius, half_length), at(x, y), rotation};
}

constexpr Part k_part_table[k_parts] = {
    trunk({0.17, 0.1, 0.1}, 1.0),            // 0 hips
    trunk({0.18, 0.18, 0.11}, 1.3),          // 1 chest
    limb(0.1, 0.03, 0.0, 1.67, k_upright),   // 2 head
    limb(0.05, 0.1, 0.35, 1.42, k_along_x),  // 3 left arm
    limb(0.045, 0.105, 0.65, 1.42, k_along_x),
    limb(0.05, 0.1, -0.35, 1.42, k_along_x),  // 5 right arm
    limb(0.045, 0.105, -0.65, 1.42, k_along_x),
    limb(0.07, 0.16, 0.11, 0.69, k_upright),  // 7 left leg
    limb(0.06, 0.17, 0.11, 0.23, k_upright),
    limb(0.07, 0.16, -0.11, 0.69, k_upright),  // 9 right leg
    limb(0.06, 0.17, -0.11, 0.23, k_upright),
};

struct Link {
  JointType type;
  uint32_t a, b;  ///< parts
  Vec3<Real> place;
  Quat frame;
  Real lower, upper;  ///< rad: the bend of a hinge, the twist of the others
  Real cone;          ///< rad
};

constexpr Link socket(uint32_t a, uint32_t b, Real x, Real y, const Quat& frame, Real twist, Real cone) {
  return {JointType::cone_twist, a, b, at(x, y), frame, -twist, twist, cone};
}
constexpr Link bend(uint32_t a, uint32_t b, Real x, Real y, const Quat& frame, Real lower, Real upper) {
  return {JointType::hinge, a, b, at(x, y), frame, lower, upper, Real(0.0)};
}

constexpr Link k_link_table[k_joints] = {
    socket(0, 1, 0.0, 1.11, k_x_is_up, 0.4, 0.5),  // spine
    socket(1, 2, 0.0, 1.51, k_x_is_up, 0.8, 0.7),  // neck
    socket(1, 3, 0.2, 1.42, k_upright, 0.8, 1.4),  // shoulders
    bend(3, 4, 0.5, 1.42, k_x_is_up, -2.4, 0.0),   // elbows
    socket(1, 5, -0.2, 1.42, k_upright, 0.8, 1.4),  bend(5, 6, -0.5, 1.42, k_x_is_up, 0.0, 2.4),
    socket(0, 7, 0.11, 0.92, k_x_is_up, 0.4, 1.0),  // hips
    bend(7, 8, 0.11, 0.46, k_upright, 0.0, 2.4),    // knees
    socket(0, 9, -0.11, 0.92, k_x_is_up, 0.4, 1.0), bend(9, 10, -0.11, 0.46, k_upright, 0.0, 2.4),
};

}  // namespace

Status make(World& world, const Position& feet, Ragdoll& ragdoll) {
  const Pose ground = {feet, k_upright};
  for (uint32_t i = 0; i < k_parts; ++i) {
    BodyDef part;
    part.shape = k_part_table[i].shape;
    part.position = to_world(ground, k_part_table[i].place);
    part.rotation = k_part_table[i].rotation;
    if (const Status status = create_body(world, part, ragdoll.part[i]); status != Status::ok) return status;
  }
  for (uint32_t i = 0; i < k_joints; ++i) {
    const Link& link = k_link_table[i];
    JointDef joint;
    joint.type = link.type;
    joint.a = ragdoll.part[link.a];
    joint.b = ragdoll.part[link.b];
    joint.axis.limited = true;
    joint.axis.lower = link.lower;
    joint.axis.upper = link.upper;
    joint.second.limited = link.type == JointType::cone_twist;
    joint.second.upper = link.cone;
    Status status = place_joint(world, to_world(ground, link.place), link.frame, joint);
    if (status == Status::ok) status = create_joint(world, joint, ragdoll.joint[i]);
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

Status throw_figure(World& world, const Ragdoll& ragdoll, const Vec3<Real>& rotation_vector,
                    const Vec3<Real>& linear_velocity) {
  Pose middle;
  if (const Status status = get_pose(world, ragdoll.part[k_middle], middle); status != Status::ok) return status;
  const Pose before = {middle.position, k_upright}, after = {middle.position, rotated_by(k_upright, rotation_vector)};
  for (const BodyId part : ragdoll.part) {
    Pose pose;
    Status status = get_pose(world, part, pose);
    const Vec3<Real> arm = vector_to_world(after.rotation, to_local(before, pose.position));
    if (status == Status::ok)
      status = set_pose(world, part, to_world(before, arm), rotated_by(pose.rotation, rotation_vector));
    if (status == Status::ok) status = set_velocity(world, part, linear_velocity, {Real(0.0), Real(0.0), Real(0.0)});
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

}  // namespace ragdoll
}  // namespace DETENT_NAMESPACE
}  // namespace detent
