#include "world/joints.h"

#include "base/float_environment.h"
#include "base/heap.h"
#include "broad_phase/pair_key.h"
#include "math/root.h"
#include "math/rotation.h"
#include "state/joint_state.h"
#include "state/ranges.h"
#include "state/slots.h"
#include "world/body_change.h"
#include "world/events.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void set_axis(const JointAxis& axis, int i, JointState& joint) {
  joint.limited[i] = axis.limited ? 1 : 0;
  joint.lower[i] = axis.lower;
  joint.upper[i] = axis.upper;
  joint.frequency[i] = axis.frequency;
  joint.damping_ratio[i] = axis.damping_ratio;
  joint.target[i] = axis.target;
  joint.speed[i] = axis.speed;
  joint.force_max[i] = axis.force_max;
}

JointAxis axis_of(const JointState& joint, int i) {
  return {joint.limited[i] != 0,  joint.lower[i],  joint.upper[i], joint.frequency[i],
          joint.damping_ratio[i], joint.target[i], joint.speed[i], joint.force_max[i]};
}

/// Sets `joint` from its definition. `a`, `b`: slots of the bodies that it connects. Errors: bad_argument,
/// out_of_range, not_normalised.
Status make_joint(const JointDef& def, uint32_t a, uint32_t b, JointState& joint) {
  if (!is_joint_type(def.type)) return Status::bad_argument;
  joint.type = static_cast<uint32_t>(def.type);
  joint.body_a = a;
  joint.body_b = b;
  joint.collide = def.collide ? 1 : 0;
  joint.user_data = def.user_data;
  joint.anchor_a = def.anchor_a;
  joint.anchor_b = def.anchor_b;
  if (!normalise_input(def.frame_a, joint.frame_a) || !normalise_input(def.frame_b, joint.frame_b))
    return Status::not_normalised;
  set_axis(def.axis, 0, joint);
  set_axis(def.second, 1, joint);
  joint.friction[0] = def.friction_force;
  joint.friction[1] = def.friction_torque;
  joint.break_force = def.break_force;
  joint.break_torque = def.break_torque;
  return is_joint(joint) ? Status::ok : Status::out_of_range;
}

template <class Byte>
bool find_joint(const StateView<Byte>& state, JointId id, uint32_t& slot) {
  slot = id.slot - 1;  // slot 0 of the null id wraps to a slot beyond every capacity
  return slot < state.joints.count && state.joints[slot].type != 0 && state.joints[slot].generation == id.generation;
}

/// Takes the lowest free joint slot and stores it in `slot`. Returns false if no slot is free.
bool take_joint_slot(StateView<uint8_t>& state, uint32_t& slot) {
  WorldState& world = state.world;
  slot = world.joints_used;
  if (world.joint_count < world.joints_used) {
    for (uint32_t i = 0; i < world.joints_used; ++i) {
      const JointState& joint = state.joints[i];
      if (joint.type != 0 || joint.generation == k_generation_last) continue;
      slot = i;
      break;
    }
  }
  if (slot >= state.joints.count) return false;
  if (slot == world.joints_used) ++world.joints_used;
  ++world.joint_count;
  return true;
}

BodyId body_id(const StateView<const uint8_t>& state, uint32_t slot) {
  return {slot + 1, state.properties[slot].generation};
}

Scaled size_of(const Vec3<Scaled>& v) {
  return square_root(add(add(multiply(v.x, v.x), multiply(v.y, v.y)), multiply(v.z, v.z)));
}

bool is_broken(const JointState& joint) {
  const auto over = [](const Vec3<Scaled>& load, Scaled most) {
    return is_positive(most) && less(most, size_of(load));
  };
  return over(joint.force, joint.break_force) || over(joint.torque, joint.break_torque);
}

}  // namespace

void remove_joint(StateView<uint8_t>& state, uint32_t slot) {
  JointState& joint = state.joints[slot];
  wake_slot(state, joint.body_a);
  wake_slot(state, joint.body_b);
  const uint32_t generation = joint.generation;
  joint = JointState{};
  joint.generation = generation;
  --state.world.joint_count;
}

void remove_joints_of(StateView<uint8_t>& state, uint32_t body) {
  if (state.world.joint_count == 0) return;
  for (uint32_t slot = 0; slot < state.world.joints_used; ++slot) {
    const JointState& joint = state.joints[slot];
    if (joint.type != 0 && (joint.body_a == body || joint.body_b == body)) remove_joint(state, slot);
  }
}

uint32_t wake_jointed(Span<const JointState> joints, Span<const BodyProperties> properties,
                      Span<const BodyMotion> motions, Span<BodyActivity> activities, const StepCacheView& cache) {
  for (uint32_t woke = 0;;) {
    const uint32_t before = woke;
    for (const JointState& joint : joints) {
      if (!holds(joint)) continue;
      const auto wake = [&](uint32_t sleeper, uint32_t other) {
        if (activities[sleeper].asleep != 0 && is_moving(properties[other], motions[other], activities[other]))
          woke += wake_all_with(sleeper, activities, cache.active);
      };
      wake(joint.body_a, joint.body_b);
      wake(joint.body_b, joint.body_a);
    }
    if (woke == before) return woke;
    cache.cache.contacts_known = 0;
  }
}

