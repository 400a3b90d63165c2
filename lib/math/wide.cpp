#include "math/wide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

uint64_t divide_128_by_64(Words128 numerator, uint64_t divisor, uint64_t& remainder) {
  DETENT_VERIFY_RANGE(numerator.high < divisor);
  const int shift = 64 - bit_length_64(divisor);
  const uint64_t normal = divisor << shift;
  const uint64_t normal_high = normal >> 32;
  const uint64_t normal_low = normal & 0xffffffff;
  uint64_t rest = numerator.high << shift;
  if (shift != 0) rest |= numerator.low >> (64 - shift);
  const uint64_t low = numerator.low << shift;
  uint64_t quotient = 0;
  for (int digit = 1; digit >= 0; --digit) {
    const uint64_t next = (low >> (32 * digit)) & 0xffffffff;
    uint64_t estimate = rest / normal_high;
    uint64_t estimate_rest = rest - estimate * normal_high;
    // At most two corrections: the estimate from the leading digits is never too small, and at most 2 too large.
    while ((estimate >> 32) != 0 || estimate * normal_low > ((estimate_rest << 32) | next)) {
      --estimate;
      estimate_rest += normal_high;
      if ((estimate_rest >> 32) != 0) break;
    }
    rest = (rest << 32) + next - estimate * normal;  // wraps in between; the result is below `normal`
    quotient = (quotient << 32) | estimate;
  }
  remainder = rest >> shift;
  return quotient;
}

int64_t divide_rounded(bool negative, Words128 numerator, uint64_t divisor) {
  constexpr uint64_t k_max = 0x7fffffffffffffff;
  const int64_t limit = negative ? INT64_MIN : INT64_MAX;
  if (numerator.high >= divisor) return limit;
  uint64_t remainder = 0;
  uint64_t quotient = divide_128_by_64(numerator, divisor, remainder);
  // Ties up: away from zero for a positive quotient, towards zero for a negative one.
  const uint64_t rest = divisor - remainder;
  if (negative ? remainder > rest : remainder >= rest) {
    if (quotient > k_max) return limit;
    ++quotient;
  }
  if (quotient > k_max) return limit;
  return with_sign(quotient, negative);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
