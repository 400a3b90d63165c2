#include "state/step_cache.h"

#include "motion/activity.h"
#include "motion/predict.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void make_anew(const StepCacheView& step, const StateView<uint8_t>& state) {
  step.cache.fresh = 1;
  step.cache.contacts_known = 0;
  step.tree.make_empty();
  for (uint32_t& word : step.active.words) word = 0;
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) step.active.set(slot);
}

}  // namespace

Span<const uint32_t> partition_bodies(const StepCacheView& step, const StepSettings& settings,
                                      const StateView<uint8_t>& state, Span<BodyWork> work, Span<BodySweep> sweeps,
                                      Span<uint32_t> slots) {
  if (step.cache.fresh == 0) make_anew(step, state);
  // First removes all bodies of the active set from the tree, because the bounds of a body must not change while it is
  // in the tree.
  step.active.for_each([&](uint32_t slot) {
    if (step.tree.has(slot)) step.tree.remove(slot);
  });
  // Moving bodies fill the list from the front, resting bodies from the back.
  uint32_t moving = 0, resting = slots.count;
  step.active.for_each([&](uint32_t slot) {
    if (is_moving(state.properties[slot], state.motions[slot], state.activities[slot])) {
      slots[moving++] = slot;
      return;
    }
    step.active.clear(slot);
    if (state.properties[slot].type != 0) slots[--resting] = slot;
  });
  const Span<const uint32_t> newly_resting = {slots.data + resting, slots.count - resting};
  share(settings.team, Span<const uint32_t>(slots.first(moving)), k_bodies_shared, [&](Span<const uint32_t> part) {
    bound(settings, state.poses, state.properties, state.motions, part, work, step.bounds);
  });
  bound(settings, state.poses, state.properties, state.motions, newly_resting, work, step.bounds);
  for (const uint32_t slot : newly_resting) {
    sweeps[slot] = {};
    step.tree.insert(slot);
  }
  return slots.first(moving);
}

Span<const uint32_t> list_awake_contacts(const StepCacheView& step, const StateView<uint8_t>& state) {
  const auto awake = [&](uint32_t slot) { return is_awake(state.properties[slot], state.activities[slot]); };
  uint32_t count = 0;
  const auto list = [&](uint32_t place) {
    const ContactState& contact = state.contacts[place];
    if (awake(contact.body_a) || awake(contact.body_b)) step.awake_contacts[count++] = place;
  };
  if (step.cache.contacts_known != 0) {
    for (uint32_t i = 0; i < step.cache.awake_contact_count; ++i) list(step.awake_contacts[i]);
  } else {
    for (uint32_t place = 0; place < state.world.contact_count; ++place) list(place);
  }
  step.cache.contacts_known = 1;
  step.cache.awake_contact_count = count;
  return step.awake_contacts.first(count);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
