#include <math.h>

#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

// Errors of a sum over a few hundred ticks, relative to its largest part: the rounding of a velocity or a position at
// each substep, in the same direction at worst.
constexpr double k_sum_error = sizeof(Real) == 4 ? 2e-5 : 1e-8;
// get_motion() returns the position without the remainder that fx32 stores.
constexpr double k_position_step = sizeof(Coord) == 4 ? 0x1p-16 : 0;

BodyDef ball(double radius, double x, double y) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.position = position(x, y, 0);
  return def;
}

DETENT_TEST(flight, a_projectile_follows_the_parabola) {
  Lab lab({1, 1, 0});
  BodyDef def = ball(0.5, 0, 100);
  def.linear_velocity = reals(3, 4, -5);
  const BodyId id = lab.add(def);
  lab.run(240);
  const double t = 4, g = -9.81;
  const Motion motion = lab.motion(id);
  EXPECT_NEAR(motion.linear_velocity[1], 4 + g * t, 40 * k_sum_error);
  EXPECT_NEAR(motion.position[0], 3 * t, 100 * k_sum_error + k_position_step);
  EXPECT_NEAR(motion.position[1], 100 + 4 * t + g * t * t / 2, 100 * k_sum_error + k_position_step);
  EXPECT_NEAR(motion.position[2], -5 * t, 100 * k_sum_error + k_position_step);
}

DETENT_TEST(flight, damping_divides_speed_and_angular_velocity_by_one_plus_rate_times_substep_every_substep) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  world.substeps = 4;
  Lab lab({1, 1, 0}, world);
  BodyDef def = ball(0.5, 0, 0);
  def.linear_velocity = reals(8, 0, 0);
  def.angular_velocity = reals(0, 6, 0);
  def.linear_damping = real(0.5);
  def.angular_damping = real(2);
  const BodyId id = lab.add(def);
  constexpr int k_ticks = 120;
  lab.run(k_ticks);
  const double h = 1.0 / 240;
  EXPECT_NEAR(lab.motion(id).linear_velocity[0], 8 * pow(1 + 0.5 * h, -4 * k_ticks), 8 * k_sum_error);
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 6 * pow(1 + 2 * h, -4 * k_ticks), 6 * k_sum_error);
}

DETENT_TEST(flight, a_kinematic_wall_pushes_what_stands_before_it_and_is_not_slowed) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Lab lab({2, 2, 0}, world);
  BodyDef wall;
  wall.type = BodyType::kinematic;
  wall.shape = box(reals(0.5, 2, 2));
  wall.linear_velocity = reals(2, 0, 0);
  const BodyId pusher = lab.add(wall);
  BodyDef crate;
  crate.shape = box(reals(0.5, 0.5, 0.5));
  crate.position = position(1.5, 0, 0);
  crate.mass = scaled(1e5);
  const BodyId pushed = lab.add(crate);
  lab.run(120);
  EXPECT_NEAR(lab.motion(pusher).position[0], 4, 100 * k_sum_error + k_position_step);
  EXPECT_EQ(lab.motion(pusher).linear_velocity[0], 2);
  // With one sweep in a substep, a part of the velocity that separated the first overlap remains.
  EXPECT_NEAR(lab.motion(pushed).linear_velocity[0], 2, 0.02);
  EXPECT_NEAR(lab.motion(pushed).position[0] - lab.motion(pusher).position[0], 1, 0.05);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
