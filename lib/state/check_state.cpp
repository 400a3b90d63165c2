#include "base/float_environment.h"
#include "broad_phase/pair_filter.h"
#include "broad_phase/pair_key.h"
#include "contact/manifold_recycling.h"
#include "math/root.h"
#include "motion/activity.h"
#include "shape/shape_properties.h"
#include "solver/substeps.h"
#include "state/asset_binding.h"
#include "state/fields.h"
#include "state/joint_state.h"
#include "state/ranges.h"
#include "state/slots.h"
#include "state/snapshot.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using State = StateView<const uint8_t>;

constexpr Real k_impulse_max = 131000.0;

bool is_unit_quaternion(const Quat& q) {
  Quat ignored;
  return normalise_input(q, ignored);
}

bool is_pose(const BodyPose& pose) {
#if defined(DETENT_FX32)
  if (pose.zero != 0) return false;
#endif
  return is_position(pose.position) && is_unit_quaternion(pose.rotation);
}

bool is_unit_size(Unit value) { return value >= Unit(0.0) && value <= Unit(1.0); }

/// Whether the bounding radius equals that of set_shape_properties(), up to the rounding of the sizes. body_convex()
/// accepts such a difference.
bool is_bound(Unit bound, Unit expected) {
  constexpr Unit k_error = sizeof(Unit) == 4 && !DETENT_FIXED ? 0x1p-23 : 0x1p-28;
  return bound >= Unit(0.49) && bound <= Unit(1.0) && abs(bound - expected) <= k_error;
}

/// As is_bound(), for the expected radius core + rounding. Takes `core`, the radius without the rounding, because the
/// sum may exceed the range of a Unit.
bool is_bound_of(Unit core, const BodyProperties& properties) {
  return core <= Unit(1.5) - properties.rounding && is_bound(properties.bounding_radius, core + properties.rounding);
}

bool is_bound_of_core(const BodyProperties& properties) {
  return is_bound_of(core_bound(shape_of(properties), properties.size), properties);
}

/// Whether the sizes and the asset of a hull body are valid. Range: check_assets() has accepted `assets`.
bool is_hull(const BodyProperties& properties, AssetTable assets, Span<const AssetState> bound) {
  if (properties.asset >= bound.count || bound[properties.asset].kind != static_cast<uint32_t>(AssetKind::hull))
    return false;
  const HullView hull = hull_view(assets.assets[properties.asset].bytes);
  if (is_dynamic(properties) && hull.frame() != HullFrame::principal) return false;
  if (properties.size_exponent < hull.exponent()) return false;
  return hull_half_extents(hull, properties.size_exponent) == properties.size &&
         is_bound_of(hull_radius(hull, properties.size_exponent), properties);
}

bool is_compound_of(const BodyProperties& properties, AssetTable assets, const FeatureTable& features,
                    Span<const AssetState> bound) {
  if (properties.asset >= bound.count || bound[properties.asset].kind != static_cast<uint32_t>(AssetKind::compound))
    return false;
  BodyProperties expected = properties;
  return set_shape_properties(compound(properties.asset), expected, assets, features) == Status::ok &&
         expected.size == properties.size && expected.size_exponent == properties.size_exponent &&
         expected.bounding_radius == properties.bounding_radius && expected.rounding == properties.rounding;
}

bool is_terrain_of(const BodyProperties& properties, AssetTable assets, const FeatureTable& features,
                   Span<const AssetState> bound) {
  if (is_dynamic(properties) || properties.asset >= bound.count ||
      bound[properties.asset].kind != static_cast<uint32_t>(AssetKind::terrain))
    return false;
  BodyProperties expected = properties;
  return set_shape_properties(terrain(properties.asset), expected, assets, features) == Status::ok &&
         expected.size == properties.size && expected.size_exponent == properties.size_exponent &&
         expected.bounding_radius == properties.bounding_radius;
}

