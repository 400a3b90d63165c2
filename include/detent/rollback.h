#pragma once
#include <detent/world.h>

/// @file
/// World states for rollback: copies between worlds, differences of snapshots, and a ring of the last ticks. Nothing
/// here allocates. rollback_session.h builds sessions on it; see docs/rollback.md.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Copies the state of `from` to `to`; their capacities may differ. Afterwards both have the same digest, and step
/// identically as long as neither runs out of room. The handle of `to` (event buffers, assets, rules, features) stays.
/// Errors, each before `to` is changed: pool_full (`to` has no room for the state in use), feature_missing,
/// asset_missing, asset_mismatch, rule_missing.
Status copy_world(const World& from, World& to);

/// The digest folded to 32 bits (high half xor low half). Players exchange it to check that their worlds agree.
uint32_t checksum32(const World& world);

/// Largest size of the difference of two snapshots of this capacity, bytes; 0 if the capacity is out of range.
constexpr uint32_t delta_bytes_max(Capacity capacity);
/// Writes the difference between `base`, an earlier snapshot of this world by save(), and the world as it is now. The
/// same bytes on every target (SPEC.md, "Delta"). `bytes`: how many were written, at most `delta_capacity`.
/// Errors: those of restore(), for the base; buffer_too_small, after which the content of `delta` is unspecified.
Status save_delta(const World& world, const uint8_t* base, uint32_t base_bytes, uint8_t* delta, uint32_t delta_capacity,
                  uint32_t& bytes);
/// Restores the state from which this program wrote `delta`, with the same base.
/// Errors: those of restore() and apply_delta().
Status restore_delta(World& world, const uint8_t* base, uint32_t base_bytes, const uint8_t* delta,
                     uint32_t delta_bytes);
/// Turns the base, in place, into the snapshot from which the delta was written. The delta may come from an untrusted
/// source: every length and offset is checked before the base is changed; let load() check the resulting snapshot.
/// Errors: truncated, not_detent, format_unknown, capacity_differs (a base of another size), bad_argument (a base of
/// another tick), corrupt.
Status apply_delta(uint8_t* base, uint32_t base_bytes, const uint8_t* delta, uint32_t delta_bytes);

/// Bytes of memory of a SnapshotRing; 0 if an argument is out of range.
constexpr uint32_t snapshot_ring_bytes(Capacity capacity, uint32_t ticks);

/// The last ticks of a world, in the caller's memory: tick t has place t modulo the number of ticks. A place has room
/// for any state of the capacity; only the part in use is written, without most of its zeros. The bytes are in the
/// machine's byte order, for this program only.
class SnapshotRing {
 public:
  /// Makes room for `ticks` ticks of worlds of this capacity. `memory`: 8-byte aligned, at least snapshot_ring_bytes()
  /// bytes; only the ring may use it as long as the ring is in use.
  /// Errors: out_of_range, buffer_too_small, buffer_misaligned.
  Status begin(uint8_t* memory, uint32_t memory_bytes, Capacity capacity, uint32_t ticks);
  /// Stores the current state of the world under its tick; it replaces the tick that had this place. Errors:
  /// bad_argument (not begun), capacity_differs.
  Status keep(const World& world);
  /// Restores the world's state after `tick` ticks, and drops all later ticks.
  /// Errors: out_of_range (the ring does not have this tick), bad_argument (not begun), capacity_differs,
  /// feature_missing.
  Status restore(World& world, uint64_t tick);
  /// Whether the ring has this tick.
  bool holds(uint64_t tick) const;

 private:
  uint8_t* place(uint64_t tick) const { return memory_ + static_cast<uint32_t>(tick % ticks_) * place_bytes_; }

  uint8_t* memory_ = nullptr;
  uint32_t place_bytes_ = 0;
  uint32_t ticks_ = 0;
  Capacity capacity_ = {};
};

/// @cond
// Internal.
inline constexpr uint32_t k_delta_header_bytes = 24;
/// @endcond

constexpr uint32_t delta_bytes_max(Capacity capacity) {
  // Worst case: every word of eight bytes differs, and has one byte of mask before it. An equal word takes no more.
  const uint64_t bytes = k_delta_header_bytes + uint64_t{snapshot_bytes(capacity)} / 8 * 9;
  return snapshot_bytes(capacity) == 0 || bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}

/// @cond
// Largest size of a packed state (lib/state/packed_state.h): the snapshot, a count, and a byte for each element that
// has optional parts.
constexpr uint32_t packed_bytes_max(Capacity capacity) {
  const uint64_t more = 4 + uint64_t{capacity.bodies} + capacity.contacts + manifold_count(capacity);
  const uint64_t bytes = (snapshot_bytes(capacity) + more + 7) / 8 * 8;
  return snapshot_bytes(capacity) == 0 || bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}
/// @endcond

constexpr uint32_t snapshot_ring_bytes(Capacity capacity, uint32_t ticks) {
  const uint64_t bytes = uint64_t{packed_bytes_max(capacity)} * ticks;
  return bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
