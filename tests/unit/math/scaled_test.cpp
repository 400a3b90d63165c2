#include "math/scaled.h"

#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_TEST(scaled, order_follows_value_over_all_signs_and_sizes) {
  const Scaled ordered[] = {Scaled(-1e20), Scaled(-3.0), Scaled(-1.5), Scaled(-1e-20), Scaled(0.0),
                            Scaled(1e-20), Scaled(1.5),  Scaled(1.75), Scaled(3.0),    Scaled(1e20)};
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) EXPECT_EQ(less(ordered[i], ordered[j]), i < j) << i << " " << j;
    EXPECT_EQ(is_positive(ordered[i]), i > 4);
  }
}

DETENT_TEST(scaled, sums_and_powers_of_small_numbers_are_exact) {
  EXPECT_EQ(add(Scaled(3.0), Scaled(-1.25)), Scaled(1.75));
  EXPECT_EQ(add(Scaled(3.0), Scaled(-3.0)), Scaled(0.0));
  EXPECT_EQ(add(Scaled(0.0), Scaled(5.0)), Scaled(5.0));
  EXPECT_EQ(multiply(Scaled(3.0), Scaled(-5.0)), Scaled(-15.0));
  EXPECT_EQ(divide(Scaled(-15.0), Scaled(4.0)), Scaled(-3.75));
  EXPECT_EQ(square_root(Scaled(2.25)), Scaled(1.5));
  EXPECT_EQ(square_root(Scaled(9.0)), Scaled(3.0));
  EXPECT_EQ(square_root(Scaled(0.0)), Scaled(0.0));
  EXPECT_EQ(scaled_by_power(Scaled(3.0), -4), Scaled(0.1875));
  EXPECT_EQ(scaled_from(Real(-2.5)), Scaled(-2.5));
  EXPECT_EQ(to_unit(Scaled(-0.75)), Unit(-0.75));
}

DETENT_TEST(scaled, conversion_to_real_clamps_and_says_so) {
  bool saturated = false;
  EXPECT_EQ(to_real(Scaled(-2.5), saturated), Real(-2.5));
  EXPECT_EQ(multiply(Real(1000.0), Scaled(-0.5), saturated), Real(-500.0));
  EXPECT_EQ(multiply(Real(0.0), Scaled(1e30), saturated), Real(0.0));
  EXPECT_EQ(multiply(Real(1000.0), Scaled(0x1p-60), saturated), scale_by_power(Real(1000.0), -60));
  EXPECT_FALSE(saturated);
  EXPECT_EQ(to_real(Scaled(1e9), saturated), k_real_max);
  EXPECT_TRUE(saturated);
  saturated = false;
  EXPECT_EQ(multiply(Real(-1000.0), Scaled(1000.0), saturated), -k_real_max);
  EXPECT_TRUE(saturated);
}

#if DETENT_FIXED
DETENT_TEST(scaled, every_result_is_canonical) {
  Samples samples{51};
  const auto any = [&samples] {
    return scaled_from_parts(samples.below(2) == 0, samples.magnitude(40), static_cast<int>(samples.below(500)) - 250);
  };
  for (int i = 0; i < 20000; ++i) {
    const Scaled a = any();
    const Scaled b = any();
    for (const Scaled c : {multiply(a, b), add(a, b), b.mantissa == 0 ? a : divide(a, b), scaled_by_power(a, 300)}) {
      const uint32_t size = magnitude_32(c.mantissa);
      EXPECT_TRUE((size == 0 && c.exponent == 0) || (size >> 30 == 1 && c.exponent >= -256 && c.exponent <= 256));
    }
  }
}

DETENT_TEST(scaled, the_edges_of_the_exponent_clamp_and_vanish) {
  const Scaled big = scaled_from_parts(false, 1, 200);
  const Scaled small = scaled_from_parts(true, 1, -200);
  EXPECT_EQ(multiply(big, big), Scaled::from_parts(INT32_MAX, 256));
  EXPECT_EQ(multiply(small, big), Scaled(-1.0));
  EXPECT_EQ(multiply(small, small), Scaled::from_parts(0, 0));
}

DETENT_TEST(scaled, a_product_that_rounds_up_to_the_limit_saturates) {
  // (2^62 + 2^31 + 1) (2^31 - 1) 2^-30 = 2^63 - 2^-30
  const Real a = Real::from_raw((int64_t{1} << 62) + (int64_t{1} << 31) + 1);
  const Scaled b = Scaled::from_parts(INT32_MAX, -30);
  bool saturated = false;
  EXPECT_EQ(multiply(a, b, saturated), k_real_max);
  EXPECT_TRUE(saturated);
  saturated = false;
  EXPECT_EQ(multiply(-a, b, saturated).raw, INT64_MIN);
  EXPECT_FALSE(saturated);
}

DETENT_TEST(scaled, the_product_made_in_place_equals_the_called_one) {
  Samples samples{53};
  for (int i = 0; i < 50000 && !testing::Test::HasFailure(); ++i) {
    const Real a = samples.real();
    Scaled b = scaled_from_parts(samples.below(2) == 0, samples.magnitude(31), -31);
    if (b.mantissa != 0) b.exponent = -10 - static_cast<int32_t>(samples.below(70));
    bool saturated = false, called_saturated = false;
    const Real product = multiply(a, b, saturated);
    const int64_t called = words::multiply_raw(a.raw, words::word_of(b), called_saturated);
    EXPECT_EQ(product.raw, called) << a.raw << " " << b.mantissa << " 2^" << b.exponent;
    EXPECT_EQ(saturated, called_saturated);
  }
}

DETENT_TEST(scaled, the_fast_product_equals_the_checked_one_within_one) {
  Samples samples{52};
  for (int i = 0; i < 50000 && !testing::Test::HasFailure(); ++i) {
    const Real a = samples.real();
    Scaled b = scaled_from_parts(samples.below(2) == 0, samples.magnitude(31), -31);
    if (b.mantissa != 0) b.exponent = -31 - static_cast<int32_t>(samples.below(100));
    bool saturated = false;
    EXPECT_EQ(multiply(a, b), multiply(a, b, saturated)) << a.raw << " " << b.mantissa << " 2^" << b.exponent;
    EXPECT_FALSE(saturated);
  }
  const Real edges[] = {Real::from_raw(INT64_MAX), Real::from_raw(INT64_MIN), Real::from_raw(-1)};
  for (const Real a : edges) {
    EXPECT_EQ(multiply(a, Scaled(1.0)), a);
    EXPECT_EQ(multiply(a, Scaled(0.0)), Real(0.0));
  }
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
