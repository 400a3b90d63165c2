#pragma once
#include "contact/contact_cache.h"
#include "motion/activity.h"
#include "state/step_cache.h"

/// Updates of the step cache and of the sleeping state that a call must make when it changes a body between steps.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Wakes the body and all bodies that fell asleep with it, and adds the body to the active set (the bodies that the
/// next step evaluates). Used by calls that change the motion of a body, or a property that affects its motion.
inline void wake_slot(StateView<uint8_t>& state, uint32_t slot) {
  const StepCacheView step = cache_of(state);
  state.world.idle = 0;
  if (wake_all_with(slot, state.activities, step.active) != 0) step.cache.contacts_known = 0;
  state.activities[slot].still_ticks = 0;
  step.active.set(slot);
}
/// Adds the body to the active set, so that the next step evaluates it again. Does not wake a sleeping body.
inline void look_at_again(StateView<uint8_t>& state, uint32_t slot) {
  state.world.idle = 0;
  cache_of(state).active.set(slot);
}
/// Wakes the bodies that touch the body or share a joint with it. Used by calls that move, change or remove the body.
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
/// Wakes all bodies, because a condition under which they came to rest (for example gravity) has changed.
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
/// Removes all contacts of a body, because a change of the body has made them invalid. Wakes the body and its
/// neighbours.
inline void end_contacts(StateView<uint8_t>& state, uint32_t slot) {
  wake_slot(state, slot);
  wake_neighbours(state, slot);
  state.world.contact_count = remove_contacts(slot, state.contacts.first(state.world.contact_count), state.manifolds);
  cache_of(state).cache.contacts_known = 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