Span<const uint64_t> list_disabled_pairs(Span<const JointState> joints, Span<uint64_t> keys) {
  uint32_t count = 0;
  bool sorted = true;
  for (const JointState& joint : joints) {
    if (joint.type == 0 || joint.collide != 0) continue;
    keys[count] = key_of_pair(joint.body_a, joint.body_b);
    sorted = sorted && (count == 0 || keys[count - 1] <= keys[count]);
    ++count;
  }
  if (!sorted) heap_sort(keys.first(count), [](uint64_t a, uint64_t b) { return a < b; });
  return keys.first(count);
}

void break_joints(World& world, StepReport& report) {
  StateView<uint8_t> state = view_of(world);
  const Span<JointEvent> room = room_of(world.hooks.joint_events);
  uint32_t events = 0;
  for (uint32_t slot = 0; slot < state.world.joints_used; ++slot) {
    const JointState& joint = state.joints[slot];
    if (joint.type == 0 || !is_broken(joint)) continue;
    ++report.joints.broken;
    if (events < room.count) {
      const StateView<const uint8_t> read = view_of(static_cast<const World&>(world));
      room[events++] = {{slot + 1, joint.generation},
                        body_id(read, joint.body_a),
                        body_id(read, joint.body_b),
                        joint.user_data,
                        {joint.force, joint.torque}};
    } else if (room.count != 0) {
      ++report.events.joint_dropped;
    }
    remove_joint(state, slot);
  }
  report.events.joint = events;
}

Status create_joint(World& world, const JointDef& def, JointId& id) {
  const FloatEnvironment environment;
  StateView<uint8_t> state = view_of(world);
  if (!contains(world.features->features, Features::joints)) return Status::feature_missing;
  uint32_t a = 0, b = 0, slot = 0;
  if (!find_body(state, def.a, a) || !find_body(state, def.b, b)) return Status::bad_id;
  if (a == b || (!is_dynamic(state.properties[a]) && !is_dynamic(state.properties[b]))) return Status::bad_argument;
  JointState joint{};
  if (const Status status = make_joint(def, a, b, joint); status != Status::ok) return status;
  if (!take_joint_slot(state, slot)) return Status::pool_full;
  joint.generation = state.joints[slot].generation + 1;
  state.joints[slot] = joint;
  wake_slot(state, a);
  wake_slot(state, b);
  id = {slot + 1, joint.generation};
  return Status::ok;
}

Status destroy_joint(World& world, JointId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_joint(state, id, slot)) return Status::bad_id;
  remove_joint(state, slot);
  return Status::ok;
}

Status set_joint(World& world, JointId id, const JointDef& def) {
  const FloatEnvironment environment;
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_joint(state, id, slot)) return Status::bad_id;
  JointState& before = state.joints[slot];
  JointState joint{};
  if (const Status status = make_joint(def, before.body_a, before.body_b, joint); status != Status::ok) return status;
  joint.generation = before.generation;
  joint.force = before.force;
  joint.torque = before.torque;
  if (joint.type == before.type) {
    for (uint32_t i = 0; i < k_joint_rows_max; ++i) joint.impulse[i] = before.impulse[i];
  }
  before = joint;
  wake_slot(state, joint.body_a);
  wake_slot(state, joint.body_b);
  return Status::ok;
}

Status get_joint(const World& world, JointId id, JointDef& def) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_joint(state, id, slot)) return Status::bad_id;
  const JointState& joint = state.joints[slot];
  def = {static_cast<JointType>(joint.type),
         body_id(state, joint.body_a),
         body_id(state, joint.body_b),
         joint.anchor_a,
         joint.anchor_b,
         joint.frame_a,
         joint.frame_b,
         axis_of(joint, 0),
         axis_of(joint, 1),
         joint.friction[0],
         joint.friction[1],
         joint.collide != 0,
         joint.break_force,
         joint.break_torque,
         joint.user_data};
  return Status::ok;
}

Status get_joint_reaction(const World& world, JointId id, JointReaction& reaction) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_joint(state, id, slot)) return Status::bad_id;
  reaction = {state.joints[slot].force, state.joints[slot].torque};
  return Status::ok;
}

bool is_valid(const World& world, JointId id) {
  uint32_t slot = 0;
  return find_joint(view_of(world), id, slot);
}

JointId next_joint(const World& world, JointId previous) {
  const StateView<const uint8_t> state = view_of(world);
  for (uint32_t slot = previous.slot; slot < state.world.joints_used; ++slot) {
    if (state.joints[slot].type != 0) return {slot + 1, state.joints[slot].generation};
  }
  return {};
}

Status place_joint(const World& world, const Position& point, const Quat& frame, JointDef& def) {
  const FloatEnvironment environment;
  const StateView<const uint8_t> state = view_of(world);
  uint32_t a = 0, b = 0;
  if (!find_body(state, def.a, a) || !find_body(state, def.b, b)) return Status::bad_id;
  Quat unit;
  if (!normalise_input(frame, unit)) return Status::not_normalised;
  JointDef placed = def;
  const auto place = [&](const BodyPose& pose, Vec3<Real>& anchor, Quat& orientation) {
    const Vec3<Real> offset = real_difference(point, pose.position);
    if (!within(offset, k_anchor_max)) return false;
    anchor = rotate_inverse(pose.rotation, offset);
    orientation = normalise(multiply(conjugate(pose.rotation), unit));
    return true;
  };
  if (!place(state.poses[a], placed.anchor_a, placed.frame_a) ||
      !place(state.poses[b], placed.anchor_b, placed.frame_b))
    return Status::out_of_range;
  def = placed;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
