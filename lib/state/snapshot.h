#pragma once
#include <detent/detail/layout.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Reads the canonical (little-endian) bytes [offset, offset + count) of the world's snapshot, for a writer that has no
/// buffer for the whole snapshot. Returns false if the range extends beyond the end of the snapshot.
bool snapshot_read(const World& world, uint32_t offset, uint8_t* bytes, uint32_t count);

/// Replaces the contents of the block by a new empty world with default settings; continuous collision and sleeping are
/// off if their features are not linked. `capacity` must be that of the world. World::hooks does not change.
Status empty_world(World& world, Capacity capacity);

/// As `load`, but reads the canonical (little-endian) bytes with `read`, directly into the world's block. On failure
/// the world is left empty. `read` supplies all bytes [offset, offset + count) or returns a status other than ok.
Status load_from(World& world, Status (*read)(void* context, uint32_t offset, uint8_t* bytes, uint32_t count),
                 void* context);

/// Checks a persistent state in the machine's byte order. Every value must be in its range and consistent with the
/// other values, so that every call on this state is safe. Errors: as `load`.
Status check_state(const uint8_t* block, Capacity capacity, AssetTable assets, const FeatureTable& features,
                   const FilterRuleTable& rules);

/// Compares a header in the machine's byte order with this build and with the capacity and features of the receiving
/// world.
Status check_header(const BlockHeader& header, Capacity capacity, const FeatureTable& features);
/// As check_header(), for the canonical (little-endian) bytes of a header.
Status check_canonical_header(const uint8_t* bytes, Capacity capacity, const FeatureTable& features);

/// Converts a persistent state between the machine's byte order and the canonical one (little-endian), in place. Does
/// nothing on little-endian machines.
void swap_state(uint8_t* block, const Layout& layout);

/// Must be called after a state of another world was copied into the block. Sets BlockHeader::left_out for the features
/// of `world`, because the other world may have had fewer features. Invalidates the step cache.
void take_over(World& world);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
