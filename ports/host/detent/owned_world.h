#pragma once
#include <detent/world.h>

#include <chrono>
#include <memory>
#include <new>

/// Shared by the engine's files, in each configuration.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A world with memory of its own; `block` is null if there is not enough memory.
struct OwnedWorld {
  std::unique_ptr<uint64_t[]> block;
  World world;

  Status create(const WorldDef& def, const AssetTable& assets) {
    const uint32_t bytes = world_bytes(def.capacity);
    if (bytes == 0) return Status::out_of_range;
    block.reset(new (std::nothrow) uint64_t[(bytes + 7) / 8]);
    if (block == nullptr) return Status::buffer_too_small;
    return create_world(reinterpret_cast<uint8_t*>(block.get()), bytes, def, {.assets = assets}, world);
  }
};

struct Stopwatch {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
};

inline constexpr uint32_t k_ticks_per_progress = 16;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
