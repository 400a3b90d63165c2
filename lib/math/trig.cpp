#include "math/trig.h"

#if !defined(DETENT_F64)
#include "math/trig_integer.h"
#if !DETENT_FIXED
#include "math/float_bits.h"
#endif

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

#if DETENT_FIXED
Unit unit_of(int32_t raw) { return Unit::from_raw(raw); }
int64_t radians_q46(Real angle) { return angle.raw; }
#else
Unit unit_of(int32_t raw) { return float_from_integer<float>(raw, -30); }
int64_t radians_q46(Real angle) {
  bool saturated = false;
  return integer_from_float(angle, 46, saturated);
}
#endif

void set(const SineCosineRaw& raw, Unit& sine, Unit& cosine) {
  sine = unit_of(raw.sine);
  cosine = unit_of(raw.cosine);
}

}  // namespace

void sine_cosine(Angle angle, Unit& sine, Unit& cosine) { set(sine_cosine_raw(int64_t{angle.raw} * 4), sine, cosine); }

void sine_cosine_of_half(Angle angle, Unit& sine, Unit& cosine) {
  set(sine_cosine_raw(int64_t{static_cast<int32_t>(angle.raw)} * 2), sine, cosine);
}

void sine_cosine_of_half_radians(Real angle, Unit& sine, Unit& cosine) {
  if (abs(angle) < k_series_angle_max) {
    const Unit eightfold = unit_from_real(angle, -3);
    const HalfAngleSeries series = half_angle_series(eightfold * eightfold);
    sine = unit_from_real(angle * series.sine_ratio, 0);
    cosine = series.cosine;
    return;
  }
  set(sine_cosine_raw(turns_from_radians_raw(radians_q46(angle), 1)), sine, cosine);
}

Angle angle_from_radians(Real angle) { return {static_cast<uint32_t>(turns_from_radians_raw(radians_q46(angle), 0))}; }

#if DETENT_FIXED
Real radians(Angle angle) { return Real::from_raw(radians_raw(static_cast<int32_t>(angle.raw), k_real_frac)); }

Angle arc_tangent(Unit y, Unit x) { return {arc_tangent_raw(y.raw, x.raw)}; }
#else
Real radians(Angle angle) {
  constexpr int k_frac = 60;  // fraction bits: so many that even the smallest angle has at least 24 bits
  return float_from_integer<float>(radians_raw(static_cast<int32_t>(angle.raw), k_frac), -k_frac);
}

Angle arc_tangent(Unit y, Unit x) {
  // x and y are multiplied by the same power of two, so that the larger one has 31 bits as an integer. The bits that
  // the smaller one loses change the angle by less than 2^-31 rad.
  const Unit large = max(abs(y), abs(x));
  const FloatParts parts = float_parts(large);
  const int frac = 7 - parts.exponent;
  bool saturated = false;
  return {arc_tangent_raw(static_cast<int32_t>(integer_from_float(y, frac, saturated)),
                          static_cast<int32_t>(integer_from_float(x, frac, saturated)))};
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
