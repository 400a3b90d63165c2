#pragma once
#include "world/fields.h"
#include "world/view.h"

/// What of a state is in use. All else is zero, so a copy may leave it out.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Elements of each section, from its front.
struct UsedCounts {
  uint32_t of[k_section_count];
};
UsedCounts used_counts(const StateView<const uint8_t>& state);

/// How many bound assets have to be looked at.
uint32_t used_assets(const StateView<const uint8_t>& state);

/// Bytes in use, the header's included.
uint32_t used_bytes(const StateView<const uint8_t>& state);

/// Copies all but the header and what is not in use. `clear`: `to` holds a state, whose rest becomes zero.
/// The room must suffice.
void copy_used(const StateView<const uint8_t>& from, const StateView<uint8_t>& to, bool clear);

inline StateView<const uint8_t> const_view_of(const uint8_t* block) {
  return view_of(block, capacity_of(*at_offset<BlockHeader>(block, 0)));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
