#include "math/scaled.h"
#include "tests/common/oracle/bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_pi = 3.14159265358979323846;
// The error that shape_properties.h states; in floats, for which it states nothing, 16 roundings.
constexpr double k_volume_error = DETENT_FIXED ? 0x1p-26 : 16 * (sizeof(Real) == 4 ? 0x1p-24 : 0x1p-52);
constexpr double k_inverse_inertia_error = DETENT_FIXED ? 0x1p-24 : 16 * (sizeof(Real) == 4 ? 0x1p-24 : 0x1p-52);

/// The integral of a polynomial of degree 5 or less, by Gauss's three points.
template <class Function>
double integral(double from, double to, const Function& function) {
  const double middle = (from + to) / 2, half = (to - from) / 2, away = half * sqrt(0.6);
  return half * (5 * function(middle - away) + 8 * function(middle) + 5 * function(middle + away)) / 9;
}

struct MassProperties {
  double volume;
  double inertia[3];  ///< about the body's axes, over the volume
};

/// A capsule or sphere as a stack of discs along y.
MassProperties of_discs(double radius, double half_length) {
  const auto over = [&](const auto& of_disc) {  // of_disc(radius squared, y)
    return 2 * (integral(0, half_length, [&](double y) { return of_disc(radius * radius, y); }) +
                integral(0, radius, [&](double up) { return of_disc(radius * radius - up * up, half_length + up); }));
  };
  const double volume = over([](double square, double) { return k_pi * square; });
  const double along = over([](double square, double) { return k_pi * square * square / 2; });
  const double across = over([](double square, double y) { return k_pi * square * (square / 4 + y * y); });
  return {volume, {across / volume, along / volume, across / volume}};
}

/// A box as a stack of rectangles along each axis.
MassProperties of_rectangles(const Vector& half) {
  double second[3];
  for (int i = 0; i < 3; ++i) second[i] = integral(0, half[i], [](double x) { return x * x; }) / half[i];
  return {8 * half[0] * half[1] * half[2], {second[1] + second[2], second[2] + second[0], second[0] + second[1]}};
}

struct Worst {
  double volume = 0, inverse_inertia = 0;

  void take(const BodyProperties& shape, const MassProperties& right) {
    BodyProperties properties = shape;
    set_inverse_inertia(properties);
    volume = fmax(volume, fabs(scaled_to_host(shape_volume(properties)) / right.volume - 1));
    const double unit = unit_of(properties);
    for (int i = 0; i < 3; ++i) {
      const double inverse_inertia_right = fmin(unit * unit / right.inertia[i], scaled_to_host(k_inverse_inertia_max));
      inverse_inertia =
          fmax(inverse_inertia, fabs(scaled_to_host(properties.inverse_inertia[i]) / inverse_inertia_right - 1));
    }
  }
  void expect_within_bounds() const {
    ::testing::Test::RecordProperty("volume_error", ::testing::PrintToString(volume));
    ::testing::Test::RecordProperty("inverse_inertia_error", ::testing::PrintToString(inverse_inertia));
    EXPECT_LE(volume, k_volume_error);
    EXPECT_LE(inverse_inertia, k_inverse_inertia_error);
    EXPECT_GT(inverse_inertia, 0) << "nothing was measured";
  }
};

DETENT_TEST(mass, of_spheres_and_capsules_of_every_size_agrees_with_a_sum_of_discs) {
  Samples samples = {1};
  Worst worst;
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const double radius = exp2(uniform(samples, -14, 13.9));
    const double half_length = i % 8 == 0 ? 0 : fmin(radius * exp2(uniform(samples, -13, 13)), 16384.0);
    const BodyProperties ball = sphere_properties(radius), pill = capsule_properties(radius, half_length);
    const Vector ball_size = host(ball.size) * unit_of(ball), pill_size = host(pill.size) * unit_of(pill);
    worst.take(ball, of_discs(ball_size[0], 0));
    worst.take(pill, of_discs(pill_size[0], pill_size[1]));
  }
  worst.expect_within_bounds();
}

DETENT_TEST(mass, of_boxes_of_every_size_and_aspect_agrees_with_a_sum_of_rectangles) {
  Samples samples = {2};
  Worst worst;
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const double smallest = exp2(uniform(samples, -14, 13));
    Vector half;
    for (int k = 0; k < 3; ++k) half[k] = fmin(smallest * exp2(uniform(samples, 0, 13)), 16384.0);
    half[static_cast<int>(i % 3)] = smallest;
    const BodyProperties properties = box_properties(half);
    worst.take(properties, of_rectangles(host(properties.size) * unit_of(properties)));
  }
  worst.expect_within_bounds();
}

DETENT_TEST(mass, size_is_kept_to_half_a_step_of_the_bodys_unit_of_length) {
  Samples samples = {3};
  for (uint32_t i = 0; i < detent_oracle::rounds(1000); ++i) {
    const double smallest = exp2(uniform(samples, -14, 13));
    const Vec3<Real> half = reals_near({{smallest, fmin(smallest * exp2(uniform(samples, 0, 13)), 16384.0), smallest}});
    const BodyProperties properties = properties_of(box(half));
    EXPECT_NEAR(host(properties.size.x) * unit_of(properties), real_to_host(half.x),
                unit_of(properties) * unit_steps(0.5));
    EXPECT_NEAR(host(properties.size.y) * unit_of(properties), real_to_host(half.y),
                unit_of(properties) * unit_steps(0.5));
    EXPECT_GE(host(properties.bounding_radius), 0.5);
    EXPECT_LE(host(properties.bounding_radius), 1.0);
    EXPECT_EQ(real_to_host(shape_extent(properties)), ldexp(host(properties.size.x), properties.size_exponent + 1));
  }
}

DETENT_TEST(mass, shapes_are_allowed_up_to_the_limits_of_size_and_aspect_and_no_further) {
  BodyProperties properties{};
  const auto allowed = [&](const Shape& shape) { return set_shape_properties(shape, properties) == Status::ok; };
  for (int power = -14; power <= 13; ++power) {
    const double size = ldexp(1.0, power), longest = fmin(size * 0x1p14, 0x1p14);
    EXPECT_TRUE(allowed(box(reals_near({{size, size, size}})))) << size;
    EXPECT_TRUE(allowed(box(reals_near({{size, 0.99 * longest, size}})))) << size;
    EXPECT_TRUE(allowed(capsule(real_near(size), real_near(0.99 * longest)))) << size;
    if (longest < 0x1p14) {
      EXPECT_FALSE(allowed(box(reals_near({{size, 1.01 * longest, size}})))) << size;
      EXPECT_FALSE(allowed(capsule(real_near(size), real_near(longest)))) << size;
    }
  }
  EXPECT_TRUE(allowed(sphere(real_near(0x1p14))));
  EXPECT_FALSE(allowed(sphere(real_near(0x1.0001p14))));
  EXPECT_FALSE(allowed(sphere(real_near(0x1.ffffp-15))));
}

DETENT_TEST(mass, of_a_half_space_is_none) {
  const BodyProperties properties = properties_of(half_space());
  EXPECT_EQ(scaled_to_host(shape_volume(properties)), 0.0);
  EXPECT_EQ(real_to_host(shape_extent(properties)), 16384.0);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
