#pragma once
#include <detent/numbers.h>
#include <stdint.h>

#include "tests/common/support/random.h"

/// Inputs for the number tests: a fixed sequence of uniform numbers and of numbers at the edges of every magnitude.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Samples {
  uint64_t state;

  uint64_t bits() { return detent_test::split_mix(state); }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(((bits() >> 32) * count) >> 32); }

  /// A number of random magnitude below 2^length_max; one in four is a power of two or next to one.
  uint64_t magnitude(int length_max) {
    const int length = static_cast<int>(below(static_cast<uint32_t>(length_max) + 1));
    if (length == 0) return 0;
    const uint64_t mask = ~uint64_t{0} >> (64 - length);
    const uint64_t top = uint64_t{1} << (length - 1);
    if (below(4) == 0) return below(2) == 0 ? top : mask;
    return (bits() & mask) | top;
  }
  int64_t integer(int length_max) {
    const int64_t value = static_cast<int64_t>(magnitude(length_max));
    return below(2) == 0 ? value : -value;
  }

#if DETENT_FIXED
  /// |.| < 2.
  Unit unit() { return Unit::from_raw(static_cast<int32_t>(integer(31))); }
  /// |.| <= 1.
  Unit fraction() { return Unit::from_raw(static_cast<int32_t>(integer(30))); }
  /// |.| < 2^(length - 46).
  Real real(int length = 63) { return Real::from_raw(integer(length)); }
  Unit uniform() { return Unit::from_raw(static_cast<int32_t>(bits() >> 33) - (1 << 30)); }
#else
  /// A number with |.| < 1, in steps of 2^-30: products with integers and powers of two are exact.
  Unit uniform() { return static_cast<Unit>(static_cast<int32_t>(bits() >> 33) - (1 << 30)) / Unit(1 << 30); }
  Unit fraction() { return static_cast<Unit>(integer(30)) / Unit(1 << 30); }
  Unit unit() { return static_cast<Unit>(integer(31) / 2) / Unit(1 << 29); }
  Real real(int length = 63) { return static_cast<Real>(integer(length)) / static_cast<Real>(int64_t{1} << 46); }
#endif
  Vec3<Unit> fractions() { return {fraction(), fraction(), fraction()}; }
  Vec3<Unit> uniforms() { return {uniform(), uniform(), uniform()}; }
  Vec3<Real> reals(int length) { return {real(length), real(length), real(length)}; }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
