#include "contact/part_culling.h"

#include <math.h>

#include "tests/common/oracle/effort.h"
#include "tests/unit/contact/pairs.h"

/// Boxes about the parts of two bodies that move: none that touch on the way are culled.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A part: a box in its body's frame, m.
struct PartBox {
  Vector middle, half;
};

Vec64 raw(const Vector& v) {
  const auto of = [](double x) { return static_cast<int64_t>(ldexp(x, 46)); };
  return {of(v[0]), of(v[1]), of(v[2])};
}

Vector rotated(const Quat& rotation, const Vector& v) {
  Vector sum = {{0, 0, 0}};
  for (int i = 0; i < 3; ++i) sum = sum + detent_oracle::axis_of(host(rotation), i) * v[i];
  return sum;
}

DETENT_TEST(part_culling, leaves_out_no_parts_that_touch_on_the_way) {
  Samples samples = {5};
  uint32_t touching = 0, culled = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(20000); ++i) {
    const auto within = [&](double most) {
      const auto one = [&] { return uniform(samples, -most, most); };
      return Vector{{one(), one(), one()}};
    };
    const auto size = [&] { return uniform(samples, 0.1, 1); };
    const PartBox a = {within(2), {{size(), size(), size()}}}, b = {within(2), {{size(), size(), size()}}};
    const Quat rotation_a = rotation_near(any_rotation(samples)), rotation_b = rotation_near(any_rotation(samples));
    const Vector displacement = within(3), from = within(100);
    // Half of the pairs meet: a point of each part is at the same place at a time.
    const bool meets = i % 2 == 0;
    const auto point_in = [&](const PartBox& box) {
      const Vector part = within(1);
      return box.middle + Vector{{part[0] * box.half[0], part[1] * box.half[1], part[2] * box.half[2]}};
    };
    const Vector on_a = rotated(rotation_a, point_in(a)), on_b = rotated(rotation_b, point_in(b));
    const Vector apart = within(8);
    const double time = uniform(samples, 0, 1);
    const Vector to = meets ? from + on_a - on_b - displacement * time : from + apart;
    const Pose pose_a = {position_near(from), rotation_a}, pose_b = {position_near(to), rotation_b};
    BodyProperties solid;
    ASSERT_OK(set_shape_properties(box(reals_near({{1, 1, 1}})), solid));
    const PartCulling culling(solid, pose_a, solid, pose_b, real_near(1e-5), reals_near(displacement));
    Vec64 middle = raw(b.middle), half = raw(b.half);
    culling.bring(middle, half);
    const bool near = culling.meet(raw(a.middle), raw(a.half), middle, half);
    if (meets) {
      ++touching;
      EXPECT_TRUE(near);
    } else {
      culled += near ? 0u : 1u;
    }
  }
  EXPECT_GT(touching, 0u);
  EXPECT_GT(culled, detent_oracle::rounds(20000) / 8);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