bool is_shape(const BodyProperties& properties, AssetTable assets, const FeatureTable& features,
              Span<const AssetState> bound_assets) {
  if (properties.size_exponent < -14 || properties.size_exponent > 15 ||
      properties.rotation_locks > k_rotation_locks_all)
    return false;
  if (!is_unit_size(properties.size.x) || !is_unit_size(properties.size.y) || !is_unit_size(properties.size.z))
    return false;
  const Unit zero = 0.0, smallest = 0x1p-16;
  const Unit bound = properties.bounding_radius;
  const ShapeType shape = shape_of(properties);
  const bool rounds = shape == ShapeType::box || shape == ShapeType::cylinder || shape == ShapeType::cone ||
                      shape == ShapeType::hull || shape == ShapeType::compound;
  const bool sharp = properties.rounding == zero;
  if (!sharp && (!rounds || !is_unit_size(properties.rounding) || properties.rounding < smallest)) return false;
  if (asset_kind_of(shape) == AssetKind::none && properties.asset != 0) return false;
  switch (shape) {
    case ShapeType::sphere:
      return bound == properties.size.x && is_bound(bound, properties.size.x) && properties.size.y == zero &&
             properties.size.z == zero;
    case ShapeType::capsule:
      return properties.size.x >= smallest && is_bound(bound, properties.size.x + properties.size.y) &&
             properties.size.z == zero;
    case ShapeType::cylinder:
    case ShapeType::cone:
      return properties.size.x >= smallest && properties.size.y >= smallest && properties.size.z == zero &&
             is_bound_of_core(properties);
    case ShapeType::box:
      return properties.size.x >= smallest && properties.size.y >= smallest && properties.size.z >= smallest &&
             is_bound_of_core(properties);
    case ShapeType::hull:
      return properties.size.x >= smallest && properties.size.y >= smallest && properties.size.z >= smallest &&
             is_hull(properties, assets, bound_assets);
    case ShapeType::terrain:
      return is_terrain_of(properties, assets, features, bound_assets);
    case ShapeType::compound:
      return is_compound_of(properties, assets, features, bound_assets);
    case ShapeType::half_space:
      return properties.type != static_cast<uint32_t>(BodyType::dynamic) && properties.size_exponent == 0 &&
             bound == zero && properties.size == Vec3<Unit>{zero, zero, zero};
    default:
      return false;
  }
}

bool has_mass(const BodyProperties& properties) {
  if (is_dynamic(properties)) return is_mass(properties.mass) && are_inverse_inertias(properties);
  const Scaled none = 0.0;
  return (properties.mass == none || is_mass(properties.mass)) && properties.inverse_inertia[0] == none &&
         properties.inverse_inertia[1] == none && properties.inverse_inertia[2] == none;
}

/// The features of the world in which the state was saved.
Features features_of(const State& state) {
  return without(Features::all, static_cast<Features>(state.header.left_out));
}

bool is_linked(const State& state, const BodyProperties& properties) {
  const bool sharp = properties.rounding == Unit(0.0) || is_compound(properties);
  const Features needed = feature_of(shape_of(properties)) | (sharp ? Features::none : Features::rounding);
  return contains(features_of(state), needed);
}

bool is_body(const State& state, const BodyProperties& properties, AssetTable assets, const FeatureTable& features) {
  const Scaled none = 0.0;
  return properties.type <= static_cast<uint32_t>(BodyType::dynamic) && properties.generation != 0 &&
         properties.sensor <= 1 && is_shape(properties, assets, features, state.assets) &&
         is_linked(state, properties) && has_mass(properties) &&
         is_between(properties.friction, none, scaled_from(k_friction_max)) &&
         is_between(properties.restitution, none, Scaled(1.0)) &&
         is_between(properties.rolling_resistance, none, scaled_from(k_friction_max)) &&
         is_between(properties.linear_damping, none, scaled_from(k_damping_max)) &&
         is_between(properties.angular_damping, none, scaled_from(k_damping_max)) &&
         is_between(properties.gravity_scale, negate(scaled_from(k_gravity_scale_max)),
                    scaled_from(k_gravity_scale_max)) &&
         is_rule(static_cast<RestitutionRule>(properties.restitution_rule));
}

bool is_motion(const BodyProperties& properties, const BodyMotion& motion) {
  if (type_of(properties) == BodyType::fixed) return is_zero(motion);
  return within(motion.linear_velocity, k_speed_max) && within(motion.angular_momentum, k_angular_velocity_work_max) &&
         within(motion.pending_velocity, k_speed_max) &&
         within(motion.pending_angular_momentum, k_angular_velocity_work_max);
}

bool is_empty_slot(const State& state, uint32_t slot) {
  BodyProperties rest = state.properties[slot];
  rest.generation = 0;
  return is_zero(rest) && is_zero(state.poses[slot]) && is_zero(state.motions[slot]) && is_zero(state.activities[slot]);
}

