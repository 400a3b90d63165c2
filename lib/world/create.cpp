#include "base/digest.h"
#include "base/float_environment.h"
#include "broad_phase/pair_filter.h"
#include "motion/activity.h"
#include "solver/solve_lanes.h"
#include "state/asset_binding.h"
#include "state/ranges.h"
#include "state/slots.h"
#include "world/body_change.h"
#include "world/body_parts.h"
#include "world/joints.h"
#include "world/sensors.h"
#include "world/settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void set_filter(const Filter& filter, BodyProperties& properties) {
  properties.category = filter.category;
  properties.mask = filter.mask;
  properties.group = filter.group;
  properties.rule = filter.rule;
}

/// Computes the BodyProperties of a new body from its definition. Errors: as create_body().
Status make_properties(const World& world, const BodyDef& def, BodyProperties& properties) {
  if (const Status status = set_body_shape(world, def.shape, def.type, properties); status != Status::ok) return status;
  if (const Status status = set_body_material(def.material, properties); status != Status::ok) return status;
  if (const Status status = set_body_damping(def.linear_damping, def.angular_damping, properties); status != Status::ok)
    return status;
  if (const Status status = set_body_gravity_scale(def.gravity_scale, properties); status != Status::ok) return status;
  if (const Status status = set_body_rotation_locks(def.rotation_locks, properties); status != Status::ok)
    return status;
  if (!has_rule(world.hooks.filter_rules, def.filter.rule)) return Status::rule_missing;
  set_filter(def.filter, properties);
  properties.type = static_cast<uint32_t>(def.type);
  if (!(def.mass == Scaled(0.0))) {
    if (!is_mass(def.mass)) return Status::out_of_range;
    properties.mass = def.mass;
  } else if (def.type == BodyType::dynamic) {
    if (const Status status = set_body_density(world, def.density, properties); status != Status::ok) return status;
  }
  if (const Status status = set_body_inverse_inertia(world, properties); status != Status::ok) return status;
  if (def.sensor) {
    if (const Status status = check_sensors(world); status != Status::ok) return status;
    properties.sensor = 1;
  }
  properties.user_data = def.user_data;
  return Status::ok;
}

/// Wakes both bodies of every contact that the filter now forbids. The next step no longer finds the pair of such a
/// contact, and so ends the contact. For this, both bodies must be awake.
void wake_forbidden(const World& world, StateView<uint8_t>& state, uint32_t slot) {
  const PairFilter filter = {state.properties, world.hooks.filter_rules};
  for (const ContactState& contact : state.contacts.first(state.world.contact_count)) {
    if ((contact.body_a != slot && contact.body_b != slot) || filter.allows(contact.body_a, contact.body_b)) continue;
    wake_slot(state, contact.body_a);
    wake_slot(state, contact.body_b);
  }
}

}  // namespace

Status create_world(uint8_t* block, uint32_t block_bytes, const WorldDef& def, const WorldHooks& hooks,
                    const FeatureTable& features, World& world) {
  const FloatEnvironment environment;
  if (const Status status = check_settings(def, features); status != Status::ok) return status;
  const uint32_t bytes = world_bytes(def.capacity);
  if (bytes == 0) return Status::out_of_range;
  if (block == nullptr || block_bytes < bytes) return Status::buffer_too_small;
  if (reinterpret_cast<uintptr_t>(block) % 8 != 0) return Status::buffer_misaligned;
  memset(block, 0, bytes);
  *at_offset<BlockHeader>(block, 0) = {k_snapshot_magic,
                                       k_snapshot_format,
                                       k_simulation_version,
                                       k_config,
                                       def.capacity.bodies,
                                       def.capacity.contacts,
                                       def.capacity.assets,
                                       left_out(features),
                                       def.capacity.manifolds ? 1u : 0u,
                                       def.capacity.joints,
                                       def.capacity.sensed,
                                       0};
  world = {block, &features, lanes_of_machine(), hooks};
  store_settings(def, view_of(world).world, def.capacity.manifolds);
  return Status::ok;
}

