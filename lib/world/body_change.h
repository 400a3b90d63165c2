#pragma once
#include "contact/contact_cache.h"
#include "motion/activity.h"
#include "state/step_cache.h"

/// What a call that changes bodies between steps owes to the steps.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What changes a body from outside wakes it.
inline void wake_slot(StateView<uint8_t>& state, uint32_t slot) {
  const StepCacheView step = cache_of(state);
  state.world.idle = 0;
  if (wake_all_with(slot, state.activities, step.visits) != 0) step.cache.contacts_known = 0;
  state.activities[slot].still_ticks = 0;
  step.visits.set(slot);
}
/// The next step looks at the body anew, which sleeps on.
inline void look_at_again(StateView<uint8_t>& state, uint32_t slot) {
  state.world.idle = 0;
  cache_of(state).visits.set(slot);
}
/// And what takes it away wakes those that it touches or is joined to.
inline void wake_neighbours(StateView<uint8_t>& state, uint32_t slot) {
  for (const ContactState& contact : state.contacts.first(state.world.contact_count)) {
    if (contact.body_a == slot) wake_slot(state, contact.body_b);
    if (contact.body_b == slot) wake_slot(state, contact.body_a);
  }
  for (const JointState& joint : state.joints.first(state.world.joints_used)) {
    if (joint.type == 0) continue;
    if (joint.body_a == slot) wake_slot(state, joint.body_b);
    if (joint.body_b == slot) wake_slot(state, joint.body_a);
  }
}
/// Wakes all, for what they rest by has changed.
inline void rouse_world(StateView<uint8_t>& state) {
  state.world.idle = 0;
  const StepCacheView step = cache_of(state);
  step.cache.contacts_known = 0;
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    BodyActivity& activity = state.activities[slot];
    activity.still_ticks = 0;
    if (activity.asleep == 0) continue;
    step.visits.set(slot);
    activity.asleep = 0;
    activity.news = static_cast<uint16_t>(BodyEventType::woke);
  }
}
/// The body is no longer what its contacts were made with.
inline void end_contacts(StateView<uint8_t>& state, uint32_t slot) {
  wake_slot(state, slot);
  wake_neighbours(state, slot);
  state.world.contact_count = remove_contacts(slot, state.contacts.first(state.world.contact_count), state.manifolds);
  cache_of(state).cache.contacts_known = 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
