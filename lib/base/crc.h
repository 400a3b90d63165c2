#pragma once
#include <detent/config.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The CRC remainders of the 16 values of a nibble. The table takes 64 bytes of flash, and crc32() looks up two entries
/// for each byte. A table of the 256 values of a byte would take 1 KB.
inline constexpr uint32_t k_crc_nibbles[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
                                               0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                               0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};

/// CRC-32 (IEEE 802.3): polynomial 0x04c11db7, reflected; complemented at the start and at the end. "123456789" gives
/// 0xcbf43926.
/// `before`: the CRC of the preceding bytes; 0 if there are none.
constexpr uint32_t crc32(const uint8_t* bytes, uint32_t count, uint32_t before = 0) {
  uint32_t remainder = ~before;
  for (uint32_t i = 0; i < count; ++i) {
    remainder ^= bytes[i];
    remainder = (remainder >> 4) ^ k_crc_nibbles[remainder & 15];
    remainder = (remainder >> 4) ^ k_crc_nibbles[remainder & 15];
  }
  return ~remainder;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
