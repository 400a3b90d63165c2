#include "state/joint_state.h"

#include "joint/joint.h"
#include "math/rotation.h"
#include "state/ranges.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Limit of the lengths of a joint (limits, targets), m, and of the elements of JointState::impulse, m/s.
constexpr Real k_axis_max = 16384.0;
constexpr Real k_angle_max = 3.14159265358979323846;
constexpr Real k_frequency_min = 0x1p-10;
constexpr Real k_frequency_max = 1024.0;
constexpr Real k_damping_ratio_max = 64.0;
constexpr Real k_joint_speed_max = 1024.0;
constexpr Scaled k_force_max = 0x1p60;

bool is_axis(const JointState& joint, int i) {
  const JointType type = static_cast<JointType>(joint.type);
  // Values that have no meaning for the type of joint are checked too: as lengths on the first axis, as angles on the
  // second.
  const bool angle = i == 1 || (free_motion_count(type) != 0 && is_angular(type, i));
  const Real most = angle ? k_angle_max : k_axis_max;
  const bool frequency = joint.frequency[i] == k_zero || within(joint.frequency[i], k_frequency_min, k_frequency_max);
  return joint.limited[i] <= 1 && within(joint.lower[i], -most, most) && within(joint.upper[i], -most, most) &&
         joint.lower[i] <= joint.upper[i] && frequency && within(joint.damping_ratio[i], k_zero, k_damping_ratio_max) &&
         within(joint.target[i], -most, most) && within(joint.speed[i], -k_joint_speed_max, k_joint_speed_max) &&
         is_between(joint.force_max[i], Scaled(0.0), k_force_max);
}

}  // namespace

bool is_joint_type(JointType type) { return type >= JointType::ball && type <= k_joint_type_last; }

bool is_joint(const JointState& joint) {
  return is_joint_type(static_cast<JointType>(joint.type)) && joint.collide <= 1 &&
         within(joint.anchor_a, k_anchor_max) && within(joint.anchor_b, k_anchor_max) && is_axis(joint, 0) &&
         is_axis(joint, 1) && is_between(joint.friction[0], Scaled(0.0), k_force_max) &&
         is_between(joint.friction[1], Scaled(0.0), k_force_max) &&
         is_between(joint.break_force, Scaled(0.0), k_force_max) &&
         is_between(joint.break_torque, Scaled(0.0), k_force_max);
}

bool are_joints(const StateView<const uint8_t>& state) {
  uint32_t count = 0, used = 0;
  for (uint32_t slot = 0; slot < state.joints.count; ++slot) {
    const JointState& joint = state.joints[slot];
    if (joint.generation != 0) used = slot + 1;
    if (joint.type == 0) {
      JointState rest = joint;
      rest.generation = 0;
      if (!is_zero(rest)) return false;
      continue;
    }
    ++count;
    if (joint.generation == 0 || joint.body_a == joint.body_b || joint.body_a >= state.properties.count ||
        joint.body_b >= state.properties.count)
      return false;
    const BodyProperties &a = state.properties[joint.body_a], &b = state.properties[joint.body_b];
    Quat ignored;
    if (a.type == 0 || b.type == 0 || !normalise_input(joint.frame_a, ignored) ||
        !normalise_input(joint.frame_b, ignored) || !is_joint(joint) || !is_number(joint.force) ||
        !is_number(joint.torque))
      return false;
    for (const Real impulse : joint.impulse) {
      if (!within(impulse, -k_axis_max, k_axis_max)) return false;
    }
  }
  return count == state.world.joint_count && used == state.world.joints_used;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
