#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(motion, an_impulse_through_a_point_gives_speed_and_angular_velocity) {
  Lab lab({1, 1, 0});
  BodyDef def;
  def.shape = sphere(real(0.5));
  def.mass = scaled(2);
  const BodyId id = lab.add(def);
  ASSERT_OK(apply_impulse_at(lab.world, id, scaleds(4, 0, 0), reals(0, 0.25, 0)));
  const Motion motion = lab.motion(id);
  EXPECT_NEAR(motion.linear_velocity[0], 2, 1e-6);
  EXPECT_NEAR(motion.angular_velocity[2], -0.25 * 4 / (0.4 * 2 * 0.25), 1e-5);  // L / I
}

DETENT_TEST(motion, a_force_acts_for_one_step) {
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, def);
  BodyDef body;
  body.mass = scaled(3);
  body.shape = sphere(real(0.5));
  const BodyId id = lab.add(body);
  ASSERT_OK(apply_force(lab.world, id, scaleds(0, 90, 0)));
  ASSERT_OK(apply_torque(lab.world, id, scaleds(0, 0, 6)));
  EXPECT_EQ(lab.motion(id).linear_velocity[1], 0) << "nothing moves before the step";
  lab.run(1);
  EXPECT_NEAR(lab.motion(id).linear_velocity[1], 0.5, 1e-6);
  EXPECT_NEAR(lab.motion(id).angular_velocity[2], 6 / (0.4 * 3 * 0.25) / 60, 1e-6);
  lab.run(1);
  EXPECT_NEAR(lab.motion(id).linear_velocity[1], 0.5, 1e-6);
}

DETENT_TEST(motion, what_is_set_is_what_is_read_back) {
  Lab lab({2, 1, 0});
  const BodyId id = lab.add_box(0.5, 1, 2, 3);
  ASSERT_OK(set_velocity(lab.world, id, reals(1, -2, 3), reals(-4, 5, -6)));
  ASSERT_OK(set_pose(lab.world, id, position(7, 8, 9), {0.5, 0.5, -0.5, 0.5}));
  ASSERT_OK(set_user_data(lab.world, id, 99));
  const Motion motion = lab.motion(id);
  EXPECT_EQ(motion.position[2], 9);
  EXPECT_EQ(motion.linear_velocity[1], -2);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(motion.angular_velocity[i], (i == 1 ? 5 : -4 - i), 1e-5);
  uint32_t user_data = 0;
  ASSERT_OK(get_user_data(lab.world, id, user_data));
  EXPECT_EQ(user_data, 99u);
  Scaled mass{};
  ASSERT_OK(get_mass(lab.world, id, mass));
  EXPECT_NEAR(scaled_to_host(mass), 1000, 1e-3);
}

DETENT_TEST(motion, a_kinematic_body_moves_as_told_and_carries_what_stands_on_it) {
  Lab lab({2, 4, 0});
  BodyDef lift;
  lift.type = BodyType::kinematic;
  lift.shape = box(reals(2, 0.25, 2));
  lift.linear_velocity = reals(0.5, 0, 0);
  const BodyId platform = lab.add(lift);
  const BodyId rider = lab.add_box(0.5, 0, 0.75, 0);
  lab.run(240);
  EXPECT_NEAR(lab.motion(platform).position[0], 2, 1e-4);
  EXPECT_NEAR(lab.motion(rider).linear_velocity[0], 0.5, 1e-3);
  EXPECT_EQ(lab.motion(platform).linear_velocity[0], 0.5);
}

DETENT_TEST(motion, gravity_can_be_changed_and_scaled) {
  Lab lab({2, 1, 0});
  BodyDef floating;
  floating.gravity_scale = real(0);
  floating.position = position(5, 0, 0);
  const BodyId still = lab.add(floating);
  const BodyId falling = lab.add_box(0.5, 0, 0, 0);
  ASSERT_OK(set_gravity(lab.world, reals(6, 0, 0)));
  lab.run(60);
  EXPECT_NEAR(lab.motion(falling).linear_velocity[0], 6, 1e-4);
  EXPECT_EQ(lab.motion(still).linear_velocity[0], 0);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
