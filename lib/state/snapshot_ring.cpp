#include <detent/rollback.h>
#include <string.h>

#include "state/packed_state.h"
#include "state/snapshot.h"

// Each place of the ring holds one packed state. While a place is empty, the magic in its header is 0.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BlockHeader& header_of(uint8_t* place) { return *at_offset<BlockHeader>(place, 0); }
uint64_t tick_of(const uint8_t* place) { return at_offset<WorldState>(place, sizeof(BlockHeader))->tick; }

}  // namespace

Status SnapshotRing::begin(uint8_t* memory, uint32_t memory_bytes, Capacity capacity, uint32_t ticks) {
  const uint32_t bytes = snapshot_ring_bytes(capacity, ticks);
  if (bytes == 0) return Status::out_of_range;
  if (memory == nullptr || memory_bytes < bytes) return Status::buffer_too_small;
  if (reinterpret_cast<uintptr_t>(memory) % 8 != 0) return Status::buffer_misaligned;
  memory_ = memory;
  place_bytes_ = packed_bytes_max(capacity);
  ticks_ = ticks;
  capacity_ = capacity;
  for (uint32_t i = 0; i < ticks; ++i) header_of(place(i)).magic = 0;
  return Status::ok;
}

bool SnapshotRing::holds(uint64_t tick) const {
  if (memory_ == nullptr) return false;
  return header_of(place(tick)).magic != 0 && tick_of(place(tick)) == tick;
}

Status SnapshotRing::keep(const World& world) {
  if (memory_ == nullptr) return Status::bad_argument;
  const StateView<const uint8_t> state = view_of(world);
  if (!(capacity_of(state.header) == capacity_)) return Status::capacity_differs;
  pack_state(state, place(state.world.tick));
  return Status::ok;
}

Status SnapshotRing::restore(World& world, uint64_t tick) {
  if (memory_ == nullptr) return Status::bad_argument;
  if (!holds(tick)) return Status::out_of_range;
  const StateView<uint8_t> state = view_of(world);
  const Status status = check_header(header_of(place(tick)), capacity_of(state.header), *world.features);
  if (status != Status::ok) return status;
  unpack_state(place(tick), state);
  take_over(world);
  for (uint32_t i = 0; i < ticks_; ++i) {
    if (header_of(place(i)).magic != 0 && tick_of(place(i)) > tick) header_of(place(i)).magic = 0;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
