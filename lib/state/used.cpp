#include "state/used.h"

#include <string.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

UsedCounts used_counts(const WorldState& world, uint32_t assets, bool has_manifolds) {
  const uint32_t slots = world.slots_used;
  return {{1, 1, slots, slots, slots, slots, (slots + 31) / 32, world.contact_count, assets,
           has_manifolds ? world.contact_count : 0, world.joints_used, world.sensed_count}};
}

UsedCounts used_counts(const StateView<const uint8_t>& state) {
  return used_counts(state.world, used_assets(state), state.manifolds.count != 0);
}

uint32_t used_assets(const StateView<const uint8_t>& state) {
  uint32_t count = state.assets.count;
  while (count != 0 && state.assets[count - 1].kind == 0) --count;
  return count;
}

void clear_unused(const StateView<uint8_t>& state, const UsedCounts& before, const UsedCounts& now) {
  uint8_t* const block = reinterpret_cast<uint8_t*>(&state.header);
  for (uint32_t i = 1; i < k_section_count; ++i) {
    if (before.of[i] <= now.of[i]) continue;
    const Section& section = k_sections[i];
    memset(block + state.layout.*section.offset + now.of[i] * section.element_bytes, 0,
           (before.of[i] - now.of[i]) * section.element_bytes);
  }
}

void copy_used(const StateView<const uint8_t>& from, const StateView<uint8_t>& to) {
  const uint8_t* source = reinterpret_cast<const uint8_t*>(&from.header);
  uint8_t* target = reinterpret_cast<uint8_t*>(&to.header);
  const UsedCounts now = used_counts(from), before = used_counts(const_view_of(target));
  for (uint32_t i = 1; i < k_section_count; ++i) {
    const Section& section = k_sections[i];
    memcpy(target + to.layout.*section.offset, source + from.layout.*section.offset, now.of[i] * section.element_bytes);
  }
  clear_unused(to, before, now);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
