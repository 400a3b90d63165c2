#include <detent/rollback.h>
#include <string.h>

#include "world/snapshot.h"
#include "world/used.h"

// A place holds the front of a block: a header, whose magic is 0 while nothing is kept, and each array at its offset.

namespace detent {
inline namespace DETENT_NAMESPACE {

Status SnapshotRing::begin(uint8_t* memory, uint32_t memory_bytes, Capacity capacity, uint32_t ticks) {
  const uint32_t bytes = snapshot_ring_bytes(capacity, ticks);
  if (bytes == 0) return Status::out_of_range;
  if (memory == nullptr || memory_bytes < bytes) return Status::buffer_too_small;
  if (reinterpret_cast<uintptr_t>(memory) % 8 != 0) return Status::buffer_misaligned;
  memory_ = memory;
  place_bytes_ = snapshot_bytes(capacity);
  ticks_ = ticks;
  capacity_ = capacity;
  for (uint32_t i = 0; i < ticks; ++i) at_offset<BlockHeader>(place(i), 0)->magic = 0;
  return Status::ok;
}

bool SnapshotRing::holds(uint64_t tick) const {
  if (memory_ == nullptr) return false;
  const uint8_t* block = place(tick);
  return at_offset<BlockHeader>(block, 0)->magic != 0 && view_of(block, capacity_).world.tick == tick;
}

Status SnapshotRing::keep(const World& world) {
  if (memory_ == nullptr) return Status::bad_argument;
  const StateView<const uint8_t> state = view_of(world);
  if (!(capacity_of(state.header) == capacity_)) return Status::capacity_differs;
  uint8_t* const block = place(state.world.tick);
  *at_offset<BlockHeader>(block, 0) = state.header;
  copy_used(state, view_of(block, capacity_), false);
  return Status::ok;
}

Status SnapshotRing::restore(World& world, uint64_t tick) {
  if (memory_ == nullptr) return Status::bad_argument;
  if (!holds(tick)) return Status::out_of_range;
  const StateView<const uint8_t> kept = const_view_of(place(tick));
  const StateView<uint8_t> state = view_of(world);
  const Status status = check_header(kept.header, capacity_of(state.header), *world.features);
  if (status != Status::ok) return status;
  copy_used(kept, state, true);
  take_over(world);
  for (uint32_t i = 0; i < ticks_; ++i) {
    const StateView<uint8_t> other = view_of(place(i), capacity_);
    if (other.header.magic != 0 && other.world.tick > tick) other.header.magic = 0;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
