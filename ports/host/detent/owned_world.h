#pragma once
#include <detent/world.h>

#include <memory>
#include <new>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A world in memory of its own; `block` is null if there is not enough.
struct OwnedWorld {
  std::unique_ptr<uint64_t[]> block;
  World world;

  Status create(const WorldDef& def, const AssetTable& assets) {
    const uint32_t bytes = world_bytes(def.capacity);
    if (bytes == 0) return Status::out_of_range;
    block.reset(new (std::nothrow) uint64_t[(bytes + 7) / 8]);
    if (block == nullptr) return Status::buffer_too_small;
    return create_world(reinterpret_cast<uint8_t*>(block.get()), bytes, def, assets, world);
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
