#include <detent/numbers.h>

#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void expect_near(const Vec3<Real>& v, double x, double y, double z) {
  EXPECT_NEAR(real_to_host(v.x), x, 1e-5);
  EXPECT_NEAR(real_to_host(v.y), y, 1e-5);
  EXPECT_NEAR(real_to_host(v.z), z, 1e-5);
}

DETENT_TEST(transform, a_point_goes_to_the_world_and_back) {
  const Unit half = 0.5;
  // This rotation takes x, y, z to -z, x, -y.
  const Pose pose = {{Coord(100.0), Coord(-20.0), Coord(3.0)}, {half, half, -half, half}};
  const Vec3<Real> point = {1.0, 2.0, 3.0};
  const Position there = to_world(pose, point);
  EXPECT_NEAR(coord_to_host(there.x), 102, 1e-4);
  EXPECT_NEAR(coord_to_host(there.y), -23, 1e-4);
  EXPECT_NEAR(coord_to_host(there.z), 2, 1e-4);
  expect_near(to_local(pose, there), 1, 2, 3);
  expect_near(vector_to_world(pose.rotation, point), 2, -3, -1);
  expect_near(vector_to_local(pose.rotation, {2.0, -3.0, -1.0}), 1, 2, 3);
}

DETENT_TEST(transform, turns_are_about_the_axes_of_the_world) {
  const Quat none = {0.0, 0.0, 0.0, 1.0};
  constexpr double quarter = 1.57079632679489661923;
  const Quat about_z = rotated_by(none, {0.0, 0.0, Real(quarter)});
  expect_near(vector_to_world(about_z, {1.0, 0.0, 0.0}), 0, 1, 0);
  const Quat then_x = rotated_by(about_z, {Real(quarter), 0.0, 0.0});
  expect_near(vector_to_world(then_x, {1.0, 0.0, 0.0}), 0, 0, 1);
  const Quat back = rotated_by(then_x, {Real(-quarter), 0.0, 0.0});
  expect_near(vector_to_world(back, {1.0, 0.0, 0.0}), 0, 1, 0);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
