#include "base/float_environment.h"
#include "broad_phase/pair_filter.h"
#include "broad_phase/pair_key.h"
#include "contact/manifold_reuse.h"
#include "math/root.h"
#include "motion/activity.h"
#include "shape/shape_traits.h"
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

/// Whether the bounding radius is that of set_shape_traits(), except for the rounding of the sizes. body_convex()
/// allows this difference.
bool is_bound(Unit bound, Unit expected) {
  constexpr Unit k_error = sizeof(Unit) == 4 && !DETENT_FIXED ? 0x1p-23 : 0x1p-28;
  return bound >= Unit(0.49) && bound <= Unit(1.0) && abs(bound - expected) <= k_error;
}

/// The same for a core with rounding; their sum need not fit a Unit.
bool is_bound_of(Unit core, const BodyTraits& traits) {
  return core <= Unit(1.5) - traits.rounding && is_bound(traits.bounding_radius, core + traits.rounding);
}

bool is_bound_of_core(const BodyTraits& traits) {
  return is_bound_of(core_bound(shape_of(traits), traits.size), traits);
}

/// `assets`: already checked by check_assets().
bool is_hull(const BodyTraits& traits, AssetTable assets, Span<const AssetState> bound) {
  if (traits.asset >= bound.count || bound[traits.asset].kind != static_cast<uint32_t>(AssetKind::hull)) return false;
  const HullView hull = hull_view(assets.assets[traits.asset].bytes);
  if (is_dynamic(traits) && hull.frame() != HullFrame::principal) return false;
  if (traits.size_exponent < hull.exponent()) return false;
  return hull_half_extents(hull, traits.size_exponent) == traits.size &&
         is_bound_of(hull_radius(hull, traits.size_exponent), traits);
}

bool is_compound_of(const BodyTraits& traits, AssetTable assets, const FeatureTable& features,
                    Span<const AssetState> bound) {
  if (traits.asset >= bound.count || bound[traits.asset].kind != static_cast<uint32_t>(AssetKind::compound))
    return false;
  BodyTraits expected = traits;
  return set_shape_traits(compound(traits.asset), expected, assets, features) == Status::ok &&
         expected.size == traits.size && expected.size_exponent == traits.size_exponent &&
         expected.bounding_radius == traits.bounding_radius && expected.rounding == traits.rounding;
}

bool is_surface_of(const BodyTraits& traits, AssetTable assets, const FeatureTable& features,
                   Span<const AssetState> bound) {
  if (is_dynamic(traits) || traits.asset >= bound.count ||
      bound[traits.asset].kind != static_cast<uint32_t>(AssetKind::surface))
    return false;
  BodyTraits expected = traits;
  return set_shape_traits(surface(traits.asset), expected, assets, features) == Status::ok &&
         expected.size == traits.size && expected.size_exponent == traits.size_exponent &&
         expected.bounding_radius == traits.bounding_radius;
}

bool is_shape(const BodyTraits& traits, AssetTable assets, const FeatureTable& features,
              Span<const AssetState> bound_assets) {
  if (traits.size_exponent < -14 || traits.size_exponent > 15 || traits.turn_locks > k_turn_locks_all) return false;
  if (!is_unit_size(traits.size.x) || !is_unit_size(traits.size.y) || !is_unit_size(traits.size.z)) return false;
  const Unit zero = 0.0, smallest = 0x1p-16;
  const Unit bound = traits.bounding_radius;
  const ShapeType shape = shape_of(traits);
  const bool rounds = shape == ShapeType::box || shape == ShapeType::cylinder || shape == ShapeType::cone ||
                      shape == ShapeType::hull || shape == ShapeType::compound;
  const bool sharp = traits.rounding == zero;
  if (!sharp && (!rounds || !is_unit_size(traits.rounding) || traits.rounding < smallest)) return false;
  if (asset_kind_of(shape) == AssetKind::none && traits.asset != 0) return false;
  switch (shape) {
    case ShapeType::sphere:
      return bound == traits.size.x && is_bound(bound, traits.size.x) && traits.size.y == zero && traits.size.z == zero;
    case ShapeType::capsule:
      return traits.size.x >= smallest && is_bound(bound, traits.size.x + traits.size.y) && traits.size.z == zero;
    case ShapeType::cylinder:
    case ShapeType::cone:
      return traits.size.x >= smallest && traits.size.y >= smallest && traits.size.z == zero &&
             is_bound_of_core(traits);
    case ShapeType::box:
      return traits.size.x >= smallest && traits.size.y >= smallest && traits.size.z >= smallest &&
             is_bound_of_core(traits);
    case ShapeType::hull:
      return traits.size.x >= smallest && traits.size.y >= smallest && traits.size.z >= smallest &&
             is_hull(traits, assets, bound_assets);
    case ShapeType::surface:
      return is_surface_of(traits, assets, features, bound_assets);
    case ShapeType::compound:
      return is_compound_of(traits, assets, features, bound_assets);
    case ShapeType::half_space:
      return traits.type != static_cast<uint32_t>(BodyType::dynamic) && traits.size_exponent == 0 && bound == zero &&
             traits.size == Vec3<Unit>{zero, zero, zero};
    default:
      return false;
  }
}

