#pragma once
#include "state/fields.h"
#include "state/view.h"

/// The elements of a state that are in use. All other elements are zero, so a copy can leave them out.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The number of used elements of each section, from its front.
struct UsedCounts {
  uint32_t of[k_section_count];
};

/// Computes the number of used elements of each section. `assets`: the result of used_assets().
UsedCounts used_counts(const WorldState& world, uint32_t assets, bool has_manifolds);
UsedCounts used_counts(const StateView<const uint8_t>& state);

/// The number of asset entries up to and including the last bound one.
uint32_t used_assets(const StateView<const uint8_t>& state);

/// Sets to zero the elements that `before` counts as used, but `now` does not.
void clear_unused(const StateView<uint8_t>& state, const UsedCounts& before, const UsedCounts& now);

/// Copies the used elements of all sections except the header. Range: `to` holds a valid state and has enough capacity.
/// The remaining elements of `to` become zero.
void copy_used(const StateView<const uint8_t>& from, const StateView<uint8_t>& to);

inline StateView<const uint8_t> const_view_of(const uint8_t* block) {
  return view_of(block, capacity_of(*at_offset<BlockHeader>(block, 0)));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
