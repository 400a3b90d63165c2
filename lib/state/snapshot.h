#pragma once
#include <detent/detail/layout.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The canonical bytes [offset, offset + count) of the world's snapshot, for writers that cannot hold all of it.
/// False if they reach beyond its end.
bool snapshot_read(const World& world, uint32_t offset, uint8_t* bytes, uint32_t count);

/// Makes a new world of this capacity, which must be the world's, of whatever its block holds: its settings are their
/// defaults. What the caller has bound to the handle stays.
Status empty_world(World& world, Capacity capacity);

/// As `load`, from a reader of the canonical bytes, straight into the world's block. On failure the world is left
/// empty. `read` gives all of the bytes [offset, offset + count) or another status than ok.
Status load_from(World& world, Status (*read)(void* context, uint32_t offset, uint8_t* bytes, uint32_t count),
                 void* context);

/// Checks persistent state in the machine's byte order: every value in its range and consistent with the rest, so that
/// no call on it can misbehave. Errors: as `load`.
Status check_state(const uint8_t* block, Capacity capacity, AssetTable assets, const FeatureTable& features,
                   const FilterRuleTable& rules);

/// Compares a header in the machine's byte order with this build and the world that is to take the state.
Status check_header(const BlockHeader& header, Capacity capacity, const FeatureTable& features);
/// As check_header, for canonical bytes.
Status check_canonical_header(const uint8_t* bytes, Capacity capacity, const FeatureTable& features);

/// Between the machine's byte order and the canonical one, in place. Nothing to do on little-endian machines.
void swap_state(uint8_t* block, const Layout& layout);

/// What the block now holds is the state of another world, which may have had fewer features.
void take_over(World& world);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
