#include "math/rotation.h"

#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

constexpr Vec3<Unit> k_x = {Unit(1.0), Unit(0.0), Unit(0.0)};
constexpr Vec3<Unit> k_y = {Unit(0.0), Unit(1.0), Unit(0.0)};
constexpr Vec3<Unit> k_z = {Unit(0.0), Unit(0.0), Unit(1.0)};

Unit tolerance() { return scale_by_power(Unit(1.0), k_unit_step + 4); }

bool is_near(const Vec3<Unit>& a, const Vec3<Unit>& b) {
  const Vec3<Unit> d = abs(a - b);
  return d.x <= tolerance() && d.y <= tolerance() && d.z <= tolerance();
}

Quat any_rotation(Samples& samples) {
  return rotation_from_vector({real_from_unit(samples.uniform(), 1), real_from_unit(samples.uniform(), 1),
                               real_from_unit(samples.uniform(), 1)});
}

DETENT_TEST(rotation, a_quarter_turn_about_z_takes_x_to_y) {
  const Quat q = rotation_about(k_z, angle_from_radians(Real(1.5707963267948966)));
  EXPECT_TRUE(is_near(rotate(q, k_x), k_y));
  EXPECT_TRUE(is_near(rotate(q, k_y), -k_x));
  EXPECT_TRUE(is_near(rotate(q, k_z), k_z));
  EXPECT_TRUE(is_near(rotate_inverse(q, k_y), k_x));
}

DETENT_TEST(rotation, no_rotation_is_exactly_the_identity) {
  EXPECT_EQ(rotation_from_vector({Real(0.0), Real(0.0), Real(0.0)}), k_identity);
  EXPECT_EQ(rotation_about(k_y, angle_from_radians(Real(0.0))), k_identity);
  EXPECT_EQ(normalise(k_identity), k_identity);
  EXPECT_EQ(multiply(k_identity, k_identity), k_identity);
  EXPECT_EQ(rotation_vector_from(k_identity), (Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)}));
  Samples samples{61};
  for (int i = 0; i < 1000; ++i) {
    const Vec3<Unit> v = samples.fractions();
    EXPECT_EQ(rotate(k_identity, v), v);
    const Vec3<Real> r = samples.reals(61);
    EXPECT_EQ(rotate(k_identity, r), r);
    const Quat q = any_rotation(samples);
    EXPECT_EQ(multiply(q, k_identity), q);
    EXPECT_EQ(multiply(k_identity, q), q);
  }
}

DETENT_TEST(rotation, a_product_applies_its_second_factor_first) {
  Samples samples{62};
  for (int i = 0; i < 5000; ++i) {
    const Quat a = any_rotation(samples);
    const Quat b = any_rotation(samples);
    const Vec3<Unit> v = samples.uniforms() * Unit(0.5);
    EXPECT_TRUE(is_near(rotate(normalise(multiply(a, b)), v), rotate(a, rotate(b, v))));
  }
}

DETENT_TEST(rotation, the_matrix_and_the_quaternion_rotate_alike) {
  Samples samples{63};
  for (int i = 0; i < 5000; ++i) {
    const Quat q = any_rotation(samples);
    const Matrix3 m = matrix_from(q);
    const Vec3<Unit> v = samples.uniforms() * Unit(0.5);
    EXPECT_TRUE(is_near(multiply(m, v), rotate(q, v)));
    EXPECT_TRUE(is_near(multiply_transposed(m, v), rotate_inverse(q, v)));
    EXPECT_TRUE(is_near(m.column[1], rotate(q, k_y)));
    EXPECT_TRUE(is_near(rotate_inverse(q, rotate(q, v)), v));
  }
}

DETENT_TEST(rotation, rotation_vectors_return_from_their_quaternions) {
  Samples samples{64};
  for (int i = 0; i < 5000; ++i) {
    // Rotation vectors of length below pi, including very short ones.
    const int exponent = -static_cast<int>(samples.below(24));
    const Vec3<Unit> u = samples.uniforms();
    const Vec3<Real> theta = {real_from_unit(u.x, exponent), real_from_unit(u.y, exponent),
                              real_from_unit(u.z, exponent)};
    const Vec3<Real> back = rotation_vector_from(rotation_from_vector(theta));
    const Vec3<Real> error = abs(back - theta);
    EXPECT_LE(max(error.x, max(error.y, error.z)), scale_by_power(Real(1.0), k_unit_step + 4));
  }
}

DETENT_TEST(rotation, many_small_rotations_keep_the_length) {
  Samples samples{65};
  const Quat step = rotation_from_vector({Real(0.01), Real(-0.02), Real(0.015)});
  Quat q = any_rotation(samples);
  for (int i = 0; i < 20000; ++i) q = normalise(multiply(step, q));
  Quat kept = {};
  ASSERT_TRUE(normalise_input(q, kept));
  const Vec3<Unit> error = abs(Vec3<Unit>{kept.x - q.x, kept.y - q.y, kept.z - q.z});
  EXPECT_LE(max(error.x, max(error.y, error.z)), tolerance());
}

DETENT_TEST(rotation, one_normalisation_restores_a_length_off_by_a_thousandth) {
  for (const Unit w : {Unit(1.0004), Unit(0.9996)}) {
    EXPECT_LE(abs(normalise({Unit(0.0), Unit(0.0), Unit(0.0), w}).w - Unit(1.0)), tolerance());
    EXPECT_LE(abs(normalise_any({Unit(0.0), Unit(0.0), w, Unit(0.0)}).z - Unit(1.0)), tolerance());
  }
  EXPECT_LE(abs(normalise_any({Unit(-0.51), Unit(0.0), Unit(0.0), Unit(0.0)}).x + Unit(1.0)), tolerance());
}

DETENT_TEST(rotation, input_quaternions_are_refused_beyond_their_tolerance) {
  Quat out = {Unit(0.5), Unit(0.5), Unit(0.5), Unit(0.5)};
  const Quat kept = out;
  EXPECT_FALSE(normalise_input({Unit(0.0), Unit(0.0), Unit(0.0), Unit(0.0)}, out));
  EXPECT_FALSE(normalise_input({Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.001)}, out));
  EXPECT_FALSE(normalise_input({Unit(0.998), Unit(0.0), Unit(0.0), Unit(0.0)}, out));
  EXPECT_FALSE(normalise_input({Unit(1.99), Unit(1.99), Unit(1.99), Unit(1.99)}, out));
  EXPECT_EQ(out, kept);
  EXPECT_TRUE(normalise_input({Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0009)}, out));
  EXPECT_LE(abs(out.w - Unit(1.0)), tolerance());
  EXPECT_TRUE(normalise_input({Unit(0.0), Unit(-0.9991), Unit(0.0), Unit(0.0)}, out));
  EXPECT_LE(abs(out.y + Unit(1.0)), tolerance());
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
