#include "math/arithmetic.h"

#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_TEST(arithmetic, exponent_above_is_the_smallest_power_of_two_beyond_the_size) {
  EXPECT_EQ(exponent_above(Real(0.0)), -46);
  EXPECT_EQ(exponent_above(Real(1.0)), 1);
  EXPECT_EQ(exponent_above(Real(-1.0)), 1);
  EXPECT_EQ(exponent_above(Real(0.75)), 0);
  EXPECT_EQ(exponent_above(Real(0x1p-46)), -45);
  EXPECT_EQ(exponent_above(Real(-1000.0)), 10);
  for (int e = -45; e <= 16; ++e) {
    const Real power = scale_by_power(Real(1.0), e);
    EXPECT_EQ(exponent_above(power), e + 1);
    EXPECT_EQ(exponent_above(-power), e + 1);
    EXPECT_EQ(exponent_above(power - scale_by_power(power, e > -23 ? -23 : -1)), e);
  }
}

DETENT_TEST(arithmetic, unit_and_real_exchange_by_powers_of_two) {
  Samples samples{21};
  for (int i = 0; i < 1000; ++i) {
    const Unit u = samples.fraction();
    for (int e = -10; e <= 16; ++e) EXPECT_EQ(unit_from_real(real_from_unit(u, e), e), u) << e;
  }
  EXPECT_EQ(real_from_unit(Unit(0.75), 3), Real(6.0));
  EXPECT_EQ(unit_from_real(Real(-6.0), 3), Unit(-0.75));
  EXPECT_EQ(scale_by_power(Real(3.0), -2), Real(0.75));
  EXPECT_EQ(scale_by_power(Unit(0.375), 2), Unit(1.5));
}

DETENT_TEST(arithmetic, differences_of_coordinates_are_exact) {
  const Coord a(1234.5);
  const Coord b(1234.25);
  EXPECT_EQ(real_difference(a, b), Real(0.25));
  EXPECT_EQ(real_difference(b, a), Real(-0.25));
  EXPECT_EQ(unit_difference(a, b, -2), Unit(1.0));
  EXPECT_EQ(unit_difference(b, a, 4), Unit(-0.015625));
  EXPECT_EQ(unit_difference(a, a, 0), Unit(0.0));
#if !defined(DETENT_F64)
  // One step of the coordinate, far from the origin.
  const Coord far = Coord(30000.0);
  const Coord next = Coord::from_raw(far.raw + 1);
  EXPECT_EQ(real_difference(next, far), scale_by_power(Real(1.0), -Coord::k_frac));
  EXPECT_EQ(unit_difference(far, next, -Coord::k_frac), Unit(-1.0));
#endif
}

#if defined(DETENT_FX64) || defined(DETENT_F32)
DETENT_TEST(arithmetic, differences_beyond_63_bits_keep_their_sign) {
  const Coord low = Coord::from_raw(INT64_MIN);
  const Coord high = Coord::from_raw(INT64_MAX);
  EXPECT_EQ(unit_difference(high, low, 32), Unit(1.0));
  EXPECT_EQ(unit_difference(low, high, 32), Unit(-1.0));
  EXPECT_EQ(unit_difference(high, Coord(0.0), 31), Unit(1.0));
#if DETENT_FIXED
  EXPECT_EQ(real_difference(high, low), k_real_max);
  EXPECT_EQ(real_difference(low, high), -k_real_max);
#else
  EXPECT_EQ(real_difference(high, low), 0x1p32f);
  EXPECT_EQ(real_difference(low, high), -0x1p32f);
#endif
}
#endif

#if DETENT_FIXED
DETENT_TEST(arithmetic, real_differences_saturate_just_beyond_their_range) {
#if defined(DETENT_FX64)
  EXPECT_EQ(real_difference(Coord(131071.5), Coord(0.0)), Real(131071.5));
  EXPECT_EQ(real_difference(Coord(-131071.5), Coord(0.0)), Real(-131071.5));
  EXPECT_EQ(real_difference(Coord(131072.0), Coord(0.0)), k_real_max);
  EXPECT_EQ(real_difference(Coord(-131072.5), Coord(0.0)), -k_real_max);
#else
  EXPECT_EQ(real_difference(Coord(32767.5), Coord(-32767.5)), Real(65535.0));
#endif
}

DETENT_TEST(arithmetic, unit_differences_round_once_from_the_exact_difference) {
  Samples samples{22};
  for (int i = 0; i < 20000; ++i) {
    const int64_t a = static_cast<Coord::Raw>(samples.integer(Coord::k_bits - 2));
    const int64_t b = static_cast<Coord::Raw>(samples.integer(Coord::k_bits - 2));
    const int e = 31 - Coord::k_frac + static_cast<int>(samples.below(static_cast<uint32_t>(Coord::k_bits)));
    const int n = e + Coord::k_frac - k_unit_frac;
    if (n < 1 || magnitude_64(a - b) >> (n + 30) != 0) continue;
    const Unit got =
        unit_difference(Coord::from_raw(static_cast<Coord::Raw>(a)), Coord::from_raw(static_cast<Coord::Raw>(b)), e);
    EXPECT_EQ(got.raw, round_shift_64(a - b, n)) << a << " " << b << " " << e;
  }
}