/// Whether the sleeping data of a body is valid. Bodies that fell asleep together are identified by the slot of one of
/// them.
bool is_activity(const State& state, uint32_t slot) {
  const BodyActivity& activity = state.activities[slot];
  if (!is_dynamic(state.properties[slot])) return is_zero(activity);
  if (activity.substeps > 64 || activity.calm_ticks > k_calm_ticks || activity.still_ticks > k_still_ticks)
    return false;
  if (activity.pending_event != 0 &&
      (activity.pending_event != static_cast<uint16_t>(BodyEventType::woke) || activity.asleep != 0))
    return false;
  if (activity.asleep == 0) return true;
  if (!contains(features_of(state), Features::sleeping)) return false;
  return activity.asleep <= state.activities.count && state.activities[activity.asleep - 1].asleep == activity.asleep;
}

bool is_idle(const State& state) {
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    if (is_moving(state.properties[slot], state.motions[slot], state.activities[slot])) return false;
  }
  return true;
}

bool are_bodies(const State& state, AssetTable assets, const FeatureTable& features) {
  uint32_t bodies = 0, retired = 0, used = 0;
  for (uint32_t slot = 0; slot < state.properties.count; ++slot) {
    const BodyProperties& properties = state.properties[slot];
    const bool taken = (state.slots[slot / 32] & slot_bit(slot)) != 0;
    if (properties.generation != 0) used = slot + 1;
    if (properties.type == 0) {
      if (!is_empty_slot(state, slot) || taken != (properties.generation == k_generation_last)) return false;
      retired += taken ? 1 : 0;
      continue;
    }
    if (!taken || !is_body(state, properties, assets, features) || !is_pose(state.poses[slot]) ||
        !is_motion(properties, state.motions[slot]) || !is_activity(state, slot))
      return false;
    ++bodies;
  }
  return bodies == state.world.body_count && retired == state.world.slots_retired && used == state.world.slots_used;
}

bool are_slots(const State& state) {
  for (uint32_t word = 0; word < state.slots.count; ++word) {
    for (uint32_t bit = 0; bit < 32; ++bit) {
      const uint32_t slot = word * 32 + bit;
      const bool taken = (state.slots[word] >> bit & 1) != 0;
      if (slot >= state.properties.count && taken) return false;
      if (slot < state.properties.count && word < state.world.free_word && !taken) return false;
    }
  }
  return state.world.free_word < state.slots.count;
}

bool is_contact(const State& state, const ContactState& contact) {
  if (contact.body_a >= contact.body_b || contact.body_b >= state.properties.count) return false;
  const BodyProperties &a = state.properties[contact.body_a], &b = state.properties[contact.body_b];
  if (a.type == 0 || b.type == 0 || (!is_dynamic(a) && !is_dynamic(b))) return false;
  if (contact.touching > 1 || contact.point_count < 1 || contact.point_count > k_manifold_points_max) return false;
  for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
    const bool there = i < contact.point_count;
    if ((contact.feature[i] != 0) != there || !within(contact.normal_impulse[i], Real(0.0), k_impulse_max))
      return false;
    if (!there && !is_zero(contact.normal_impulse[i])) return false;
    for (uint32_t k = 0; there && k < i; ++k) {
      if (contact.feature[k] == contact.feature[i]) return false;
    }
  }
  return within(contact.load, Real(0.0), k_real_max) && within(contact.friction_impulse, k_impulse_max) &&
         within(contact.angular_impulse, k_impulse_max);
}

bool are_contacts(const State& state) {
  const uint32_t count = state.world.contact_count;
  if (count > state.contacts.count) return false;
  for (uint32_t i = 0; i < count; ++i) {
    const ContactState& contact = state.contacts[i];
    if (!is_contact(state, contact)) return false;
    if (i == 0) continue;
    const ContactState& before = state.contacts[i - 1];
    const uint64_t last = key_of(before), key = key_of(contact);
    if (last > key || (last == key && before.part >= contact.part)) return false;
  }
  for (uint32_t i = count; i < state.contacts.count; ++i) {
    if (!is_zero(state.contacts[i])) return false;
  }
  return true;
}

