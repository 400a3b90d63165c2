#pragma once
#include <detent/world.h>

/// @file
/// The state of a world as rollback needs it: copies between worlds, differences of snapshots, and the last ticks in a
/// ring. Nothing here allocates. rollback_session.h makes a session of it; docs/rollback.md.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Gives `to` the state of `from`, also where their capacities differ: both then have the same digest, and step alike
/// as long as neither runs out of room. The handle of `to` (event buffers, assets, rules, features) stays.
/// Errors, each before `to` is touched: pool_full (`to` has no room for what is in use), feature_missing,
/// asset_missing, asset_mismatch, rule_missing.
Status copy_world(const World& from, World& to);

/// The digest folded to 32 bits, high half over low half: what players exchange to see that their worlds agree.
uint32_t checksum32(const World& world);

/// Bytes that the difference of two snapshots of this capacity has at most; 0 if the capacity is out of range.
constexpr uint32_t delta_bytes_max(Capacity capacity);
/// What turns `base`, an earlier snapshot that save() made of this world, into a snapshot of the world as it is now.
/// The same bytes on every target (SPEC.md, "Delta"). `bytes`: how many were written of the `delta_capacity` that
/// there is room for.
/// Errors: those of restore(), for the base; buffer_too_small, after which the content of `delta` is unspecified.
Status save_delta(const World& world, const uint8_t* base, uint32_t base_bytes, uint8_t* delta, uint32_t delta_capacity,
                  uint32_t& bytes);
/// Puts back the state that this program made `delta` of, against the same base.
/// Errors: those of restore() and apply_delta().
Status restore_delta(World& world, const uint8_t* base, uint32_t base_bytes, const uint8_t* delta,
                     uint32_t delta_bytes);
/// Turns the base, in place, into the snapshot that the delta was made of. For bytes from outside: every length and
/// offset is checked before the base is touched, and load() checks what comes of it.
/// Errors: truncated, not_detent, format_unknown, capacity_differs (a base of another size), bad_argument (a base of
/// another tick), corrupt.
Status apply_delta(uint8_t* base, uint32_t base_bytes, const uint8_t* delta, uint32_t delta_bytes);

/// Bytes of a SnapshotRing; 0 if an argument is out of range.
constexpr uint32_t snapshot_ring_bytes(Capacity capacity, uint32_t ticks);

/// The last ticks of a world, in the caller's memory: tick t lies in place t modulo their number. A place has room for
/// any state of the capacity; what is written of it is what is in use, without most of its zeros, in the machine's byte
/// order: for this program alone.
class SnapshotRing {
 public:
  /// Room for `ticks` ticks of worlds of this capacity. `memory`: 8-byte aligned, at least snapshot_ring_bytes(), for
  /// the ring alone as long as it is used.
  /// Errors: out_of_range, buffer_too_small, buffer_misaligned.
  Status begin(uint8_t* memory, uint32_t memory_bytes, Capacity capacity, uint32_t ticks);
  /// Keeps the world as it is, under its tick, in place of whatever was there. Errors: bad_argument (not begun),
  /// capacity_differs.
  Status keep(const World& world);
  /// Puts back the world as it was after `tick` ticks, and drops all later ones.
  /// Errors: out_of_range (not kept, or no longer), bad_argument (not begun), capacity_differs, feature_missing.
  Status restore(World& world, uint64_t tick);
  /// Whether `restore` would find this tick.
  bool holds(uint64_t tick) const;

 private:
  uint8_t* place(uint64_t tick) const { return memory_ + static_cast<uint32_t>(tick % ticks_) * place_bytes_; }

  uint8_t* memory_ = nullptr;
  uint32_t place_bytes_ = 0;
  uint32_t ticks_ = 0;
  Capacity capacity_ = {};
};

/// @cond
// The library's own.
inline constexpr uint32_t k_delta_header_bytes = 24;
/// @endcond

constexpr uint32_t delta_bytes_max(Capacity capacity) {
  // At worst every word of eight bytes differs, each behind its mask; one that does not takes no more than that.
  const uint64_t bytes = k_delta_header_bytes + uint64_t{snapshot_bytes(capacity)} / 8 * 9;
  return snapshot_bytes(capacity) == 0 || bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}

/// @cond
// Of a state that is packed (lib/state/packed_state.h): a count, and a byte for each element with parts that may be
// left out.
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
