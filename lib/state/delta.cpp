#include <detent/rollback.h>
#include <string.h>

#include "base/bytes.h"
#include "state/fields.h"
#include "state/snapshot.h"
#include "state/view.h"

// Format: a header of three 8-byte words (magic and format, tick of the base snapshot, size of the snapshot in bytes),
// then the 8-byte words after the snapshot's header in order. A word that differs from the base is stored as a mask of
// its differing bytes, followed by the new values of these bytes. A run of words that are equal to the base is stored
// as an empty mask, followed by the number of words; a run at the end is left out.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_delta_magic = 0x4c444e44;  // "DNDL" in canonical bytes
constexpr uint32_t k_delta_format = 1;
constexpr uint32_t k_tick_offset = sizeof(BlockHeader) + __builtin_offsetof(WorldState, tick);
constexpr uint32_t k_piece = 256;  ///< bytes of a snapshot converted at a time on big-endian machines

void store_u64(uint8_t* bytes, uint64_t value) {
  if (k_big_endian) value = __builtin_bswap64(value);
  memcpy(bytes, &value, sizeof value);
}

struct DeltaWriter {
  uint8_t* bytes;
  uint32_t capacity;
  uint32_t count = 0;
  bool full = false;

  void put(uint8_t byte) {
    if (count == capacity) {
      full = true;
      return;
    }
    bytes[count++] = byte;
  }
  void put_number(uint32_t value) {
    for (; value >= 128; value >>= 7) put(static_cast<uint8_t>(value | 128));
    put(static_cast<uint8_t>(value));
  }
  /// Writes the mask of the bytes in which a word differs from the base, then these bytes.
  void put_word(const uint8_t* word, uint64_t difference) {
    uint8_t made[9];
    uint32_t size = 1, mask = 0;
    for (uint32_t i = 0; i < 8; ++i) {  // a byte that does not differ is overwritten by the next byte
      const uint32_t differs = (difference >> (8 * i) & 255) != 0 ? 1 : 0;
      mask |= differs << i;
      made[size] = word[i];
      size += differs;
    }
    made[0] = static_cast<uint8_t>(mask);
    if (size > capacity - count) {
      full = true;
      return;
    }
    for (uint32_t i = 0; i < size; ++i) bytes[count + i] = made[i];
    count += size;
  }
};

/// Compares the canonical (little-endian) bytes of the state with those of the base snapshot, word by word. add()
/// receives them piece by piece. The output does not depend on the sizes of the pieces.
struct Differ {
  DeltaWriter& writer;
  uint32_t same = 0;  ///< number of equal words since the last word that differs

  void add(const uint8_t* now, const uint8_t* base, uint32_t bytes) {
    for (const uint8_t* const end = now + bytes; now != end; now += 8, base += 8) {
      const uint64_t difference = load_u64(now) ^ load_u64(base);
      if (difference == 0) {
        ++same;
        continue;
      }
      if (same != 0) {
        writer.put(0);
        writer.put_number(same);
        same = 0;
      }
      writer.put_word(now, difference);
    }
  }
};

/// Reads the entries of a delta: the bytes after its header.
struct DeltaReader {
  const uint8_t* bytes;
  uint32_t left;

  bool get(uint8_t& byte) {
    if (left == 0) return false;
    byte = *bytes++;
    --left;
    return true;
  }
  bool get_number(uint32_t& value) {
    value = 0;
    for (uint32_t shift = 0; shift < 35; shift += 7) {
      uint8_t byte = 0;
      if (!get(byte) || (shift == 28 && byte > 15)) return false;
      value |= uint32_t{byte & 127u} << shift;
      if (byte < 128) return true;
    }
    return false;
  }
};

/// Reads all entries of a delta. Writes the bytes that differ to `bytes`, unless `bytes` is null. Words after the last
/// entry do not differ. Returns false if an entry is malformed, or if the entries cover more than `words` words.
bool read_words(DeltaReader reader, uint32_t words, uint8_t* bytes) {
  for (uint32_t at = 0; reader.left != 0;) {
    uint8_t mask = 0;
    reader.get(mask);
    if (mask == 0) {
      uint32_t same = 0;
      if (!reader.get_number(same) || same == 0 || same > words - at) return false;
      at += same;
      continue;
    }
    if (at == words) return false;
    for (uint32_t i = 0; i < 8; ++i) {
      if ((mask >> i & 1) == 0) continue;
      uint8_t byte = 0;
      if (!reader.get(byte)) return false;
      if (bytes != nullptr) bytes[8 * at + i] = byte;
    }
    ++at;
  }
  return true;
}

