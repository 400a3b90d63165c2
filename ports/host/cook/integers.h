#pragma once
#include "math/wide.h"

namespace detent_cook {

using detent::Int128;

/// Converts an Int128. Converts each part exactly, so that only the sums round, because the conversion of a 64-bit
/// unsigned integer rounds twice with some compilers. Relative error below 2^-52.
inline double to_double(Int128 value) {
  const detent::Words128 words = detent::magnitude_128(value);
  const double high = static_cast<double>(static_cast<uint32_t>(words.high >> 32)) * 0x1p96 +
                      static_cast<double>(static_cast<uint32_t>(words.high)) * 0x1p64;
  const double magnitude = (high + static_cast<double>(static_cast<uint32_t>(words.low >> 32)) * 0x1p32) +
                           static_cast<double>(static_cast<uint32_t>(words.low));
  return value < Int128::from(0) ? -magnitude : magnitude;
}

}  // namespace detent_cook