bool has_mass(const BodyTraits& traits) {
  if (is_dynamic(traits)) return is_mass(traits.mass) && are_gyrations(traits);
  const Scaled none = 0.0;
  return (traits.mass == none || is_mass(traits.mass)) && traits.gyration[0] == none && traits.gyration[1] == none &&
         traits.gyration[2] == none;
}

/// The features that the state's world has linked.
Features features_of(const State& state) {
  return without(Features::all, static_cast<Features>(state.header.left_out));
}

bool is_linked(const State& state, const BodyTraits& traits) {
  const bool sharp = traits.rounding == Unit(0.0) || is_compound(traits);
  const Features needed = feature_of(shape_of(traits)) | (sharp ? Features::none : Features::rounding);
  return contains(features_of(state), needed);
}

bool is_body(const State& state, const BodyTraits& traits, AssetTable assets, const FeatureTable& features) {
  const Scaled none = 0.0;
  return traits.type <= static_cast<uint32_t>(BodyType::dynamic) && traits.generation != 0 && traits.sensor <= 1 &&
         is_shape(traits, assets, features, state.assets) && is_linked(state, traits) && has_mass(traits) &&
         is_between(traits.friction, none, scaled_from(k_friction_max)) &&
         is_between(traits.restitution, none, Scaled(1.0)) &&
         is_between(traits.rolling_resistance, none, scaled_from(k_friction_max)) &&
         is_between(traits.linear_damping, none, scaled_from(k_damping_max)) &&
         is_between(traits.angular_damping, none, scaled_from(k_damping_max)) &&
         is_between(traits.gravity_scale, negate(scaled_from(k_gravity_scale_max)), scaled_from(k_gravity_scale_max)) &&
         is_rule(static_cast<RestitutionRule>(traits.restitution_rule));
}

bool is_motion(const BodyTraits& traits, const BodyMotion& motion) {
  if (type_of(traits) == BodyType::fixed) return is_zero(motion);
  return within(motion.velocity, k_speed_max) && within(motion.momentum, k_spin_work_max) &&
         within(motion.pending_velocity, k_speed_max) && within(motion.pending_momentum, k_spin_work_max);
}

bool is_empty_slot(const State& state, uint32_t slot) {
  BodyTraits rest = state.traits[slot];
  rest.generation = 0;
  return is_zero(rest) && is_zero(state.poses[slot]) && is_zero(state.motions[slot]) && is_zero(state.activities[slot]);
}

/// Whether the sleeping data of a body is valid. A sleeping group is identified by one of its bodies.
bool is_activity(const State& state, uint32_t slot) {
  const BodyActivity& activity = state.activities[slot];
  if (!is_dynamic(state.traits[slot])) return is_zero(activity);
  if (activity.substeps > 64 || activity.calm_ticks > k_calm_ticks || activity.still_ticks > k_still_ticks)
    return false;
  if (activity.news != 0 && (activity.news != static_cast<uint16_t>(BodyEventType::woke) || activity.asleep != 0))
    return false;
  if (activity.asleep == 0) return true;
  if (!contains(features_of(state), Features::sleeping)) return false;
  return activity.asleep <= state.activities.count && state.activities[activity.asleep - 1].asleep == activity.asleep;
}

