#include "shape/bounds.h"
#include "tests/common/oracle/bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Compares half_bounds with the extreme points of the solid along the world's axes. The bounds contain these points,
/// and exceed them by no more than the stated rounding; in floats, for which nothing is stated, by 16 steps.
void expect_tight(const BodyProperties& properties, const Quat& rotation) {
  const double error = unit_of(properties) * (DETENT_FIXED ? 0x1p-28 : unit_steps(16));
  OracleBody body = {{}, properties};
  body.pose.rotation = rotation;
  const Solid solid = solid_of(body, body.pose.position);
  const Vec3<Real> half = half_bounds(properties, matrix_from(rotation));
  const double given[3] = {real_to_host(half.x), real_to_host(half.y), real_to_host(half.z)};
  for (int i = 0; i < 3; ++i) {
    Vector world_axis = {{0, 0, 0}};
    world_axis[i] = 1;
    EXPECT_NEAR(given[i], detent_oracle::extent_along(solid, world_axis), error);
  }
}

DETENT_TEST(bounds, contain_the_shape_and_are_tight) {
  Samples samples = {4};
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const double size = exp2(uniform(samples, -14, 10)), aspect = exp2(uniform(samples, 0, 12));
    const Quat rotation = rotation_near(any_rotation(samples));
    expect_tight(sphere_properties(size), rotation);
    expect_tight(capsule_properties(size, fmin(size * aspect, 16384.0)), rotation);
    expect_tight(box_properties({{size, fmin(size * aspect, 8192.0), fmin(size * sqrt(aspect), 8192.0)}}), rotation);
  }
}

DETENT_TEST(bounds, that_touch_overlap_and_those_apart_along_any_axis_do_not) {
  const auto at = [](double x, double y, double z) {
    return Bounds{position_near({{x, y, z}}), position_near({{x + 1, y + 1, z + 1}})};
  };
  EXPECT_TRUE(overlap(at(0, 0, 0), at(1, 1, 1)));
  EXPECT_TRUE(overlap(at(0, 0, 0), at(-1, 0.5, -1)));
  EXPECT_TRUE(overlap(at(0, 0, 0), k_everywhere));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.001, 1.001}) {
      const Bounds other = at(axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0);
      EXPECT_FALSE(overlap(at(0, 0, 0), other));
      EXPECT_FALSE(overlap(other, at(0, 0, 0)));
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
