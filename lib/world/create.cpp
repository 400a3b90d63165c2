#include "base/digest.h"
#include "base/float_environment.h"
#include "dynamics/solve_quads.h"
#include "geometry/shape_traits.h"
#include "world/asset_binding.h"
#include "world/body_change.h"
#include "world/joints.h"
#include "world/ranges.h"
#include "world/slots.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Vec3<Real> k_still = {0.0, 0.0, 0.0};

bool is_material(const Material& material) {
  return within(material.friction, Real(0.0), k_friction_max) && within(material.restitution, Real(0.0), Real(1.0)) &&
         within(material.rolling_resistance, Real(0.0), Real(1.0));
}

/// A hull that the state vouches for and the table holds. Errors: out_of_range, asset_missing, bad_argument.
Status find_hull(const World& world, uint32_t asset, BodyType type) {
  const Span<const AssetState> bound = view_of(world).assets;
  if (asset >= bound.count) return Status::out_of_range;
  const AssetKind kind = static_cast<AssetKind>(bound[asset].kind);
  if (kind == AssetKind::none || !is_in(world.assets, asset)) return Status::asset_missing;
  if (kind != AssetKind::hull) return Status::bad_argument;
  const bool principal = hull_view(world.assets.assets[asset].bytes).frame() == HullFrame::principal;
  return type == BodyType::dynamic && !principal ? Status::bad_argument : Status::ok;
}

/// Everything about a body that is not where it is and how it moves.
Status make_traits(const World& world, const BodyDef& def, BodyTraits& traits) {
  if (def.type != BodyType::fixed && def.type != BodyType::kinematic && def.type != BodyType::dynamic) {
    return Status::bad_argument;
  }
  if (def.shape.type == ShapeType::hull) {
    if (const Status status = find_hull(world, def.shape.asset, def.type); status != Status::ok) return status;
  }
  if (const Status status = set_shape(def.shape, traits, world.assets, *world.features); status != Status::ok)
    return status;
  if (def.type == BodyType::dynamic && def.shape.type == ShapeType::half_space) return Status::bad_argument;
  if (!is_rule(def.material.restitution_rule)) return Status::bad_argument;
  if (!is_material(def.material) || !within(def.linear_damping, Real(0.0), k_damping_max) ||
      !within(def.angular_damping, Real(0.0), k_damping_max) ||
      !within(def.gravity_scale, -k_gravity_scale_max, k_gravity_scale_max)) {
    return Status::out_of_range;
  }
  traits.type = static_cast<uint32_t>(def.type);
  if (def.type == BodyType::dynamic) {
    traits.mass = def.mass;
    if (def.mass == Scaled(0.0)) {
      if (!is_mass(def.density)) return Status::out_of_range;
      traits.mass = multiply(def.density, shape_volume(traits, world.assets, *world.features));
    }
    if (!is_mass(traits.mass)) return Status::out_of_range;
    set_gyration(traits, world.assets, *world.features);
    if (!is_gyration(traits.gyration[0]) || !is_gyration(traits.gyration[1]) || !is_gyration(traits.gyration[2])) {
      return Status::out_of_range;
    }
  }
  traits.friction = scaled_from(def.material.friction);
  traits.restitution = scaled_from(def.material.restitution);
  traits.rolling_resistance = scaled_from(def.material.rolling_resistance);
  traits.linear_damping = scaled_from(def.linear_damping);
  traits.angular_damping = scaled_from(def.angular_damping);
  traits.gravity_scale = scaled_from(def.gravity_scale);
  traits.restitution_rule = static_cast<uint32_t>(def.material.restitution_rule);
  traits.user_data = def.user_data;
  return Status::ok;
}