DETENT_TEST(arithmetic, ties_round_up) {
  const Unit half = Unit(0.5);
  EXPECT_EQ((Unit::from_raw(3) * half).raw, 2);
  EXPECT_EQ((Unit::from_raw(-3) * half).raw, -1);
  EXPECT_EQ((Real::from_raw(3) * half).raw, 2);
  EXPECT_EQ((Real::from_raw(-3) * half).raw, -1);
  EXPECT_EQ((Real::from_raw(-3) * Real(0.5)).raw, -1);
  EXPECT_EQ(scale_by_power(Real::from_raw(-3), -1).raw, -1);
  EXPECT_EQ(scale_by_power(Real::from_raw(5), -100).raw, 0);
  EXPECT_EQ(divide(Real::from_raw(-3), Real(2.0)).raw, -1);
  EXPECT_EQ(divide(Unit::from_raw(-3), Unit(-1.5)).raw, 2);
}

DETENT_TEST(arithmetic, quotients_beyond_the_range_saturate) {
  EXPECT_EQ(divide(Real(1000.0), Real(0x1p-20)), k_real_max);
  EXPECT_EQ(divide(Real(-1000.0), Real(0x1p-20)).raw, INT64_MIN);
  EXPECT_EQ(reciprocal(Real::from_raw(1)), k_real_max);
}
#endif

DETENT_TEST(arithmetic, advancing_a_coordinate_clamps_at_its_range_and_says_so) {
  bool saturated = false;
  EXPECT_EQ(coord_advance(Coord(10.0), Real(-2.5), saturated), Coord(7.5));
  EXPECT_FALSE(saturated);
#if defined(DETENT_FX32)
  const Coord high = Coord(32767.0);
  const Coord low = Coord::from_raw(INT32_MIN);
  const Coord highest = Coord::from_raw(INT32_MAX);
#elif defined(DETENT_F64)
  const Coord high = 2147483647.0;
  const Coord low = -2147483648.0;
  const Coord highest = 2147483648.0;
#else
  const Coord high = Coord(2147483647.0);
  const Coord low = Coord::from_raw(INT64_MIN);
  const Coord highest = Coord::from_raw(INT64_MAX);
#endif
  EXPECT_EQ(coord_advance(high, Real(0.5), saturated), high + Coord(0.5));
  EXPECT_EQ(coord_advance(low, Real(0.0), saturated), low);
  EXPECT_FALSE(saturated);
  EXPECT_EQ(coord_advance(high, Real(2.0), saturated), highest);
  EXPECT_TRUE(saturated);
  saturated = false;
  EXPECT_EQ(coord_advance(low, Real(-100.0), saturated), low);
  EXPECT_TRUE(saturated);
}

DETENT_TEST(arithmetic, vector_products_obey_their_identities) {
  const Vec3<Unit> x = {Unit(1.0), Unit(0.0), Unit(0.0)};
  const Vec3<Unit> y = {Unit(0.0), Unit(1.0), Unit(0.0)};
  const Vec3<Unit> z = {Unit(0.0), Unit(0.0), Unit(1.0)};
  EXPECT_EQ(cross(x, y), z);
  EXPECT_EQ(cross(y, z), x);
  EXPECT_EQ(cross(z, x), y);
  const Vec3<Real> v = {Real(3.0), Real(-4.0), Real(12.0)};
  EXPECT_EQ(cross(v, x), (Vec3<Real>{Real(0.0), Real(12.0), Real(4.0)}));
  EXPECT_EQ(cross(x, v), (Vec3<Real>{Real(0.0), Real(-12.0), Real(-4.0)}));
  EXPECT_EQ(cross(v, v), (Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)}));
  EXPECT_EQ(dot(v, v), Real(169.0));
  EXPECT_EQ(dot(v, y), Real(-4.0));
  EXPECT_EQ(dot(z, v), Real(12.0));
  EXPECT_EQ(v * Unit(0.5), (Vec3<Real>{Real(1.5), Real(-2.0), Real(6.0)}));
  EXPECT_EQ(v + v - v, v);
}

DETENT_TEST(arithmetic, minimum_maximum_and_absolute_value_keep_order) {
  EXPECT_EQ(min(Real(1.0), Real(-2.0)), Real(-2.0));
  EXPECT_EQ(max(Real(1.0), Real(-2.0)), Real(1.0));
  EXPECT_EQ(clamp(Real(7.0), Real(-1.0), Real(2.0)), Real(2.0));
  EXPECT_EQ(clamp(Real(-7.0), Real(-1.0), Real(2.0)), Real(-1.0));
  EXPECT_EQ(abs(Unit(-0.5)), Unit(0.5));
  EXPECT_EQ(abs(Vec3<Unit>{Unit(-0.5), Unit(-0.25), Unit(-0.125)}), (Vec3<Unit>{Unit(0.5), Unit(0.25), Unit(0.125)}));
#if !DETENT_FIXED
  const Real minus_zero = -Real(0.0);
  EXPECT_FALSE(__builtin_signbit(abs(minus_zero)));
  EXPECT_TRUE(__builtin_signbit(min(minus_zero, Real(0.0))));
  EXPECT_FALSE(__builtin_signbit(max(Real(0.0), minus_zero)));
#endif
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
