#pragma once
#include "state/fields.h"
#include "state/view.h"

/// What of a state is in use. All else is zero, so a copy may leave it out.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Elements of each section, from its front.
struct UsedCounts {
  uint32_t of[k_section_count];
};

/// `assets`: how many bound assets have to be looked at.
UsedCounts used_counts(const WorldState& world, uint32_t assets, bool has_manifolds);
UsedCounts used_counts(const StateView<const uint8_t>& state);

uint32_t used_assets(const StateView<const uint8_t>& state);

/// Makes what was in use before and is no longer zero.
void clear_unused(const StateView<uint8_t>& state, const UsedCounts& before, const UsedCounts& now);

/// Copies all but the header and what is not in use. `to` holds a state, whose rest becomes zero. The room must
/// suffice.
void copy_used(const StateView<const uint8_t>& from, const StateView<uint8_t>& to);

inline StateView<const uint8_t> const_view_of(const uint8_t* block) {
  return view_of(block, capacity_of(*at_offset<BlockHeader>(block, 0)));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
