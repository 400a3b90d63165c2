#pragma once
#include <detent/config.h>
#include <string.h>

/// Conversion of canonical bytes, which are little-endian. No other file tests the machine's byte order.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr bool k_big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

/// The little-endian integer at `bytes`, at any alignment.
inline uint64_t load_u64(const uint8_t* bytes) {
  uint64_t value;
  memcpy(&value, bytes, sizeof value);
  return k_big_endian ? __builtin_bswap64(value) : value;
}

/// Reverses each of the `count` words of `width` bytes (1, 2, 4 or 8) at `bytes`.
inline void swap_words(uint8_t* bytes, uint32_t width, uint32_t count) {
  for (uint32_t word = 0; word < count; ++word, bytes += width) {
    for (uint32_t low = 0, high = width - 1; low < high; ++low, --high) {
      const uint8_t byte = bytes[low];
      bytes[low] = bytes[high];
      bytes[high] = byte;
    }
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
