#include "math/root.h"

#include "samples.h"
#include "tests/common/support/test.h"
#if !DETENT_FIXED
#include "math/float_bits.h"
#endif

namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_TEST(root, integer_roots_are_exact_floors) {
  Samples samples{31};
  for (int i = 0; i < 50000 && !testing::Test::HasFailure(); ++i) {
    uint64_t value = samples.magnitude(64);
    if (i % 3 == 0) {
      const uint64_t root = samples.bits() >> (32 + samples.below(32));
      value = root * root - samples.below(2);  // a square, or one below: the hardest for a floor
    }
    const uint64_t root = square_root_floor(value);
    EXPECT_LE(root * root, value);
    const uint64_t rest = value - root * root;
    EXPECT_LE(rest, 2 * root) << value;
    EXPECT_EQ(square_root_nearest(value), rest > root && root != UINT32_MAX ? root + 1 : root) << value;
  }
  EXPECT_EQ(square_root_floor(0), 0u);
  EXPECT_EQ(square_root_floor(1), 1u);
  EXPECT_EQ(square_root_floor(UINT64_MAX), UINT32_MAX);
  EXPECT_EQ(square_root_nearest(UINT64_MAX), UINT32_MAX);
}

DETENT_TEST(root, wide_roots_are_nearest) {
  Samples samples{32};
  for (int i = 0; i < 50000 && !testing::Test::HasFailure(); ++i) {
    const int64_t exact = static_cast<int64_t>(samples.magnitude(63));
    const PortableInt128 square = PortableInt128::product(exact, exact);
    // All values with root^2 - root < value <= root^2 + root have this nearest root. Tests both ends and a point
    // between.
    const PortableInt128 offset = PortableInt128::from(exact);
    const auto words = [](PortableInt128 a) { return Words128{static_cast<uint64_t>(a.high_word()), a.low_word()}; };
    EXPECT_EQ(square_root_nearest(words(square)), static_cast<uint64_t>(exact));
    EXPECT_EQ(square_root_nearest(words(square + offset)), static_cast<uint64_t>(exact));
    EXPECT_EQ(square_root_nearest(words(square + offset + PortableInt128::from(1))), static_cast<uint64_t>(exact) + 1);
    if (exact > 0) {
      EXPECT_EQ(square_root_nearest(words(square - offset + PortableInt128::from(1))), static_cast<uint64_t>(exact));
      EXPECT_EQ(square_root_nearest(words(square - offset)), static_cast<uint64_t>(exact) - 1);
    }
  }
  EXPECT_EQ(square_root_nearest(Words128{UINT64_MAX, UINT64_MAX}), UINT64_MAX);
  EXPECT_EQ(square_root_nearest(Words128{uint64_t{1} << 62, 0}), uint64_t{1} << 63);
  // Roots of 64 bits, larger than those of signed products: the ends of the interval around (2^64 - 2^k)^2.
  for (int k = 1; k < 32; ++k) {
    const uint64_t root = uint64_t{0} - (uint64_t{1} << k);
    const Words128 square = {root - (uint64_t{1} << k), uint64_t{1} << (2 * k)};
    const auto above = [&square](uint64_t more) {
      const uint64_t low = square.low + more;
      return Words128{square.high + (low < more ? 1 : 0), low};
    };
    EXPECT_EQ(square_root_nearest(square), root) << k;
    EXPECT_EQ(square_root_nearest(above(root)), root) << k;
    EXPECT_EQ(square_root_nearest(above(root + 1)), root + 1) << k;
  }
}

DETENT_TEST(root, lengths_of_pythagorean_vectors_are_exact) {
  EXPECT_EQ(length(Vec3<Real>{Real(3.0), Real(-4.0), Real(12.0)}), Real(13.0));
  EXPECT_EQ(length(Vec3<Unit>{Unit(0.25), Unit(0.5), Unit(0.5)}), Unit(0.75));
  EXPECT_EQ(length(Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)}), Real(0.0));
  EXPECT_EQ(square_root(Real(0.0)), Real(0.0));
  EXPECT_EQ(square_root(Real(2.25)), Real(1.5));
  EXPECT_EQ(square_root(Unit(0.25)), Unit(0.5));
}

DETENT_TEST(root, axes_normalise_to_exact_axes_at_every_size) {
  for (int e = -40; e <= 15; ++e) {
    Samples samples{static_cast<uint64_t>(e + 100)};
    for (int i = 0; i < 200; ++i) {
      const Real size =
          scale_by_power(Real(1.0), e) + scale_by_power(real_from_unit(abs(samples.fraction()), 0), e - 1);
      Vec3<Unit> n = {};
      Real found = {};
      ASSERT_TRUE(normalise(Vec3<Real>{Real(0.0), -size, Real(0.0)}, n, found));
      EXPECT_EQ(n, (Vec3<Unit>{Unit(0.0), Unit(-1.0), Unit(0.0)}));
      EXPECT_EQ(found, size);
    }
  }
}

DETENT_TEST(root, zero_has_no_direction_and_leaves_the_outputs) {
  Vec3<Unit> n = {Unit(0.5), Unit(0.25), Unit(0.125)};
  Real real_length = Real(7.0);
  EXPECT_FALSE(normalise(Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)}, n, real_length));
  Unit unit_length = Unit(0.5);
  EXPECT_FALSE(normalise(Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)}, n, unit_length));
  EXPECT_EQ(n, (Vec3<Unit>{Unit(0.5), Unit(0.25), Unit(0.125)}));
  EXPECT_EQ(real_length, Real(7.0));
  EXPECT_EQ(unit_length, Unit(0.5));
}

#if DETENT_FIXED
DETENT_TEST(root, the_longest_vector_saturates) {
  const Real far = -k_real_max;
  EXPECT_EQ(length(Vec3<Real>{far, far, far}), k_real_max);
  const Real lowest = Real::from_raw(INT64_MIN);
  EXPECT_EQ(length(Vec3<Real>{lowest, lowest, lowest}), k_real_max);
}

DETENT_TEST(root, one_step_in_any_direction_has_that_direction) {
  Vec3<Unit> n = {};
  Unit size = {};
  const Unit step = Unit::from_raw(1);
  ASSERT_TRUE(normalise(Vec3<Unit>{step, step, Unit(0.0)}, n, size));
  EXPECT_EQ(n.x, n.y);
  EXPECT_LE(magnitude_32(n.x.raw - Unit(0.70710678118654752).raw), 1u);
  EXPECT_EQ(size.raw, 1);  // sqrt(2) rounded
}
#else
DETENT_TEST(root, portable_float_roots_equal_the_ones_in_use) {
  Samples samples{33};
  using Bits = FloatFormat<Real>::Bits;
  for (int i = 0; i < 50000 && !testing::Test::HasFailure(); ++i) {
    // One value in four is subnormal.
    const Bits exponent = static_cast<Bits>(i % 4 == 0 ? 0 : 1 + samples.below(2 * FloatFormat<Real>::k_bias));
    const Bits fraction = static_cast<Bits>(samples.magnitude(FloatFormat<Real>::k_fraction_bits));
    const Real value =
        __builtin_bit_cast(Real, static_cast<Bits>((exponent << FloatFormat<Real>::k_fraction_bits) | fraction));
    EXPECT_EQ(square_root_portable(value), square_root(value)) << value;
    const Real whole = static_cast<Real>(samples.below(1 << 12));
    EXPECT_EQ(square_root_portable(whole * whole), whole);
  }
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
