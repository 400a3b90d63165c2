#pragma once
#include "contact/contact_cache.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The last generation of a slot. When a body of this generation is destroyed, its slot is retired: it is never
/// assigned again.
inline constexpr uint32_t k_generation_last = UINT32_MAX;

inline uint32_t slot_bit(uint32_t slot) { return 1u << (slot % 32); }

/// Takes the lowest free body slot and stores it in `slot`. Returns false if no slot is free.
inline bool take_slot(StateView<uint8_t>& state, uint32_t& slot) {
  for (uint32_t word = state.world.free_word; word < state.slots.count; ++word) {
    if (state.slots[word] == UINT32_MAX) continue;
    const uint32_t candidate = word * 32 + static_cast<uint32_t>(__builtin_ctz(~state.slots[word]));
    if (candidate >= state.properties.count) return false;
    state.slots[word] |= slot_bit(candidate);
    state.world.free_word = word;
    if (candidate >= state.world.slots_used) state.world.slots_used = candidate + 1;
    ++state.world.body_count;
    slot = candidate;
    return true;
  }
  return false;
}

/// Frees the slot of a destroyed body, or retires it if its generations are used up.
inline void give_slot_back(StateView<uint8_t>& state, uint32_t slot) {
  --state.world.body_count;
  if (state.properties[slot].generation == k_generation_last) {
    ++state.world.slots_retired;
    return;
  }
  const uint32_t word = slot / 32;
  state.slots[word] &= ~slot_bit(slot);
  if (word < state.world.free_word) state.world.free_word = word;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
