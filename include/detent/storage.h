#pragma once
#include <detent/detail/layout.h>

/// @file
/// The memory of a world. world.h includes it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Memory for a world whose capacity is known at compile time.
template <Capacity capacity>
struct WorldStorage {
  static constexpr uint32_t k_bytes = world_bytes(capacity);  ///< size of the block
  static_assert(k_bytes != 0, "detent: capacity out of range");
  alignas(8) uint8_t block[k_bytes];  ///< the world's memory; nothing else may write to it

  /// As create_world, in this block and with this capacity; `def.capacity` is ignored.
  Status create(WorldDef def, const WorldHooks& hooks, const FeatureTable& features, World& world) {
    def.capacity = capacity;
    return create_world(block, k_bytes, def, hooks, features, world);
  }
  /// The same with all features.
  Status create(const WorldDef& def, const WorldHooks& hooks, World& world) {
    return create(def, hooks, feature_table<Features::all>, world);
  }
  /// The same without hooks.
  Status create(const WorldDef& def, World& world) { return create(def, {}, world); }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
