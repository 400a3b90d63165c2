#include "math/wide.h"

#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

constexpr int k_count = 20000;

#if defined(__SIZEOF_INT128__)
template <class A, class B>
void expect_equal(A a, B b) {
  EXPECT_EQ(a.high_word(), b.high_word());
  EXPECT_EQ(a.low_word(), b.low_word());
}

DETENT_TEST(wide, portable_operations_equal_native_ones) {
  Samples samples{1};
  for (int i = 0; i < k_count && !testing::Test::HasFailure(); ++i) {
    const int64_t a = samples.integer(63);
    const int64_t b = samples.integer(63);
    const int32_t c = static_cast<int32_t>(samples.integer(31));
    const auto native = NativeInt128::product(a, b);
    const auto portable = PortableInt128::product(a, b);
    expect_equal(native, portable);
    expect_equal(NativeInt128::product_narrow(a, c), PortableInt128::product_narrow(a, c));
    const auto native_other = NativeInt128::from_words(samples.integer(62), samples.bits());
    const auto other = PortableInt128::from_words(native_other.high_word(), native_other.low_word());
    expect_equal(native + native_other, portable + other);
    expect_equal(native - native_other, portable - other);
    expect_equal(-native, -portable);
    EXPECT_EQ(native < native_other, portable < other);
    const int n = static_cast<int>(samples.below(128));
    expect_equal(native.shift_left(n), portable.shift_left(n));
    if (n >= 1) {
      EXPECT_EQ(native.round_shift(n), portable.round_shift(n)) << n;
    }
    EXPECT_EQ(native.round_shift<1>(), portable.round_shift(1));
    EXPECT_EQ(native.round_shift<46>(), portable.round_shift<46>());
    EXPECT_EQ(native.round_shift<64>(), portable.round_shift<64>());
  }
  expect_equal(NativeInt128::product(INT64_MIN, INT64_MIN), PortableInt128::product(INT64_MIN, INT64_MIN));
  expect_equal(NativeInt128::product(INT64_MIN, INT64_MAX), PortableInt128::product(INT64_MIN, INT64_MAX));
  expect_equal(NativeInt128::product_narrow(INT64_MIN, INT32_MIN),
               PortableInt128::product_narrow(INT64_MIN, INT32_MIN));
}

DETENT_TEST(wide, portable_narrow_sums_equal_native_ones_up_to_the_edges) {
  Samples samples{2};
  constexpr int64_t k_edges[] = {INT64_MIN, INT64_MIN + 1, INT64_MAX,  INT64_MAX - 0x7fffffff,
                                 -1,        0x80000000,    0x7fffffff, -0x80000000ll};
  constexpr int32_t k_narrow_edges[] = {INT32_MAX, -INT32_MAX, 1 << 30, -(1 << 30), 1, -1};
  const auto wide_number = [&] { return samples.below(4) == 0 ? k_edges[samples.below(8)] : samples.integer(63); };
  const auto number = [&] {
    return samples.below(3) == 0 ? k_narrow_edges[samples.below(6)] : static_cast<int32_t>(samples.integer(31));
  };
  for (int i = 0; i < 5 * k_count && !testing::Test::HasFailure(); ++i) {
    const int64_t a = wide_number();
    const int64_t b = wide_number();
    const int64_t c = wide_number();
    const int32_t x = number();
    const int32_t y = number();
    const int32_t z = number();
    EXPECT_EQ(NativeInt128::narrow_sum<30>(a, x), PortableInt128::narrow_sum<30>(a, x));
    EXPECT_EQ((NativeInt128::narrow_sum<30>(a, x, b, y)), (PortableInt128::narrow_sum<30>(a, x, b, y)));
    EXPECT_EQ((NativeInt128::narrow_sum<30>(a, x, b, y, c, z)), (PortableInt128::narrow_sum<30>(a, x, b, y, c, z)));
    EXPECT_EQ((NativeInt128::narrow_sum<29>(a, x, b, y, c, z)), (PortableInt128::narrow_sum<29>(a, x, b, y, c, z)));
  }
}
#endif

DETENT_TEST(wide, portable_products_obey_the_distributive_law) {
  Samples samples{3};
  for (int i = 0; i < k_count && !testing::Test::HasFailure(); ++i) {
    const int64_t a = samples.integer(63);
    const int64_t b = samples.integer(62);
    const int64_t c = samples.integer(62);
    EXPECT_TRUE(PortableInt128::product(a, b) + PortableInt128::product(a, c) == PortableInt128::product(a, b + c));
    EXPECT_TRUE(PortableInt128::product(a, b) - PortableInt128::product(b, a) == PortableInt128::from(0));
  }
}

DETENT_TEST(wide, quotient_times_divisor_plus_remainder_is_the_numerator) {
  Samples samples{4};
  for (int i = 0; i < k_count && !testing::Test::HasFailure(); ++i) {
    const uint64_t divisor = samples.magnitude(64) | 1u << samples.below(8);
    const uint64_t high = samples.below(4) == 0 ? divisor - 1 : samples.bits() % divisor;
    const uint64_t low = samples.below(4) == 0 ? ~uint64_t{0} : samples.bits();
    uint64_t remainder = 0;
    const uint64_t quotient = divide_128_by_64({high, low}, divisor, remainder);
    EXPECT_LT(remainder, divisor);
    // The product of unsigned halves by long multiplication, independent of the code under test.
    const uint64_t q1 = quotient >> 32, q0 = quotient & 0xffffffff, d1 = divisor >> 32, d0 = divisor & 0xffffffff;
    const uint64_t middle = q1 * d0 + ((q0 * d0) >> 32);
    const uint64_t other = q0 * d1 + (middle & 0xffffffff);
    uint64_t product_high = q1 * d1 + (middle >> 32) + (other >> 32);
    const uint64_t product_low = quotient * divisor;
    const uint64_t sum = product_low + remainder;
    if (sum < product_low) ++product_high;
    EXPECT_EQ(sum, low);
    EXPECT_EQ(product_high, high);
  }
}

DETENT_TEST(wide, rounded_division_takes_ties_up_and_saturates) {
  const auto divide_small = [](int64_t a, int64_t b) { return divide_rounded(PortableInt128::from(a), b); };
  EXPECT_EQ(divide_small(7, 2), 4);
  EXPECT_EQ(divide_small(-7, 2), -3);
  EXPECT_EQ(divide_small(7, -2), -3);
  EXPECT_EQ(divide_small(-7, -2), 4);
  EXPECT_EQ(divide_small(5, 3), 2);
  EXPECT_EQ(divide_small(-5, 3), -2);
  EXPECT_EQ(divide_small(INT64_MIN, 1), INT64_MIN);
  EXPECT_EQ(divide_small(INT64_MIN, -1), INT64_MAX);
  EXPECT_EQ(divide_rounded(PortableInt128::from(INT64_MAX).shift_left(1), 1), INT64_MAX);
  EXPECT_EQ(divide_rounded(PortableInt128::from(INT64_MIN).shift_left(5), 3), INT64_MIN);
}

DETENT_TEST(wide, bit_lengths_count_to_the_leading_one) {
  EXPECT_EQ(bit_length_32(0), 0);
  EXPECT_EQ(bit_length_64(0), 0);
  for (int n = 0; n < 64; ++n) {
    EXPECT_EQ(bit_length_64(uint64_t{1} << n), n + 1);
    if (n < 32) {
      EXPECT_EQ(bit_length_32(uint32_t{1} << n), n + 1);
    }
    EXPECT_EQ(bit_length_128({uint64_t{1} << n, 0}), n + 65);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
