#pragma once
#include "dynamics/activity.h"
#include "world/step_cache.h"

/// What a call that changes bodies between steps owes to the steps.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What changes a body from outside wakes it.
inline void rouse(StateView<uint8_t>& state, uint32_t slot) {
  const StepCacheView step = cache_of(state);
  state.world.idle = 0;
  if (wake_all_with(slot, state.activities, step.visits) != 0) step.cache.contacts_known = 0;
  state.activities[slot].still_ticks = 0;
  step.visits.set(slot);
}

/// And what takes it away wakes those that it touches or is joined to.
inline void rouse_neighbours(StateView<uint8_t>& state, uint32_t slot) {
  for (const ContactState& contact : state.contacts.first(state.world.contact_count)) {
    if (contact.body_a == slot) rouse(state, contact.body_b);
    if (contact.body_b == slot) rouse(state, contact.body_a);
  }
  for (const JointState& joint : state.joints.first(state.world.joints_used)) {
    if (joint.type == 0) continue;
    if (joint.body_a == slot) rouse(state, joint.body_b);
    if (joint.body_b == slot) rouse(state, joint.body_a);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