/// Sets the motion of a body from what a user gives. Errors: bad_argument, out_of_range.
Status make_motion(const BodyTraits& traits, const Quat& rotation, const Vec3<Real>& velocity, const Vec3<Real>& spin,
                   BodyMotion& motion) {
  if (!within(velocity, k_speed_max)) return Status::out_of_range;
  const int32_t exponent = traits.size_exponent;
  // |spin| <= k_spin_max 2^-exponent, or any Real where that is more than a Real holds.
  const Real limit = exponent < -1 ? k_real_max : scale_by_power(k_spin_max, -exponent);
  if (!within(spin, limit)) return Status::out_of_range;
  const bool moves = !(velocity == k_still), turns = !(spin == k_still);
  if ((moves || turns) && type_of(traits) == BodyType::fixed) return Status::bad_argument;
  if (turns && static_cast<ShapeType>(traits.shape) == ShapeType::half_space) return Status::bad_argument;
  const Vec3<Real> spin_speed = {scale_by_power(spin.x, exponent), scale_by_power(spin.y, exponent),
                                 scale_by_power(spin.z, exponent)};
  if (!within(spin_speed * traits.bounding_radius, k_speed_max)) return Status::out_of_range;
  motion.velocity = velocity;
  motion.momentum = spin_speed;
  if (turns && is_dynamic(traits)) {
    const Vec3<Real> local = rotate_inverse(rotation, spin_speed);
    const Scaled one = 1.0;
    motion.momentum = rotate(rotation, Vec3<Real>{multiply(local.x, divide(one, traits.gyration[0])),
                                                  multiply(local.y, divide(one, traits.gyration[1])),
                                                  multiply(local.z, divide(one, traits.gyration[2]))});
  }
  return Status::ok;
}

Status make_pose(const Position& position, const Quat& rotation, BodyPose& pose) {
  if (!is_position(position)) return Status::out_of_range;
  Quat unit;
  if (!normalise_input(rotation, unit)) return Status::not_normalised;
  pose = BodyPose{};
  pose.position = position;
  pose.rotation = unit;
  return Status::ok;
}

bool speeds_fit(const BodyTraits& traits, const Quat& rotation, const BodyMotion& motion) {
  return within(motion.velocity, k_speed_max) && within(motion.momentum, k_spin_work_max) &&
         within(spin_of(traits, rotation, motion.momentum), k_spin_max);
}

/// An impulse, N s, over the mass times a power of two, as a speed. False if it leaves Real's range.
bool speed_from(const Vec3<Scaled>& impulse, Scaled mass, int exponent, Vec3<Real>& speed) {
  bool saturated = false;
  const Scaled over = scaled_by_power(mass, exponent);
  speed = {to_real(divide(impulse.x, over), saturated), to_real(divide(impulse.y, over), saturated),
           to_real(divide(impulse.z, over), saturated)};
  return !saturated;
}

/// A dynamic body and its change of motion, checked before it is made.
struct Push {
  StateView<uint8_t> state;
  uint32_t slot = 0;
  BodyMotion motion = {};

  Status find(BodyId id, const Vec3<Scaled>& cause) {
    if (!find_body(state, id, slot)) return Status::bad_id;
    if (!is_dynamic(state.traits[slot])) return Status::bad_argument;
    if (!is_number(cause)) return Status::out_of_range;
    motion = state.motions[slot];
    return Status::ok;
  }
  const BodyTraits& traits() const { return state.traits[slot]; }
  Status commit() {
    const Quat& rotation = state.poses[slot].rotation;
    const BodyMotion pending = {motion.pending_velocity, motion.pending_momentum, k_still, k_still};
    if (!speeds_fit(traits(), rotation, motion) || !speeds_fit(traits(), rotation, pending))
      return Status::out_of_range;
    state.motions[slot] = motion;
    rouse(state, slot);
    return Status::ok;
  }
};

Vec3<Scaled> over_tick(const Vec3<Scaled>& force, const WorldState& world) {
  const Scaled time = scaled_from(world.tick_time);
  return {multiply(force.x, time), multiply(force.y, time), multiply(force.z, time)};
}

}  // namespace

