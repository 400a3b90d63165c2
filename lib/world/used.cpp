#include "world/used.h"

#include <string.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

UsedCounts used_counts(const StateView<const uint8_t>& state) {
  const WorldState& world = state.world;
  const uint32_t slots = world.slots_used;
  return {{1, 1, slots, slots, slots, slots, (slots + 31) / 32, world.contact_count, used_assets(state),
           state.manifolds.count == 0 ? 0 : world.contact_count, world.joints_used, world.sensed_count}};
}

uint32_t used_assets(const StateView<const uint8_t>& state) {
  uint32_t count = state.assets.count;
  while (count != 0 && state.assets[count - 1].kind == 0) --count;
  return count;
}

uint32_t used_bytes(const StateView<const uint8_t>& state) {
  const UsedCounts counts = used_counts(state);
  uint32_t bytes = 0;
  for (uint32_t i = 0; i < k_section_count; ++i) bytes += counts.of[i] * k_sections[i].element_bytes;
  return bytes;
}

void copy_used(const StateView<const uint8_t>& from, const StateView<uint8_t>& to, bool clear) {
  const uint8_t* source = reinterpret_cast<const uint8_t*>(&from.header);
  uint8_t* target = reinterpret_cast<uint8_t*>(&to.header);
  const UsedCounts now = used_counts(from);
  const UsedCounts before = clear ? used_counts(const_view_of(target)) : UsedCounts{};
  for (uint32_t i = 1; i < k_section_count; ++i) {
    const Section& section = k_sections[i];
    uint8_t* const first = target + to.layout.*section.offset;
    memcpy(first, source + from.layout.*section.offset, now.of[i] * section.element_bytes);
    if (before.of[i] <= now.of[i]) continue;
    memset(first + now.of[i] * section.element_bytes, 0, (before.of[i] - now.of[i]) * section.element_bytes);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
