#pragma once
#include <detent/detail/scratch.h>

#include "math/float_bits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Converts a coordinate to an integer. The conversion is monotonic.
inline int64_t integer_from(Coord x) {
#if defined(DETENT_F64)
  bool saturated = false;
  return integer_from_float(x, 20, saturated);
#else
  return x.raw;
#endif
}

/// The result of integer_from() is in units of 2^-k_coord_bits m.
#if defined(DETENT_F64)
inline constexpr int k_coord_bits = 20;
#else
inline constexpr int k_coord_bits = Coord::k_frac;
#endif

inline constexpr Coord Position::*k_axes[] = {&Position::x, &Position::y, &Position::z};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