Status create_world(uint8_t* block, uint32_t block_bytes, const WorldDef& def, AssetTable assets, World& world,
                    const FeatureTable& features) {
  const FloatEnvironment environment;
  if (!are_settings(def.gravity, def.tick, def.substeps, def.substeps_max, def.iterations, def.convergence,
                    def.relaxation, def.stiffness, def.damping_ratio, def.restitution_threshold, def.breaking,
                    def.reuse)) {
    return Status::out_of_range;
  }
  if (!is_reduction(def.reduction) || !is_stabilisation(def.stabilisation)) return Status::bad_argument;
  if (!contains(features.features, features_of(def.continuous, def.sleeping))) return Status::feature_missing;
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
                                       def.capacity.joints};
  world = {block, assets, {}, {}, &features, has_quads() ? 4u : 1u};
  WorldState& state = view_of(world).world;
  state.substeps = def.substeps;
  state.substeps_max = def.substeps_max;
  state.sleeping = def.sleeping ? 1 : 0;
  state.continuous = def.continuous ? 1 : 0;
  state.iterations = def.iterations;
  state.convergence = def.convergence;
  state.stabilisation = static_cast<uint32_t>(def.stabilisation);
  state.gravity = def.gravity;
  state.tick_time = def.tick;
  state.relaxation = def.relaxation;
  state.stiffness = def.stiffness;
  state.damping_ratio = def.damping_ratio;
  state.restitution_threshold = def.restitution_threshold;
  state.reduction = static_cast<uint32_t>(def.reduction);
  state.breaking = def.breaking;
  state.reuse = def.capacity.manifolds ? def.reuse : Real(0.0);
  return Status::ok;
}

Status create_body(World& world, const BodyDef& def, BodyId& id) {
  const FloatEnvironment environment;
  BodyTraits traits{};
  BodyPose pose{};
  BodyMotion motion{};
  if (const Status status = make_traits(world, def, traits); status != Status::ok) return status;
  if (const Status status = make_pose(def.position, def.rotation, pose); status != Status::ok) return status;
  if (const Status status = make_motion(traits, pose.rotation, def.velocity, def.spin, motion); status != Status::ok) {
    return status;
  }
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!take_slot(state, slot)) return Status::pool_full;
  traits.generation = state.traits[slot].generation + 1;
  state.traits[slot] = traits;
  state.poses[slot] = pose;
  state.motions[slot] = motion;
  state.world.idle = 0;
  cache_of(state).visits.set(slot);
  id = {slot + 1, traits.generation};
  return Status::ok;
}

Status destroy_body(World& world, BodyId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  rouse(state, slot);
  rouse_neighbours(state, slot);
  remove_joints_of(state, slot);
  state.world.contact_count = remove_contacts(slot, state.contacts.first(state.world.contact_count), state.manifolds);
  cache_of(state).cache.contacts_known = 0;
  const uint32_t generation = state.traits[slot].generation;
  state.poses[slot] = BodyPose{};
  state.motions[slot] = BodyMotion{};
  state.activities[slot] = BodyActivity{};
  state.traits[slot] = BodyTraits{};
  state.traits[slot].generation = generation;
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
  rouse(state, slot);
  rouse_neighbours(state, slot);
  return Status::ok;
}

Status set_velocity(World& world, BodyId id, const Vec3<Real>& velocity, const Vec3<Real>& spin) {
  const FloatEnvironment environment;
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  BodyMotion motion = state.motions[slot];
  const Status status = make_motion(state.traits[slot], state.poses[slot].rotation, velocity, spin, motion);
  if (status != Status::ok) return status;
  state.motions[slot] = motion;
  rouse(state, slot);
  return Status::ok;
}

Status apply_force(World& world, BodyId id, const Vec3<Scaled>& force) {
  const FloatEnvironment environment;
  Push push = {view_of(world)};
  if (const Status status = push.find(id, force); status != Status::ok) return status;
  Vec3<Real> speed;
  if (!speed_from(over_tick(force, push.state.world), push.traits().mass, 0, speed)) return Status::out_of_range;
  push.motion.pending_velocity += speed;
  return push.commit();
}

