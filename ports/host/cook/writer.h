#pragma once
#include <math.h>

#include <vector>

#include "base/crc.h"
#include "shape/cooked.h"

namespace detent_cook {

/// A block of bytes, at first zeros, into which values are written, little-endian.
class Writer {
 public:
  explicit Writer(uint32_t byte_count) : bytes_(byte_count) {}

  template <class Int>
  void put(uint32_t at, Int value) {
    const auto bits = static_cast<uint64_t>(value);
    for (uint32_t k = 0; k < sizeof value; ++k) bytes_[at + k] = static_cast<uint8_t>(bits >> (8 * k));
  }
  void put_magic(const uint8_t (&magic)[8], uint32_t version) {
    for (uint32_t k = 0; k < 8; ++k) put(k, magic[k]);
    put(detent::k_cooked_version_at, version);
  }
  /// Writes `value` as a 31-bit mantissa, rounded to nearest, and an exponent. For the value 0, writes zeros.
  void put_scaled(uint32_t at, double value) {
    if (value == 0) return;
    int exponent = 0;
    double mantissa = floor(ldexp(frexp(value, &exponent), 31) + 0.5);
    if (mantissa == 0x1p31) {
      mantissa = 0x1p30;
      ++exponent;
    }
    put(at, static_cast<int32_t>(mantissa));
    put(at + 4, int32_t{exponent - 31});
  }
  /// Writes the number of all bytes and their checksum, as in every cooked format.
  std::vector<uint8_t>& sealed() {
    const uint32_t count = static_cast<uint32_t>(bytes_.size());
    put(detent::k_cooked_byte_count_at, count);
    constexpr uint32_t k_from = detent::k_cooked_checksum_at;
    put(k_from, detent::crc32(bytes_.data() + k_from + 4, count - k_from - 4, detent::crc32(bytes_.data(), k_from)));
    return bytes_;
  }
  const uint8_t* data() const { return bytes_.data(); }

 private:
  std::vector<uint8_t> bytes_;
};

}  // namespace detent_cook
