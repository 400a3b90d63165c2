#pragma once
#include <detent/world.h>

#include "collision/contact_cache.h"
#include "dynamics/activity.h"
#include "world/step_cache.h"

/// What calls share that make or change a body.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether a body of this type may have the shape. Errors: bad_argument; of a hull out_of_range, asset_missing.
Status suits(const World& world, ShapeType shape, uint32_t asset, BodyType type);
/// The shape's part of `traits` for a body of this type. Errors: bad_argument, out_of_range, asset_missing,
/// feature_missing.
Status set_body_shape(const World& world, const Shape& shape, BodyType type, BodyTraits& traits);
/// Sets the gyration, by the shape, the type and the turn locks. Errors: out_of_range.
Status set_body_gyration(const World& world, BodyTraits& traits);
/// The mass of the shape at `density`. Errors: out_of_range.
Status set_body_density(const World& world, Scaled density, BodyTraits& traits);
/// Errors: bad_argument, out_of_range.
Status set_body_material(const Material& material, BodyTraits& traits);
Status set_body_damping(Real linear, Real angular, BodyTraits& traits);
Status set_body_gravity_scale(Real scale, BodyTraits& traits);
Status set_body_turn_locks(uint32_t locks, BodyTraits& traits);

/// Errors: out_of_range, not_normalised.
Status make_pose(const Position& position, const Quat& rotation, BodyPose& pose);
/// Sets the motion of a body from what a user gives. Errors: bad_argument, out_of_range.
Status make_motion(const BodyTraits& traits, const Quat& rotation, const Vec3<Real>& velocity, const Vec3<Real>& spin,
                   BodyMotion& motion);

/// True of a dynamic body's motion that state may hold.
bool speeds_fit(const BodyTraits& traits, const Quat& rotation, const BodyMotion& motion);

/// What changes a body from outside wakes it.
inline void rouse(StateView<uint8_t>& state, uint32_t slot) {
  const StepCacheView step = cache_of(state);
  state.world.idle = 0;
  if (wake_all_with(slot, state.activities, step.visits) != 0) step.cache.contacts_known = 0;
  state.activities[slot].still_ticks = 0;
  step.visits.set(slot);
}
/// And what takes it away wakes those it touches.
inline void rouse_neighbours(StateView<uint8_t>& state, uint32_t slot) {
  for (const ContactState& contact : state.contacts.first(state.world.contact_count)) {
    if (contact.body_a == slot) rouse(state, contact.body_b);
    if (contact.body_b == slot) rouse(state, contact.body_a);
  }
}
/// Wakes all, for what they rest by has changed.
inline void rouse_world(StateView<uint8_t>& state) {
  state.world.idle = 0;
  const StepCacheView step = cache_of(state);
  step.cache.contacts_known = 0;
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    BodyActivity& activity = state.activities[slot];
    if (activity.asleep != 0) step.visits.set(slot);
    activity.asleep = activity.still_ticks = 0;
  }
}
/// The body is no longer what its contacts were made with.
inline void end_contacts(StateView<uint8_t>& state, uint32_t slot) {
  rouse(state, slot);
  rouse_neighbours(state, slot);
  state.world.contact_count = remove_contacts(slot, state.contacts.first(state.world.contact_count), state.manifolds);
  cache_of(state).cache.contacts_known = 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
