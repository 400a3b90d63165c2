#include <detent/numbers.h>

#include "math/rotation.h"
#include "samples.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_TEST(view, a_pose_beside_the_camera_is_as_precise_far_away_as_at_the_origin) {
#if defined(DETENT_FX32)
  const Coord far = Coord(30000.0);
#else
  const Coord far = Coord(10000000.0);
#endif
  const Pose pose = {{far + Coord(0.25), Coord(-1.5), far}, {Unit(0.0), Unit(0.0), Unit(0.6), Unit(0.8)}};
  const CameraRelative view = relative_to_camera(pose, {far, Coord(2.0), far + Coord(0.0625)});
  EXPECT_EQ(view.position[0], 0.25f);
  EXPECT_EQ(view.position[1], -3.5f);
  EXPECT_EQ(view.position[2], -0.0625f);
  EXPECT_EQ(view.rotation[0], 0.0f);
  EXPECT_EQ(view.rotation[2], 0.6f);
  EXPECT_EQ(view.rotation[3], 0.8f);
}

DETENT_TEST(view, interpolation_begins_and_ends_at_the_poses) {
  Samples samples{81};
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&samples] {
      const auto coordinate = [&samples] {
        bool saturated = false;
        return coord_advance(Coord(100.0), samples.real(55), saturated);
      };
      const Quat q =
          rotation_from_vector({real_from_unit(samples.uniform(), 1), real_from_unit(samples.uniform(), 1), Real(0.5)});
      return Pose{{coordinate(), coordinate(), coordinate()}, q};
    };
    const Pose a = any();
    const Pose b = any();
    EXPECT_EQ(interpolate(a, b, Unit(0.0)).position, a.position);
    EXPECT_EQ(interpolate(a, b, Unit(1.0)).position, b.position);
    const Unit near = scale_by_power(Unit(1.0), k_unit_step + 3);
    const Quat start = interpolate(a, b, Unit(0.0)).rotation;
    EXPECT_LE(abs(start.x - a.rotation.x), near);
    EXPECT_LE(abs(start.w - a.rotation.w), near);
    const Quat middle = interpolate(a, a, Unit(0.3)).rotation;
    EXPECT_LE(abs(middle.y - a.rotation.y), near);
    EXPECT_EQ(interpolate(a, a, Unit(0.3)).position, a.position);
  }
}

DETENT_TEST(view, interpolation_takes_the_shorter_arc) {
  const Quat a = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)};
  const Quat b = {Unit(0.0), Unit(0.0), Unit(-0.6), Unit(-0.8)};  // as +0.6, +0.8
  const Pose middle =
      interpolate({{Coord(0.0), Coord(0.0), Coord(0.0)}, a}, {{Coord(1.0), Coord(2.0), Coord(-4.0)}, b}, Unit(0.5));
  EXPECT_EQ(middle.position, (Position{Coord(0.5), Coord(1.0), Coord(-2.0)}));
  EXPECT_GT(middle.rotation.w, Unit(0.9));
  EXPECT_GT(middle.rotation.z, Unit(0.3));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
