#include <detent/numbers.h>

#include "math/float_bits.h"
#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

const double k_infinity = __builtin_inf();

DETENT_TEST(convert, numbers_outside_the_range_are_refused_and_change_nothing) {
  Real real = Real(7.0);
  Unit unit = Unit(0.5);
  Coord coord = Coord(7.0);
  Scaled scaled = Scaled(7.0);
  for (const double bad :
       {__builtin_nan(""), -__builtin_nan(""), k_infinity, -k_infinity, 131072.0, -131072.0, 1e300, -1e300}) {
    EXPECT_EQ(real_from_host(bad, real), Status::out_of_range) << bad;
    EXPECT_EQ(unit_from_host(bad, unit), Status::out_of_range) << bad;
  }
  for (const double bad : {__builtin_nan(""), k_infinity, -k_infinity, 2147483648.0, -2147483648.0, 1e300}) {
    EXPECT_EQ(coord_from_host(bad, coord), Status::out_of_range) << bad;
  }
  for (const double bad : {__builtin_nan(""), k_infinity, -k_infinity, 1e31, -1e31, 1e-31, 1e-310}) {
    EXPECT_EQ(scaled_from_host(bad, scaled), Status::out_of_range) << bad;
  }
  EXPECT_EQ(unit_from_host(2.0, unit), Status::out_of_range);
  EXPECT_EQ(unit_from_host(-2.0, unit), Status::out_of_range);
  EXPECT_EQ(real, Real(7.0));
  EXPECT_EQ(unit, Unit(0.5));
  EXPECT_EQ(coord, Coord(7.0));
  EXPECT_EQ(scaled, Scaled(7.0));
}

DETENT_TEST(convert, exact_numbers_go_and_return_unchanged) {
  Samples samples{71};
  for (int i = 0; i < 20000; ++i) {
    const double value = static_cast<double>(samples.integer(24)) / 4096;
    Real real;
    ASSERT_EQ(real_from_host(value, real), Status::ok);
    EXPECT_EQ(real_to_host(real), value);
    Coord coord;
    ASSERT_EQ(coord_from_host(value, coord), Status::ok);
    EXPECT_EQ(coord_to_host(coord), value);
    Unit unit;
    ASSERT_EQ(unit_from_host(value / 4096, unit), Status::ok);
    EXPECT_EQ(unit_to_host(unit), value / 4096);
    Scaled scaled;
    ASSERT_EQ(scaled_from_host(value * 0x1p70, scaled), Status::ok);
    EXPECT_EQ(scaled_to_host(scaled), value * 0x1p70);
  }
}

DETENT_TEST(convert, run_time_conversion_equals_the_literal) {
  Real real;
  ASSERT_EQ(real_from_host(-9.81, real), Status::ok);
  EXPECT_EQ(real, Real(-9.81));
  Unit unit;
  ASSERT_EQ(unit_from_host(0.1, unit), Status::ok);
  EXPECT_EQ(unit, Unit(0.1));
  Coord coord;
  ASSERT_EQ(coord_from_host(12345.678, coord), Status::ok);
  EXPECT_EQ(coord, Coord(12345.678));
  Scaled scaled;
  ASSERT_EQ(scaled_from_host(0.17, scaled), Status::ok);
  EXPECT_EQ(scaled, Scaled(0.17));
}

DETENT_TEST(convert, negative_zero_and_tiny_numbers_become_zero) {
  Real real = Real(1.0);
  ASSERT_EQ(real_from_host(-0.0, real), Status::ok);
  EXPECT_EQ(real, Real(0.0));
#if !DETENT_FIXED
  EXPECT_FALSE(__builtin_signbit(real));
#endif
  ASSERT_EQ(real_from_host(-1e-310, real), Status::ok);
  EXPECT_EQ(real, Real(0.0));
  Scaled scaled = Scaled(1.0);
  ASSERT_EQ(scaled_from_host(-0.0, scaled), Status::ok);
  EXPECT_EQ(scaled, Scaled(0.0));
}

#if DETENT_FIXED
DETENT_TEST(convert, the_nearest_double_of_every_raw_number_is_found) {
  Samples samples{72};
  for (int i = 0; i < 20000; ++i) {
    const int64_t raw = samples.integer(63);
    EXPECT_EQ(real_to_host(Real::from_raw(raw)), static_cast<double>(raw) * 0x1p-46) << raw;
  }
  EXPECT_EQ(real_to_host(Real::from_raw(INT64_MAX)), 131072.0);
}
#endif

DETENT_TEST(convert, floats_are_made_from_integers_with_one_rounding) {
  Samples samples{73};
  for (int i = 0; i < 50000; ++i) {
    const int64_t value = samples.integer(63);
    EXPECT_EQ(float_from_integer<float>(value, 0), static_cast<float>(value)) << value;
    EXPECT_EQ(float_from_integer<double>(value, -3), static_cast<double>(value) / 8) << value;
    bool saturated = false;
    const volatile float in_memory = static_cast<float>(value >> 1);  // i686 keeps more bits of it in a register
    const float f = in_memory;
    EXPECT_EQ(integer_from_float(f, 0, saturated), static_cast<int64_t>(f));
    EXPECT_FALSE(saturated);
  }
  bool saturated = false;
  EXPECT_EQ(integer_from_float(0.75f, 1, saturated), 2);  // 1.5: a tie goes up
  EXPECT_EQ(integer_from_float(-0.75f, 1, saturated), -1);
  EXPECT_EQ(integer_from_float(1e-30f, 32, saturated), 0);
  EXPECT_FALSE(saturated);
  EXPECT_EQ(integer_from_float(1e30f, 0, saturated), INT64_MAX);
  EXPECT_TRUE(saturated);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