bool are_manifolds(const State& state) {
  const bool reuses = state.world.contact_recycle_distance > Real(0.0);
  for (uint32_t i = 0; i < state.manifolds.count; ++i) {
    const ManifoldState& manifold = state.manifolds[i];
    if (is_zero(manifold)) continue;
    if (!reuses || i >= state.world.contact_count) return false;
    const ContactState& contact = state.contacts[i];
    if (!is_manifold(state.properties[contact.body_a], state.properties[contact.body_b], contact.point_count, manifold))
      return false;
  }
  return !reuses || state.manifolds.count == state.contacts.count;
}

/// Whether the alignment bytes at the ends of arrays are zero.
bool are_fills(const uint8_t* block, const Layout& layout) {
  for (uint32_t i = 0; i < k_section_count; ++i) {
    const uint32_t bytes = section_bytes(layout, i);
    const uint32_t fill = bytes % k_sections[i].element_bytes;
    if (!is_zero(block + layout.*k_sections[i].offset + (bytes - fill), fill)) return false;
  }
  return true;
}

bool are_assets(const State& state) {
  for (uint32_t i = 0; i < state.assets.count; ++i) {
    const AssetState& asset = state.assets[i];
    if (asset.kind > static_cast<uint32_t>(AssetKind::compound) || (asset.kind == 0 && !is_zero(asset))) return false;
  }
  return true;
}

bool are_sensed(const State& state) {
  uint32_t sensors = 0;
  for (const BodyProperties& properties : state.properties) sensors += is_sensor(properties) ? 1u : 0u;
  const uint32_t count = state.world.sensed_count;
  if (sensors != state.world.sensor_count || count > state.sensed.count) return false;
  if (sensors != 0 && state.sensed.count == 0) return false;
  for (uint32_t i = 0; i < state.sensed.count; ++i) {
    const SensedState& sensed = state.sensed[i];
    if (i >= count) {
      if (sensed.sensor != 0 || sensed.body != 0) return false;
      continue;
    }
    if (sensed.sensor >= state.properties.count || sensed.body >= state.properties.count) return false;
    const BodyProperties &sensor = state.properties[sensed.sensor], &body = state.properties[sensed.body];
    if (!is_sensor(sensor) || is_sensor(body) || body.type == 0) return false;
    if (i == 0) continue;
    const SensedState& before = state.sensed[i - 1];
    if (pair_key(before.sensor, before.body) >= pair_key(sensed.sensor, sensed.body)) return false;
  }
  return true;
}

}  // namespace

Status check_state(const uint8_t* block, Capacity capacity, AssetTable assets, const FeatureTable& features,
                   const FilterRuleTable& rules) {
  const State state = view_of(block, capacity);
  const WorldState& world = state.world;
  if (!is_reduction(static_cast<ManifoldReduction>(world.reduction)) ||
      !is_stabilisation(static_cast<Stabilisation>(world.stabilisation)) || world.sleeping > 1 ||
      world.continuous > 1 || world.idle > 1 ||
      !are_settings(world.gravity, world.tick_time, world.substeps, world.substeps_max, world.iterations,
                    world.convergence, world.relaxation, world.contact_frequency, world.damping_ratio,
                    world.restitution_threshold, world.contact_margin, world.contact_recycle_distance,
                    world.resting_penetration)) {
    return Status::corrupt;
  }
#if defined(DETENT_F32)
  if (world.zero != 0) return Status::corrupt;
#endif
  if (!contains(features_of(state), features_of(world.continuous != 0, world.sleeping != 0))) return Status::corrupt;
  if (world.joint_count != 0 && !contains(features_of(state), Features::joints)) return Status::corrupt;
  if (world.sensor_count != 0 && !contains(features_of(state), Features::sensors)) return Status::corrupt;
  if (!are_slots(state) || !are_assets(state) || !are_fills(block, state.layout)) return Status::corrupt;
  // Assets are checked before the bodies, because checking a body reads its asset.
  if (const Status status = check_assets(assets, features, state.assets); status != Status::ok) return status;
  if (!are_bodies(state, assets, features) || !are_contacts(state) || !are_manifolds(state) || !are_joints(state) ||
      !are_sensed(state) || (world.idle != 0 && !is_idle(state))) {
    return Status::corrupt;
  }
  for (const BodyProperties& properties : state.properties) {
    if (!has_rule(rules, properties.rule)) return Status::rule_missing;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