Status create_body(World& world, const BodyDef& def, BodyId& id) {
  const FloatEnvironment environment;
  BodyProperties properties{};
  BodyPose pose{};
  BodyMotion motion{};
  if (const Status status = make_properties(world, def, properties); status != Status::ok) return status;
  if (const Status status = make_pose(def.position, def.rotation, pose); status != Status::ok) return status;
  if (const Status status = make_motion(properties, pose.rotation, def.linear_velocity, def.angular_velocity, motion);
      status != Status::ok) {
    return status;
  }
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!take_slot(state, slot)) return Status::pool_full;
  properties.generation = state.properties[slot].generation + 1;
  state.properties[slot] = properties;
  state.poses[slot] = pose;
  state.motions[slot] = motion;
  state.world.idle = 0;
  state.world.sensor_count += properties.sensor;
  cache_of(state).active.set(slot);
  id = {slot + 1, properties.generation};
  return Status::ok;
}

Status destroy_body(World& world, BodyId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  remove_joints_of(state, slot);
  end_contacts(state, slot);
  forget_sensed(state, slot);
  state.world.sensor_count -= state.properties[slot].sensor;
  const uint32_t generation = state.properties[slot].generation;
  state.poses[slot] = BodyPose{};
  state.motions[slot] = BodyMotion{};
  state.activities[slot] = BodyActivity{};
  state.properties[slot] = BodyProperties{};
  state.properties[slot].generation = generation;
  give_slot_back(state, slot);
  return Status::ok;
}

Status set_pose(World& world, BodyId id, const Position& position, const Quat& rotation) {
  const FloatEnvironment environment;
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  const Status status = make_pose(position, rotation, state.poses[slot]);
  if (status != Status::ok) return status;
  wake_slot(state, slot);
  wake_neighbours(state, slot);
  return Status::ok;
}

Status set_velocity(World& world, BodyId id, const Vec3<Real>& velocity, const Vec3<Real>& angular_velocity) {
  const FloatEnvironment environment;
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  BodyMotion motion = state.motions[slot];
  const Status status =
      make_motion(state.properties[slot], state.poses[slot].rotation, velocity, angular_velocity, motion);
  if (status != Status::ok) return status;
  state.motions[slot] = motion;
  wake_slot(state, slot);
  return Status::ok;
}

Status wake_body(World& world, BodyId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  if (!is_dynamic(state.properties[slot])) return Status::bad_argument;
  wake_slot(state, slot);
  return Status::ok;
}

Status sleep_body(World& world, BodyId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  if (!is_dynamic(state.properties[slot])) return Status::bad_argument;
  if (!contains(world.features->features, Features::sleeping)) return Status::feature_missing;
  if (state.activities[slot].asleep != 0) return Status::ok;
  state.motions[slot] = BodyMotion{};
  state.activities[slot].still_ticks = k_still_ticks;
  state.activities[slot].asleep = slot + 1;
  state.activities[slot].pending_event = 0;
  return Status::ok;
}

Status set_user_data(World& world, BodyId id, uint32_t user_data) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  state.properties[slot].user_data = user_data;
  if (world.hooks.filter_rules.count == 0) return Status::ok;
  wake_forbidden(world, state, slot);
  if (state.world.sensor_count != 0) look_at_again(state, slot);
  return Status::ok;
}

Status set_filter(World& world, BodyId id, const Filter& filter) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  if (!has_rule(world.hooks.filter_rules, filter.rule)) return Status::rule_missing;
  set_filter(filter, state.properties[slot]);
  wake_slot(state, slot);
  wake_forbidden(world, state, slot);
  return Status::ok;
}

Status bind_asset(World& world, uint32_t index) {
  StateView<uint8_t> state = view_of(world);
  if (index >= state.assets.count) return Status::out_of_range;
  AssetState bound{};
  if (const Status status = describe_asset(world.hooks.assets, index, *world.features, bound); status != Status::ok)
    return status;
  AssetState& before = state.assets[index];
  if (before.digest != bound.digest || before.byte_count != bound.byte_count) {
    for (const BodyProperties& body : state.properties) {
      if (is_shape_of(body, index)) return Status::asset_mismatch;
    }
  }
  before = bound;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
