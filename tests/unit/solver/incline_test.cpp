#include <math.h>

#include "tests/common/oracle/bodies.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_gravity = 9.81;
constexpr double k_slope = 0.3;  ///< rad

/// A slope that descends towards +x, built as a level plane under tilted gravity, so that the rounding of a pose has no
/// effect.
Lab tilted(double friction) {
  WorldDef def;
  def.gravity = reals(k_gravity * sin(k_slope), -k_gravity * cos(k_slope), 0);
  Lab lab({2, 2, 0}, def);
  lab.add_ground(friction);
  return lab;
}

DETENT_TEST(incline, a_box_slides_when_friction_is_one_percent_too_small_and_stays_when_it_is_one_percent_more) {
  for (const double part : {0.99, 1.01}) {
    const double friction = part * tan(k_slope);
    Lab lab = tilted(friction);
    BodyDef def;
    def.shape = box(reals(0.5, 0.25, 0.5));
    def.position = position(0, 0.25, 0);
    def.material.friction = real(friction);
    const BodyId id = lab.add(def);
    lab.run(60);
    const double speed = lab.motion(id).linear_velocity[0];
    lab.run(180);
    const Motion motion = lab.motion(id);
    if (part < 1) {
      // The first substep has no friction yet, so the gain of speed is measured from the end of the first second.
      EXPECT_NEAR(motion.linear_velocity[0] - speed, 3 * k_gravity * (sin(k_slope) - friction * cos(k_slope)), 0.001);
      EXPECT_NEAR(speed, k_gravity * (sin(k_slope) - friction * cos(k_slope)), k_gravity * sin(k_slope) / 120);
    } else {
      EXPECT_NEAR(motion.linear_velocity[0], 0, 1e-4);
      EXPECT_NEAR(motion.position[0], 0, 0.01);
    }
  }
}

DETENT_TEST(incline, a_sliding_box_brakes_by_friction_and_stops) {
  WorldDef world;
  world.substeps = 4;  // until the first of them ends there is less friction
  Lab lab({2, 2, 0}, world);
  lab.add_ground(0.5);
  BodyDef def;
  def.shape = box(reals(0.5, 0.25, 0.5));
  def.position = position(0, 0.25, 0);
  def.linear_velocity = reals(3, 0, -4);
  def.material.friction = real(0.5);
  const BodyId id = lab.add(def);
  lab.run(60);
  EXPECT_NEAR(lab.motion(id).linear_velocity[0], (5 - 0.5 * k_gravity) * 0.6, 0.01);
  lab.run(60);
  for (const double v : lab.motion(id).linear_velocity) EXPECT_NEAR(v, 0, 1e-4);
  const double displacement = 25 / (2 * 0.5 * k_gravity);
  EXPECT_NEAR(lab.motion(id).position[0], 0.6 * displacement, 0.02);
  EXPECT_NEAR(lab.motion(id).position[2], -0.8 * displacement, 0.02);
}

DETENT_TEST(incline, a_ball_rolls_down_at_five_sevenths_of_the_slopes_pull) {
  Lab lab = tilted(0.6);
  BodyDef def;
  def.shape = sphere(real(0.25));
  def.position = position(0, 0.25, 0);
  const BodyId id = lab.add(def);
  lab.run(240);
  const double right = 5.0 / 7 * k_gravity * sin(k_slope) * 4;
  const Motion motion = lab.motion(id);
  EXPECT_NEAR(motion.linear_velocity[0] / right, 1, 2e-3);
  EXPECT_NEAR(-motion.angular_velocity[2] * 0.25 / motion.linear_velocity[0], 1, 2e-3) << "it does not slip";
}

DETENT_TEST(incline, a_ball_on_a_slope_with_enough_rolling_resistance_stays) {
  // The larger coefficient of the two materials counts: usually the ground has none.
  for (const double part : {0.9, 1.1, -0.9, -1.1}) {
    WorldDef world;
    world.gravity = reals(k_gravity * sin(0.05), -k_gravity * cos(0.05), 0);
    Lab lab({2, 2, 0}, world);
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = half_space();
    ground.material.rolling_resistance = real(part < 0 ? 0 : 0.5 * part * tan(0.05));
    lab.add(ground);
    BodyDef def;
    def.shape = sphere(real(0.25));
    def.position = position(0, 0.25, 0);
    def.material.rolling_resistance = real(fabs(part) * tan(0.05));
    const BodyId id = lab.add(def);
    lab.run(240);
    const double right = fmax(5.0 / 7 * k_gravity * (1 - fabs(part)) * sin(0.05) * 4, 0);
    EXPECT_NEAR(lab.motion(id).linear_velocity[0], right, 0.01) << part;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
