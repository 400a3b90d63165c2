#pragma once
#include <detent/asset.h>
#include <detent/status.h>

#include "base/bytes.h"

/// The common parts of all cooked formats: little-endian integers, and a header that begins with a magic of 8 bytes,
/// the format's version, the count of all bytes and a checksum.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_cooked_version_at = 8;
inline constexpr uint32_t k_cooked_byte_count_at = 12;
inline constexpr uint32_t k_cooked_checksum_at = 16;  ///< CRC-32 of all bytes except these four

inline bool is_in(const AssetTable& table, uint32_t index) {
  return index < table.count && table.assets[index].bytes != nullptr;
}

/// The little-endian integer at `bytes`. Range: `bytes` is aligned to the integer's size.
inline uint32_t cooked_u32(const uint8_t* bytes) {
  uint32_t value;
  memcpy(&value, __builtin_assume_aligned(bytes, 4), sizeof value);
  return k_big_endian ? __builtin_bswap32(value) : value;
}
inline int32_t cooked_i32(const uint8_t* bytes) { return static_cast<int32_t>(cooked_u32(bytes)); }
inline uint32_t cooked_u16(const uint8_t* bytes) {
  uint16_t value;
  memcpy(&value, __builtin_assume_aligned(bytes, 2), sizeof value);
  return k_big_endian ? __builtin_bswap16(value) : value;
}
inline int32_t cooked_i16(const uint8_t* bytes) { return static_cast<int16_t>(cooked_u16(bytes)); }

/// Reads the frame of the body in the source frame, that is, the axes of the data before cooking: the origin (three
/// doubles, m) and the rotation (a quaternion, Q30).
inline void read_source_frame(const uint8_t* origin_bytes, const uint8_t* rotation_bytes, double (&origin)[3],
                              int32_t (&rotation)[4]) {
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint64_t bits = load_u64(origin_bytes + 8 * axis);
    memcpy(&origin[axis], &bits, sizeof bits);
  }
  for (uint32_t k = 0; k < 4; ++k) rotation[k] = cooked_i32(rotation_bytes + 4 * k);
}

/// The squared length of a unit vector or unit quaternion, Q60, and the tolerance of this square. The rounding of four
/// components changes it by about 2^31.
inline constexpr uint64_t k_one_squared = uint64_t{1} << 60;
inline constexpr uint64_t k_unit_vector_slack = uint64_t{1} << 32;

constexpr uint32_t align_8(uint32_t bytes) { return (bytes + 7) / 8 * 8; }

/// Whether the bytes from `from` up to `to` are zero.
bool cooked_is_zero(const uint8_t* bytes, uint32_t from, uint32_t to);

/// Checks the alignment, the magic, the version, the count of bytes and the checksum. If the function returns ok, the
/// first `header_bytes` bytes may be read. Range: header_bytes > 20. Errors: buffer_misaligned (8), not_detent,
/// format_unknown, truncated, corrupt.
Status check_cooked(const Asset& asset, const uint8_t (&magic)[8], uint32_t version, uint32_t header_bytes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
