#pragma once
#include <detent/config.h>
#include <string.h>

/// Comparison of bytes, and conversion between the machine's byte order and canonical bytes, which are little-endian.
/// No other file tests the machine's byte order.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr bool k_big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

/// The little-endian integer at `bytes`, at any alignment.
inline uint64_t load_u64(const uint8_t* bytes) {
  uint64_t value;
  memcpy(&value, bytes, sizeof value);
  return k_big_endian ? __builtin_bswap64(value) : value;
}

/// Whether the `count` bytes at `a` equal those at `b`. The function does not use memcmp(), because clang turns a
/// comparison of the result of memcmp() with 0 into a call of bcmp(), which bare targets lack.
inline bool have_same_bytes(const void* a, const void* b, uint32_t count) {
  const auto* bytes_a = static_cast<const uint8_t*>(a);
  const auto* bytes_b = static_cast<const uint8_t*>(b);
  uint32_t i = 0;
  for (; i + sizeof(uint64_t) <= count; i += sizeof(uint64_t)) {
    if (load_u64(bytes_a + i) != load_u64(bytes_b + i)) return false;
  }
  for (; i < count; ++i) {
    if (bytes_a[i] != bytes_b[i]) return false;
  }
  return true;
}

/// Whether two objects have the same bytes.
template <class T>
bool have_same_bytes(const T& a, const T& b) {
  return have_same_bytes(&a, &b, sizeof(T));
}

/// Reverses the order of the bytes within each of the `count` words at `bytes`. `width`: bytes of a word, 1, 2, 4 or 8.
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