bool is_idle(const State& state) {
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    if (is_moving(state.traits[slot], state.motions[slot], state.activities[slot])) return false;
  }
  return true;
}

bool are_bodies(const State& state, AssetTable assets, const FeatureTable& features) {
  uint32_t bodies = 0, retired = 0, used = 0;
  for (uint32_t slot = 0; slot < state.traits.count; ++slot) {
    const BodyTraits& traits = state.traits[slot];
    const bool taken = (state.slots[slot / 32] & slot_bit(slot)) != 0;
    if (traits.generation != 0) used = slot + 1;
    if (traits.type == 0) {
      if (!is_empty_slot(state, slot) || taken != (traits.generation == k_generation_last)) return false;
      retired += taken ? 1 : 0;
      continue;
    }
    if (!taken || !is_body(state, traits, assets, features) || !is_pose(state.poses[slot]) ||
        !is_motion(traits, state.motions[slot]) || !is_activity(state, slot))
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
      if (slot >= state.traits.count && taken) return false;
      if (slot < state.traits.count && word < state.world.free_word && !taken) return false;
    }
  }
  return state.world.free_word < state.slots.count;
}

bool is_contact(const State& state, const ContactState& contact) {
  if (contact.body_a >= contact.body_b || contact.body_b >= state.traits.count) return false;
  const BodyTraits &a = state.traits[contact.body_a], &b = state.traits[contact.body_b];
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
  const bool reuses = state.world.reuse > Real(0.0);
  for (uint32_t i = 0; i < state.manifolds.count; ++i) {
    const ManifoldState& manifold = state.manifolds[i];
    if (is_zero(manifold)) continue;
    if (!reuses || i >= state.world.contact_count) return false;
    const ContactState& contact = state.contacts[i];
    if (!is_manifold(state.traits[contact.body_a], state.traits[contact.body_b], contact.point_count, manifold))
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
  for (const BodyTraits& traits : state.traits) sensors += is_sensor(traits) ? 1u : 0u;
  const uint32_t count = state.world.sensed_count;
  if (sensors != state.world.sensor_count || count > state.sensed.count) return false;
  if (sensors != 0 && state.sensed.count == 0) return false;
  for (uint32_t i = 0; i < state.sensed.count; ++i) {
    const SensedState& sensed = state.sensed[i];
    if (i >= count) {
      if (sensed.sensor != 0 || sensed.body != 0) return false;
      continue;
    }
    if (sensed.sensor >= state.traits.count || sensed.body >= state.traits.count) return false;
    const BodyTraits &sensor = state.traits[sensed.sensor], &body = state.traits[sensed.body];
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
                    world.convergence, world.relaxation, world.stiffness, world.damping_ratio,
                    world.restitution_threshold, world.breaking, world.reuse)) {
    return Status::corrupt;
  }
  if (!contains(features_of(state), features_of(world.continuous != 0, world.sleeping != 0))) return Status::corrupt;
  if (world.joint_count != 0 && !contains(features_of(state), Features::joints)) return Status::corrupt;
  if (world.sensor_count != 0 && !contains(features_of(state), Features::sensors)) return Status::corrupt;
  if (!are_slots(state) || !are_assets(state) || !are_fills(block, state.layout)) return Status::corrupt;
  // Assets are checked before the bodies, because the bodies are checked against their hulls.
  if (const Status status = check_assets(assets, features, state.assets); status != Status::ok) return status;
  if (!are_bodies(state, assets, features) || !are_contacts(state) || !are_manifolds(state) || !are_joints(state) ||
      !are_sensed(state) || (world.idle != 0 && !is_idle(state))) {
    return Status::corrupt;
  }
  for (const BodyTraits& traits : state.traits) {
    if (!has_rule(rules, traits.rule)) return Status::rule_missing;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