Status apply_torque(World& world, BodyId id, const Vec3<Scaled>& torque) {
  const FloatEnvironment environment;
  Push push = {view_of(world)};
  if (const Status status = push.find(id, torque); status != Status::ok) return status;
  Vec3<Real> speed;
  const int exponent = push.traits().size_exponent;
  if (!speed_from(over_tick(torque, push.state.world), push.traits().mass, exponent, speed))
    return Status::out_of_range;
  push.motion.pending_momentum += speed;
  return push.commit();
}

Status apply_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse) {
  const Vec3<Real> centre = {0.0, 0.0, 0.0};
  return apply_impulse_at(world, id, impulse, centre);
}

Status apply_impulse_at(World& world, BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm) {
  const FloatEnvironment environment;
  Push push = {view_of(world)};
  if (const Status status = push.find(id, impulse); status != Status::ok) return status;
  const BodyTraits& traits = push.traits();
  const int exponent = traits.size_exponent;
  if (!within(arm, real_from_unit(traits.bounding_radius, exponent + 1))) return Status::out_of_range;
  Vec3<Real> speed;
  if (!speed_from(impulse, traits.mass, 0, speed) || !within(speed, k_speed_work_max)) return Status::out_of_range;
  // In halves of the unit of length, so that an arm of twice the radius fits a Unit.
  const Vec3<Unit> arm_halved = {unit_from_real(arm.x, exponent + 1), unit_from_real(arm.y, exponent + 1),
                                 unit_from_real(arm.z, exponent + 1)};
  const Vec3<Real> turn = cross(arm_halved, speed);
  push.motion.velocity += speed;
  push.motion.momentum += Vec3<Real>{scale_by_power(turn.x, 1), scale_by_power(turn.y, 1), scale_by_power(turn.z, 1)};
  return push.commit();
}

Status apply_angular_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse) {
  const FloatEnvironment environment;
  Push push = {view_of(world)};
  if (const Status status = push.find(id, impulse); status != Status::ok) return status;
  Vec3<Real> speed;
  if (!speed_from(impulse, push.traits().mass, push.traits().size_exponent, speed)) return Status::out_of_range;
  push.motion.momentum += speed;
  return push.commit();
}

Status set_gravity(World& world, const Vec3<Real>& gravity) {
  if (!within(gravity, k_gravity_max)) return Status::out_of_range;
  StateView<uint8_t> state = view_of(world);
  state.world.gravity = gravity;
  state.world.idle = 0;
  const StepCacheView step = cache_of(state);
  step.cache.contacts_known = 0;
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    BodyActivity& activity = state.activities[slot];
    if (activity.asleep != 0) step.visits.set(slot);
    activity.asleep = activity.still_ticks = 0;
  }
  return Status::ok;
}

Status wake_body(World& world, BodyId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  if (!is_dynamic(state.traits[slot])) return Status::bad_argument;
  rouse(state, slot);
  return Status::ok;
}

Status put_to_sleep(World& world, BodyId id) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  if (!is_dynamic(state.traits[slot])) return Status::bad_argument;
  if (!contains(world.features->features, Features::sleeping)) return Status::feature_missing;
  if (state.activities[slot].asleep != 0) return Status::ok;
  state.motions[slot] = BodyMotion{};
  state.activities[slot].still_ticks = k_still_ticks;
  state.activities[slot].asleep = slot + 1;
  return Status::ok;
}

Status set_user_data(World& world, BodyId id, uint32_t user_data) {
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  state.traits[slot].user_data = user_data;
  return Status::ok;
}

Status bind_asset(World& world, uint32_t index) {
  StateView<uint8_t> state = view_of(world);
  if (index >= state.assets.count) return Status::out_of_range;
  AssetState bound{};
  if (world.features->hull == nullptr) return Status::feature_missing;
  if (const Status status = describe_asset(world.assets, index, *world.features->hull, bound); status != Status::ok)
    return status;
  AssetState& before = state.assets[index];
  if (before.digest != bound.digest || before.byte_count != bound.byte_count) {
    for (const BodyTraits& body : state.traits) {
      if (is_hull_of(body, index)) return Status::asset_mismatch;
    }
  }
  before = bound;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
