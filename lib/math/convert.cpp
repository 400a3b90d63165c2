#include <detent/numbers.h>

#include "math/float_bits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr int k_real_range = 17;  ///< |Real| < 2^17 m in all configurations
constexpr int k_unit_range = 1;
#if defined(DETENT_FX32)
constexpr int k_coord_range = 15;
#else
constexpr int k_coord_range = 31;
#endif
constexpr int k_scaled_range = 100;

/// Whether the value is finite and |value| < 2^range. Subnormals are read as zero, which is within every range.
constexpr bool is_within(const FloatParts& parts, int range) {
  return parts.finite && parts.exponent + bit_length_64(parts.mantissa) <= range;
}

template <class Int, int frac>
Status store(double value, int range, Fixed<Int, frac>& result) {
  const FromDouble converted =
      fixed_from_double_bits(__builtin_bit_cast(uint64_t, value), frac, Fixed<Int, frac>::k_bits);
  if (!converted.in_range || !is_within(float_parts(value), range)) return Status::out_of_range;
  result.raw = static_cast<Int>(converted.raw);
  return Status::ok;
}

template <class Float>
[[maybe_unused]] Status store(double value, int range, Float& result) {
  const FloatParts parts = float_parts(value);
  if (!is_within(parts, range)) return Status::out_of_range;
  const Float rounded = float_from_parts<Float>(parts.mantissa, parts.exponent, parts.negative);
  // Rounding can give the limit 2^range itself, which is out of range.
  if (!is_within(float_parts(rounded), range)) return Status::out_of_range;
  result = rounded;
  return Status::ok;
}

}  // namespace

Status real_from_host(double value, Real& result) { return store(value, k_real_range, result); }
Status unit_from_host(double value, Unit& result) { return store(value, k_unit_range, result); }
Status coord_from_host(double value, Coord& result) { return store(value, k_coord_range, result); }

Status scaled_from_host(double value, Scaled& result) {
  const FloatParts parts = float_parts(value);
  const int top = parts.exponent + FloatFormat<double>::k_fraction_bits;
  const bool is_zero = parts.mantissa == 0 && __builtin_bit_cast(uint64_t, value) << 1 == 0;
  if (!is_zero && (parts.mantissa == 0 || top < -k_scaled_range)) return Status::out_of_range;
#if DETENT_FIXED
  if (!is_within(parts, k_scaled_range)) return Status::out_of_range;
  result = Scaled::from_double_bits(__builtin_bit_cast(uint64_t, value));
  return Status::ok;
#else
  return store(value, k_scaled_range, result);
#endif
}

#if DETENT_FIXED
double real_to_host(Real value) { return float_from_integer<double>(value.raw, -Real::k_frac); }
double unit_to_host(Unit value) { return float_from_integer<double>(value.raw, -Unit::k_frac); }
double coord_to_host(Coord value) { return float_from_integer<double>(value.raw, -Coord::k_frac); }
double scaled_to_host(Scaled value) { return float_from_integer<double>(value.mantissa, value.exponent); }
#else
namespace {

template <class Float>
double to_double(Float value) {
  const FloatParts parts = float_parts(value);
  return float_from_parts<double>(parts.mantissa, parts.exponent, parts.negative);
}

}  // namespace

double real_to_host(Real value) { return to_double(value); }
double unit_to_host(Unit value) { return to_double(value); }
double scaled_to_host(Scaled value) { return to_double(value); }
#if defined(DETENT_F32)
double coord_to_host(Coord value) { return float_from_integer<double>(value.raw, -Coord::k_frac); }
#else
double coord_to_host(Coord value) { return to_double(value); }
#endif
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
