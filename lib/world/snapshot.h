#pragma once
#include <detent/world.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The canonical bytes [offset, offset + count) of the world's snapshot, for writers that cannot hold all of it.
/// False if they reach beyond its end.
bool snapshot_read(const World& world, uint32_t offset, uint8_t* bytes, uint32_t count);

/// As `load`, from a reader of the canonical bytes, straight into the world's block. On failure the world is left
/// empty, with its settings at their defaults. `read` gives all of the bytes [offset, offset + count) or another status
/// than ok.
Status load_from(World& world, Status (*read)(void* context, uint32_t offset, uint8_t* bytes, uint32_t count),
                 void* context);

/// Checks persistent state in the machine's byte order: every value in its range and consistent with the rest, so that
/// no call on it can misbehave. Errors: as `load`.
Status check_state(const uint8_t* block, Capacity capacity, AssetTable assets, const FeatureTable& features,
                   const FilterRuleTable& rules);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
