#pragma once
#include "contact/contact_cache.h"
#include "motion/activity.h"
#include "state/step_cache.h"

/// Updates of the step cache and of sleeping that a call must make when it changes bodies between steps.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Wakes the body, with all bodies of its sleeping group, and puts it into the active set. Every change from outside
/// does this.
inline void wake_slot(StateView<uint8_t>& state, uint32_t slot) {
  const StepCacheView step = cache_of(state);
  state.world.idle = 0;
  if (wake_all_with(slot, state.activities, step.active) != 0) step.cache.contacts_known = 0;
  state.activities[slot].still_ticks = 0;
  step.active.set(slot);
}
/// The next step evaluates the body again; a sleeping body stays asleep.
inline void look_at_again(StateView<uint8_t>& state, uint32_t slot) {
  state.world.idle = 0;
  cache_of(state).active.set(slot);
}
/// Wakes the bodies that touch the body or share a joint with it. Every change that takes it away does this.
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
/// Wakes all bodies, because the conditions under which they came to rest have changed.
inline void wake_world(StateView<uint8_t>& state) {
  state.world.idle = 0;
  const StepCacheView step = cache_of(state);
  step.cache.contacts_known = 0;
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    BodyActivity& activity = state.activities[slot];
    activity.still_ticks = 0;
    if (activity.asleep == 0) continue;
    step.active.set(slot);
    activity.asleep = 0;
    activity.pending_event = static_cast<uint16_t>(BodyEventType::woke);
  }
}
/// Ends all contacts of a body that has changed so much that they are no longer valid.
inline void end_contacts(StateView<uint8_t>& state, uint32_t slot) {
  wake_slot(state, slot);
  wake_neighbours(state, slot);
  state.world.contact_count = remove_contacts(slot, state.contacts.first(state.world.contact_count), state.manifolds);
  cache_of(state).cache.contacts_known = 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
