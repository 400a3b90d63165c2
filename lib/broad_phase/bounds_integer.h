#pragma once
#include <detent/detail/scratch.h>

#include "math/float_bits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Converts a coordinate to an integer, in units of 2^-k_coord_bits m. The conversion is monotonic.
inline int64_t integer_from(Coord x) {
#if defined(DETENT_F64)
  bool saturated = false;
  return integer_from_float(x, 20, saturated);
#else
  return x.raw;
#endif
}

/// Number of fraction bits of the result of integer_from().
#if defined(DETENT_F64)
inline constexpr int k_coord_bits = 20;
#else
inline constexpr int k_coord_bits = Coord::k_frac;
#endif

inline constexpr Coord Position::*k_axes[] = {&Position::x, &Position::y, &Position::z};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