/// Applies a delta to `snapshot`, the base. If `snapshot` is null, only checks whether the delta fits a snapshot of
/// this size.
bool apply_words(uint8_t* snapshot, uint32_t snapshot_size, const uint8_t* delta, uint32_t delta_bytes) {
  constexpr uint32_t k_head = sizeof(BlockHeader);
  return read_words({delta + k_delta_header_bytes, delta_bytes - k_delta_header_bytes}, (snapshot_size - k_head) / 8,
                    snapshot == nullptr ? nullptr : snapshot + k_head);
}

/// Checks that `delta` is a delta, and that it was made from this base.
Status check_delta(const uint8_t* base, uint32_t base_bytes, const uint8_t* delta, uint32_t delta_bytes) {
  if (base == nullptr || base_bytes < sizeof(BlockHeader) + sizeof(WorldState)) return Status::truncated;
  if (delta == nullptr || delta_bytes < k_delta_header_bytes) return Status::truncated;
  const uint64_t mark = load_u64(delta);
  if (static_cast<uint32_t>(mark) != k_delta_magic) return Status::not_detent;
  if (mark >> 32 != k_delta_format) return Status::format_unknown;
  if (load_u64(delta + 16) != base_bytes || base_bytes % 8 != 0) return Status::capacity_differs;
  if (load_u64(delta + 8) != load_u64(base + k_tick_offset)) return Status::bad_argument;
  return apply_words(nullptr, base_bytes, delta, delta_bytes) ? Status::ok : Status::corrupt;
}

/// Checks that `base` is a snapshot from which the world can be restored.
Status check_base(const World& world, const uint8_t* base, uint32_t base_bytes) {
  const StateView<const uint8_t> state = view_of(world);
  if (base == nullptr || base_bytes < sizeof(BlockHeader)) return Status::truncated;
  const Status status = check_canonical_header(base, capacity_of(state.header), *world.features);
  if (status != Status::ok) return status;
  return base_bytes < state.layout.persistent_bytes ? Status::truncated : Status::ok;
}

}  // namespace

static_assert(sizeof(BlockHeader) % 8 == 0 && k_tick_offset % 8 == 0 && k_piece % 8 == 0);

Status save_delta(const World& world, const uint8_t* base, uint32_t base_bytes, uint8_t* delta, uint32_t delta_capacity,
                  uint32_t& bytes) {
  if (const Status status = check_base(world, base, base_bytes); status != Status::ok) return status;
  if (delta == nullptr || delta_capacity < k_delta_header_bytes) return Status::buffer_too_small;
  const uint32_t total = view_of(world).layout.persistent_bytes;
  store_u64(delta, uint64_t{k_delta_format} << 32 | k_delta_magic);
  memcpy(delta + 8, base + k_tick_offset, 8);
  store_u64(delta + 16, total);
  DeltaWriter writer{delta, delta_capacity, k_delta_header_bytes};
  Differ differ{writer};
  constexpr uint32_t k_head = sizeof(BlockHeader);
  if (!k_big_endian) {
    differ.add(world.block + k_head, base + k_head, total - k_head);
  } else {
    uint8_t piece[k_piece];
    for (uint32_t at = k_head; at < total; at += k_piece) {
      const uint32_t count = total - at < k_piece ? total - at : k_piece;
      snapshot_read(world, at, piece, count);
      differ.add(piece, base + at, count);
    }
  }
  if (writer.full) return Status::buffer_too_small;
  bytes = writer.count;
  return Status::ok;
}

Status apply_delta(uint8_t* base, uint32_t base_bytes, const uint8_t* delta, uint32_t delta_bytes) {
  const Status status = check_delta(base, base_bytes, delta, delta_bytes);
  if (status == Status::ok) apply_words(base, base_bytes, delta, delta_bytes);
  return status;
}

Status restore_delta(World& world, const uint8_t* base, uint32_t base_bytes, const uint8_t* delta,
                     uint32_t delta_bytes) {
  if (const Status status = check_base(world, base, base_bytes); status != Status::ok) return status;
  const Layout layout = view_of(world).layout;
  const uint32_t total = layout.persistent_bytes;
  if (const Status status = check_delta(base, total, delta, delta_bytes); status != Status::ok) return status;
  memcpy(world.block, base, total);
  apply_words(world.block, total, delta, delta_bytes);
  swap_state(world.block, layout);
  take_over(world);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
