#include "base/digest.h"

#include "state/fields.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint64_t k_world_seed = 0x646574656e74u;

/// The digest of one element's canonical bytes, seeded by its section and index. It is 0 for an element of zeros, so
/// that unused capacity does not change the digest.
uint64_t leaf(const Section& section, uint32_t section_index, const uint8_t* element, uint32_t bytes, uint32_t index) {
  uint64_t any = 0;
  uint32_t at = 0;
  for (; at + 8 <= bytes; at += 8) any |= load_u64(element + at);
  for (; at < bytes; ++at) any |= element[at];
  if (any == 0) return 0;
  const uint64_t seed = digest_step(digest_step(k_world_seed, section_index), index);
  if (!k_big_endian) return digest_bytes(element, bytes, seed);
  uint8_t canonical[k_element_bytes_max];
  memcpy(canonical, element, bytes);
  if (bytes == section.element_bytes) swap_element(section_index, canonical);
  return digest_bytes(canonical, bytes, seed);
}

}  // namespace

uint64_t digest(const World& world) {
  const StateView<const uint8_t> state = view_of(world);
  uint64_t running = digest_step(k_world_seed, static_cast<uint64_t>(k_config));
  for (uint32_t i = 1; i < k_section_count; ++i) {  // section 0 is the header, which the digest does not cover
    const Section& section = k_sections[i];
    const uint8_t* element = world.block + state.layout.*section.offset;
    const uint32_t bytes = section_bytes(state.layout, i);
    const uint32_t count = bytes / section.element_bytes;
    uint64_t sum = 0;
    for (uint32_t index = 0; index < count; ++index, element += section.element_bytes) {
      sum += leaf(section, i, element, section.element_bytes, index);
    }
    // The fill up to the next array; it is zero.
    sum += leaf(section, i, element, bytes % section.element_bytes, count);
    running = digest_step(running, sum);
  }
  return digest_finish(running);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
