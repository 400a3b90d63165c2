#include "math/trig.h"

#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if !defined(DETENT_F64)
DETENT_TEST(trig, quarter_turns_are_exact) {
  const Unit sines[] = {Unit(0.0), Unit(1.0), Unit(0.0), Unit(-1.0)};
  for (uint32_t quarter = 0; quarter < 4; ++quarter) {
    Unit s;
    Unit c;
    sine_cosine({quarter << 30}, s, c);
    EXPECT_EQ(s, sines[quarter]);
    EXPECT_EQ(c, sines[(quarter + 1) % 4]);
  }
}

DETENT_TEST(trig, sine_is_odd_and_shifts_to_cosine_exactly) {
  Samples samples{41};
  for (int i = 0; i < 20000; ++i) {
    const Angle angle = {static_cast<uint32_t>(samples.bits())};
    if (((angle.raw + 0x20000000) & 0x3fffffff) == 0) continue;  // an eighth turn belongs to one side
    Unit s, c, shifted_s, shifted_c, negative_s, negative_c;
    sine_cosine(angle, s, c);
    sine_cosine({angle.raw + (uint32_t{1} << 30)}, shifted_s, shifted_c);
    EXPECT_EQ(shifted_s, c);
    EXPECT_EQ(shifted_c, -s);
    sine_cosine(-angle, negative_s, negative_c);
    EXPECT_EQ(negative_c, c);
    EXPECT_LE(abs(negative_s + s), Unit(0x1p-30)) << angle.raw;  // ties round up on both sides
  }
}

DETENT_TEST(trig, half_angles_equal_whole_angles_of_half_the_turn) {
  Samples samples{42};
  for (int i = 0; i < 20000; ++i) {
    const uint32_t raw = static_cast<uint32_t>(samples.bits());
    Unit s, c, half_s, half_c;
    sine_cosine({raw}, s, c);
    sine_cosine_of_half({raw << 1}, half_s, half_c);
    const bool wrapped = raw + 0x40000000 >= 0x80000000;  // half of the signed angle is on the other side
    EXPECT_EQ(half_s, wrapped ? -s : s) << raw;
    EXPECT_EQ(half_c, wrapped ? -c : c) << raw;
  }
}

DETENT_TEST(trig, arc_tangents_on_axes_and_diagonals_are_exact) {
  const Unit one = Unit(1.0);
  const Unit zero = Unit(0.0);
  EXPECT_EQ(arc_tangent(zero, zero).raw, 0u);
  EXPECT_EQ(arc_tangent(zero, one).raw, 0u);
  EXPECT_EQ(arc_tangent(one, one).raw, uint32_t{1} << 29);
  EXPECT_EQ(arc_tangent(one, zero).raw, uint32_t{1} << 30);
  EXPECT_EQ(arc_tangent(one, -one).raw, uint32_t{3} << 29);
  EXPECT_EQ(arc_tangent(zero, -one).raw, uint32_t{1} << 31);
  EXPECT_EQ(arc_tangent(-one, -one).raw, uint32_t{5} << 29);
  EXPECT_EQ(arc_tangent(-one, zero).raw, uint32_t{3} << 30);
  EXPECT_EQ(arc_tangent(Unit(-0.75), Unit(0.75)).raw, uint32_t{7} << 29);
}

DETENT_TEST(trig, radians_and_turns_are_inverse) {
  Samples samples{43};
  for (int i = 0; i < 20000; ++i) {
    const Angle angle = {static_cast<uint32_t>(samples.bits())};
    const uint32_t back = angle_from_radians(radians(angle)).raw;
    // In f32 an angle near pi is rounded by up to 2^-23 rad.
    EXPECT_LE(magnitude_32(static_cast<int32_t>(back - angle.raw)), DETENT_FIXED ? 0u : 82u) << angle.raw;
  }
  EXPECT_EQ(angle_from_radians(Real(0.0)).raw, 0u);
  EXPECT_EQ(radians(Angle{0}), Real(0.0));
  EXPECT_LT(radians(Angle{uint32_t{1} << 31}), Real(-3.14159));
}
#else
DETENT_TEST(trig, angles_wrap_to_the_range_of_radians) {
  EXPECT_EQ(radians(Angle{1.0}), 1.0);
  EXPECT_NEAR(radians(Angle{4.0}), 4.0 - 6.283185307179586, 1e-15);
  EXPECT_NEAR(radians(Angle{-100000.0}), -100000.0 + 15915 * 6.283185307179586, 1e-10);
  for (int i = -1000; i < 1000; ++i) {
    const double wrapped = radians(Angle{0.1 * i});
    EXPECT_GE(wrapped, -3.141592653589794);
    EXPECT_LT(wrapped, 3.141592653589794);
  }
}
#endif

DETENT_TEST(trig, the_angle_of_a_sine_and_cosine_is_the_angle) {
  Samples samples{44};
  for (int i = 0; i < 20000; ++i) {
    const Real angle = real_from_unit(samples.uniform(), 1);  // within +-2 rad
    Unit s, c;
    sine_cosine(angle_from_radians(angle), s, c);
    const Real back = radians(arc_tangent(s, c));
    EXPECT_LE(abs(back - angle), scale_by_power(Real(1.0), k_unit_step + 3));
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
