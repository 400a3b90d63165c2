#include <detent/body.h>
#include <detent/world.h>
#include <math.h>

#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_pi = 3.14159265358979323846;

BodyDef ball(double radius, double mass) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.mass = scaled(mass);
  return def;
}

DETENT_TEST(forces, a_force_off_the_centre_moves_and_turns_for_one_step) {
  Lab lab({1, 1, 0}, weightless());
  const BodyId id = lab.add(ball(0.5, 2));
  ASSERT_OK(apply_force_at(lab.world, id, scaleds(240, 0, 0), reals(0, 0.25, 0)));
  EXPECT_EQ(lab.motion(id).linear_velocity[0], 0);
  for (int tick = 0; tick < 2; ++tick) {
    lab.run(1);
    EXPECT_NEAR(lab.motion(id).linear_velocity[0], 2, 1e-5);
    EXPECT_NEAR(lab.motion(id).angular_velocity[2], -0.25 * 4 / (0.4 * 2 * 0.25), 1e-4);
  }
}

DETENT_TEST(forces, a_point_of_the_world_is_the_same_as_its_place_on_the_body) {
  Lab lab({2, 2, 0}, weightless()), other({2, 2, 0}, weightless());
  BodyDef def = ball(0.5, 2);
  def.position = position(3, -4, 5);
  const BodyId id = lab.add(def);
  other.add(def);
  ASSERT_OK(apply_force_at(lab.world, id, scaleds(24, 3, 0), reals(0, 0.25, -0.5)));
  ASSERT_OK(apply_force_at_point(other.world, id, scaleds(24, 3, 0), position(3, -3.75, 4.5)));
  EXPECT_EQ(digest(lab.world), digest(other.world));
  ASSERT_OK(apply_impulse_at(lab.world, id, scaleds(1, 3, 0), reals(0.5, 0.25, 0.5)));
  ASSERT_OK(apply_impulse_at_point(other.world, id, scaleds(1, 3, 0), position(3.5, -3.75, 5.5)));
  EXPECT_EQ(digest(lab.world), digest(other.world));
  lab.run(1);
  other.run(1);
  EXPECT_EQ(digest(lab.world), digest(other.world));
  EXPECT_EQ(apply_force_at_point(lab.world, id, scaleds(1, 0, 0), position(300, 0, 0)), Status::out_of_range);
}

DETENT_TEST(forces, an_explosion_pushes_by_area_and_distance) {
  Lab lab({5, 8, 0}, weightless());
  const double x[] = {2, -4, 11.25, 10.6};
  const double radius[] = {0.5, 1, 0.5, 1};
  BodyId id[4];
  for (int i = 0; i < 4; ++i) {
    BodyDef def = ball(radius[i], 2);
    def.position = position(x[i], 0, 0);
    id[i] = lab.add(def);
  }
  Explosion explosion;
  explosion.radius = real(10);
  explosion.impulse = scaled(30);
  ASSERT_OK(explode(lab.world, explosion));
  for (int i = 0; i < 4; ++i) {
    const double gap = fabs(x[i]) - radius[i];
    const double impulse = gap < 10 ? 30 * k_pi * radius[i] * radius[i] * (1 - gap / 10) : 0;
    EXPECT_NEAR(lab.motion(id[i]).linear_velocity[0], impulse / 2 * (x[i] > 0 ? 1 : -1), 1e-4) << i;
    EXPECT_EQ(lab.motion(id[i]).linear_velocity[1], 0);
    EXPECT_EQ(lab.motion(id[i]).angular_velocity[2], 0);
  }
}

DETENT_TEST(forces, an_explosion_wakes_whom_it_pushes_and_leaves_the_rest) {
  Lab lab({4, 8, 0}, {}, true);
  lab.add_ground();
  const BodyId near = lab.add_box(0.5, 2, 0.5, 0), far = lab.add_box(0.5, 40, 0.5, 0);
  lab.run(100);
  ASSERT_OK(explode(lab.world, {}));
  bool awake = false;
  ASSERT_OK(is_awake(lab.world, near, awake));
  EXPECT_TRUE(awake);
  ASSERT_OK(is_awake(lab.world, far, awake));
  EXPECT_FALSE(awake);
}

DETENT_TEST(forces, an_explosion_out_of_range_pushes_nobody) {
  Lab lab({3, 8, 0}, weightless());
  BodyDef heavy = ball(0.5, 1e6), light = ball(0.5, 1e-6);
  heavy.position = position(2, 0, 0);
  light.position = position(-2, 0, 0);
  lab.add(heavy);
  const BodyId id = lab.add(light);
  const uint64_t before = digest(lab.world);
  EXPECT_EQ(explode(lab.world, {}), Status::out_of_range);
  Explosion bad;
  bad.radius = real(0);
  EXPECT_EQ(explode(lab.world, bad), Status::out_of_range);
  bad.radius = real(20000);
  EXPECT_EQ(explode(lab.world, bad), Status::out_of_range);
  EXPECT_EQ(digest(lab.world), before);
  ASSERT_OK(destroy_body(lab.world, id));
  EXPECT_OK(explode(lab.world, {}));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
