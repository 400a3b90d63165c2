#include "math/arithmetic.h"

#if DETENT_FIXED
namespace detent {
inline namespace DETENT_NAMESPACE {

int64_t raw::divide(int64_t a, int64_t b) {
  DETENT_VERIFY_RANGE(b != 0);
  return divide_rounded(Int128::from(a).shift_left(k_real_frac), b);
}

Unit divide(Unit a, Unit b) {
  DETENT_VERIFY_RANGE(b.raw != 0);
  const uint64_t numerator = uint64_t{magnitude_32(a.raw)} << k_unit_frac;
  const uint32_t divisor = magnitude_32(b.raw);
  const uint64_t quotient = numerator / divisor;
  const uint64_t remainder = numerator - quotient * divisor;
  const bool negative = (a.raw < 0) != (b.raw < 0);
  // Ties up: away from zero for a positive quotient, towards zero for a negative one.
  const bool up = negative ? remainder > divisor - remainder : remainder >= divisor - remainder;
  return unit_from_raw(with_sign(quotient + (up ? 1 : 0), negative));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
