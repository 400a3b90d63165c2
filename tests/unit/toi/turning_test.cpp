#include <algorithm>

#include "math/root.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/oracle/vectors.h"
#include "tests/unit/distance/bodies_at.h"
#include "tests/unit/distance/closed_form.h"
#include "toi/advance.h"

/// The rounding error of the motion that conservative advancement uses: two rows of its budget (DESIGN.md).
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_step = 0x1p-30;

Vector from_raw(const Vec32& v) { return {{v.x * k_step, v.y * k_step, v.z * k_step}}; }

DETENT_TEST(turning, at_any_time_is_within_its_error_of_the_exact_rotation) {
  Samples samples{31};
  double error_max = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(20000); ++i) {
    Turning turning = still({0, 0, 0, 1 << 30});
    MovingPair pair;
    const Quaternion start = random_quaternion(samples);
    const Vector rotation_vector = random_direction(samples) * pow(2, uniform(samples, -20, 5));
    const KnownShape cube = known(box({0.5, 0.5, 0.5}));
    const BodyAt body = {{{0, 0, 0}}, start, {{0, 0, 0}}, rotation_vector};
    const Motion motion = motion_of(body), other = motion_of(held({{{0.5, 0, 0}}}));
    ASSERT_OK(prepare(cube.convex, motion, cube.convex, other, pair));
    turning = pair.turning_a;
    const int64_t time = static_cast<int64_t>(samples.bits() >> 2);
    // The reference rotates with the values that the library was given: the rounded start and rotation.
    const Quat& q = motion.start.rotation;
    const Quaternion given = detent_oracle::normalised(
        Quaternion{unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)});
    const Vector rate = {{real_to_host(motion.rotation_vector.x), real_to_host(motion.rotation_vector.y),
                          real_to_host(motion.rotation_vector.z)}};
    const double part = ldexp(static_cast<double>(time), -62);
    const Quaternion exact = detent_oracle::rotation_by(rate * part) * given;
    const Matrix32 rotation = turning.at(time);
    const Vector v = random_direction(samples);
    Vector error = {{0, 0, 0}};
    for (int axis = 0; axis < 3; ++axis) {
      error = error + (from_raw(rotation.column[axis]) - detent_oracle::axis_of(exact, axis)) * v[axis];
    }
    error_max = std::max(error_max, length(error) / k_step);
  }
  printf("turning: %.2f of %.0f steps\n", error_max, k_turning_error);
  EXPECT_LE(error_max, k_turning_error);
}

DETENT_TEST(turning, of_an_axis_keeps_it_of_length_1) {
  Samples samples{32};
  double error_max = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(20000); ++i) {
    const auto vector_of = [&](double size, int bits) {
      const Vector v = random_direction(samples) * ldexp(size, bits);
      return Vec32{static_cast<int32_t>(v[0]), static_cast<int32_t>(v[1]), static_cast<int32_t>(v[2])};
    };
    const Vec32 normal = unit_vector_raw(scaled_to_30_bits(vector_of(1, 30)));
    const RotatingAxis axis(normal, vector_of(uniform(samples, 0, 2.5), 29));
    const Vector turned = from_raw(axis.at(static_cast<int64_t>(samples.bits() >> 34)));
    error_max = std::max(error_max, fabs(length(turned) - 1) / k_step);
  }
  printf("axis: %.2f of %.0f steps\n", error_max, k_turning_axis_error);
  EXPECT_LE(error_max, k_turning_axis_error);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
