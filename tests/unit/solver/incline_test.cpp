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

/// A rod yields three times as much to a force across its axis as to a force along it. Friction and rolling resistance
/// must not depend on the directions of the contact's tangents.
DETENT_TEST(incline, a_capsule_rolls_alike_in_every_direction) {
  double whole = 0;
  for (const double yaw : {0.0, 0.3, 0.7854, 0.9, 1.2, 2.3}) {
    WorldDef world;
    Lab lab({2, 2, 0}, world);
    lab.add_ground(0.6);
    BodyDef def;
    def.shape = capsule(real(0.125), real(0.5));
    def.position = position(0, 0.125, 0);
    const double half = sqrt(0.5);  // the capsule's axis is turned from y to z, then about y
    def.rotation =
        rotation_near(detent_oracle::rotation_by({{0, yaw, 0}}) * detent_oracle::Quaternion{half, 0, 0, half});
    def.linear_velocity = reals(2 * cos(yaw), 0, -2 * sin(yaw));
    def.material.rolling_resistance = real(0.05);
    const BodyId id = lab.add(def);
    const auto speed_of = [](const double(&v)[3]) { return hypot(v[0], hypot(v[1], v[2])); };
    lab.run(60);
    const Motion rolling = lab.motion(id);
    EXPECT_NEAR(speed_of(rolling.angular_velocity) * 0.125 / speed_of(rolling.linear_velocity), 1, 5e-3) << yaw;
    lab.run(360);
    const Motion motion = lab.motion(id);
    EXPECT_LT(speed_of(motion.linear_velocity), 1e-3) << yaw;
    const double path = motion.position[0] * cos(yaw) - motion.position[2] * sin(yaw);
    if (yaw == 0) whole = path;
    EXPECT_NEAR(path / whole, 1, 5e-3) << yaw;
    EXPECT_NEAR(motion.position[0] * sin(yaw) + motion.position[2] * cos(yaw), 0, 5e-3 * whole) << yaw;
  }
}

/// The contact area ends at the side of the table: a plank of 1 m stays with its centre 3 mm inside, and falls with it
/// 3 mm outside.
DETENT_TEST(incline, a_plank_tips_once_its_centre_is_beyond_the_edge_of_a_table) {
  for (const Shape& shape : {box({0.5, 0.03125, 0.25}), rounded(box({0.5, 0.03125, 0.25}), 0.0078125)}) {
    for (const double beyond : {-0.003, 0.003}) {
      for (const double yaw : {0.0, 0.4}) {
        Lab lab({2, 2, 0});
        BodyDef table;
        table.type = BodyType::fixed;
        table.shape = box({1.0, 0.5, 1.0});
        table.position = position(-1, -0.5, 0);
        lab.add(table);
        BodyDef plank;
        plank.shape = shape;
        const double half_height = 0.03125 + (shape.rounding == Real(0.0) ? 0 : 0.0078125);
        plank.position = position(beyond, half_height, 0);
        plank.rotation = rotation_near(detent_oracle::rotation_by({{0, yaw, 0}}));
        const BodyId id = lab.add(plank);
        lab.run(360);
        const double height = lab.motion(id).position[1];
        if (beyond < 0)
          EXPECT_NEAR(height, half_height, 1e-3) << yaw;
        else
          EXPECT_LT(height, -0.5) << yaw;
      }
    }
  }
}

/// Friction opposes the velocity, whichever direction yields most.
DETENT_TEST(incline, a_plank_slides_straight_at_any_angle_to_its_path) {
  for (const double yaw : {0.0, 0.4, 0.7854, 1.2}) {
    Lab lab({2, 2, 0});
    lab.add_ground(0.5);
    BodyDef def;
    def.shape = box({0.125, 0.125, 2.0});
    def.position = position(0, 0.125, 0);
    def.rotation = rotation_near(detent_oracle::rotation_by({{0, yaw, 0}}));
    def.linear_velocity = reals(4, 0, 0);
    def.material.friction = real(0.5);
    const BodyId id = lab.add(def);
    lab.run(120);
    const Motion motion = lab.motion(id);
    const double path = 16 / (2 * 0.5 * k_gravity);
    EXPECT_NEAR(motion.position[0] / path, 1, 0.03) << yaw;  // the first substep has no friction yet
    EXPECT_NEAR(motion.position[2], 0, 0.005) << yaw;
  }
}

/// The support of a small box by the face of a large one ends at the face's side.
DETENT_TEST(incline, a_small_box_falls_off_a_large_table_once_its_centre_is_beyond_the_edge) {
  for (const double size : {1.0, 8.0, 64.0}) {
    for (const double beyond : {-0.005, 0.005}) {
      Lab lab({2, 2, 0});
      BodyDef table;
      table.type = BodyType::fixed;
      table.shape = box(reals(size, 0.5, size));
      table.position = position(-size, -0.5, 0);
      lab.add(table);
      BodyDef die;
      die.shape = box({0.0625, 0.0625, 0.0625});
      die.position = position(beyond, 0.0625, 0);
      const BodyId id = lab.add(die);
      lab.run(240);
      if (beyond < 0)
        EXPECT_NEAR(lab.motion(id).position[1], 0.0625, 1e-3) << size;
      else
        EXPECT_LT(lab.motion(id).position[1], -0.25) << size;
    }
  }
}

DETENT_TEST(incline, a_fast_ball_rolls_over_flush_boxes_and_stays_down) {
  for (const double speed : {3.0, 5.5, 10.0}) {
    for (int step = 0; step < 8; ++step) {
      Lab lab({3, 4, 0});
      for (int i = 0; i < 2; ++i) {
        BodyDef tile;
        tile.type = BodyType::fixed;
        tile.shape = box({1.0, 1.0, 1.0});
        tile.position = position(2 * i, -1, 0);
        lab.add(tile);
      }
      BodyDef ball;
      ball.shape = sphere(real(0.05));
      ball.position = position(0.1 + 0.02 * step, 0.05, 0.3);
      ball.linear_velocity = reals(speed, 0, 0);
      ball.angular_velocity = reals(0, 0, -speed / 0.05);
      const BodyId id = lab.add(ball);
      double highest = 0;
      for (int tick = 0; tick < 40 && lab.motion(id).position[0] < 2.9; ++tick) {
        lab.run(1);
        highest = fmax(highest, lab.motion(id).position[1]);
      }
      EXPECT_LT(highest, 0.0505) << speed << ", " << step;
    }
  }
}

/// A rod strikes a post obliquely: the impact must neither add energy nor depend on the directions of the tangents.
DETENT_TEST(incline, the_friction_of_an_impact_is_alike_in_every_direction) {
  for (const double friction : {0.6, 1.0, 16.0}) {
    double first = 0;
    for (const double yaw : {0.0, 0.5, 0.7854, 1.1, 2.0}) {
      Lab lab({2, 2, 0}, weightless());
      const auto around = [yaw](double x, double y, double z) {
        return position(x * cos(yaw) + z * sin(yaw), y, z * cos(yaw) - x * sin(yaw));
      };
      BodyDef post;
      post.type = BodyType::fixed;
      post.shape = sphere(real(0.05));
      post.position = around(0.95, -0.31, 0);
      post.material.friction = real(friction);
      lab.add(post);
      BodyDef rod;
      rod.shape = box(reals(1, 0.03, 0.03));
      rod.rotation = rotation_near(detent_oracle::rotation_by({{0, yaw, 0}}));
      rod.linear_velocity = reals(4 * cos(yaw) + 4 * sin(yaw), -20, 4 * cos(yaw) - 4 * sin(yaw));
      rod.material.friction = real(friction);
      const BodyId id = lab.add(rod);
      lab.run(1);
      const Motion motion = lab.motion(id);
      // Twice the energy over the mass.
      double energy = 0, spin = 0;
      for (const double v : motion.linear_velocity) energy += v * v;
      for (const double w : motion.angular_velocity) spin += w * w;
      const double along = motion.angular_velocity[0] * cos(yaw) - motion.angular_velocity[2] * sin(yaw);
      energy += (1 + 0.03 * 0.03) / 3 * (spin - along * along) + 2 * 0.03 * 0.03 / 3 * along * along;
      EXPECT_LT(energy, 432) << friction << ", " << yaw;
      EXPECT_LT(motion.linear_velocity[1], 0) << "it has struck";
      EXPECT_GT(motion.linear_velocity[1], -19);
      if (yaw == 0) first = energy;
      EXPECT_NEAR(energy / first, 1, 5e-3) << friction << ", " << yaw;
    }
  }
}

/// A ball that bounces obliquely: with coefficient of restitution e and friction coefficient u, friction takes
/// u (1 + e) times the approach speed, at most 2/7 of the tangential speed. The solver makes the bounce, because the
/// world is not continuous.
DETENT_TEST(incline, a_bounce_of_the_solver_has_the_friction_of_its_rebound) {
  for (const double restitution : {0.5, 1.0}) {
    for (const double friction : {0.125, 0.25, 1.0}) {
      WorldDef world = weightless();
      world.continuous = false;
      Lab lab({2, 2, 0}, world);
      lab.add_ground(friction);
      BodyDef ball;
      ball.shape = sphere(real(0.5));
      ball.position = position(0, 0.5009765625, 0);
      ball.linear_velocity = reals(3, -2, -4);
      ball.material.friction = real(friction);
      ball.material.restitution = real(restitution);
      const BodyId id = lab.add(ball);
      lab.run(10);
      const Motion motion = lab.motion(id);
      const double taken = fmin(friction * (1 + restitution) * 2, 5.0 * 2 / 7);
      EXPECT_NEAR(motion.linear_velocity[1], 2 * restitution, 0.01);
      EXPECT_NEAR(motion.linear_velocity[0], 3 * (1 - taken / 5), 0.01) << restitution << ", " << friction;
      EXPECT_NEAR(motion.linear_velocity[2], -4 * (1 - taken / 5), 0.01);
    }
  }
}

/// A ball that flies along a groove strikes both walls. The rebound from the smooth wall makes it leave the rough wall
/// faster than the rough wall's own rebound would, so that the impulse of the rough wall becomes smaller. This change
/// has no friction: the ball loses the same speed along the groove as on a rough wall that does not rebound.
DETENT_TEST(incline, a_rebound_that_removes_impulse_has_no_friction) {
  const auto speed_along_groove = [](double restitution) {
    WorldDef world = weightless(1);  // the rebound changes impulses of the last substep
    world.continuous = false;
    Lab lab({3, 3, 0}, world);
    BodyDef ball;
    ball.shape = sphere(real(0.5));
    ball.material.friction = real(0.5);
    const double clearance = 0.5009765625;
    // -5 m/s along the normal of the smooth wall, and -3 along that of the rough one. The normals are 60 degrees apart.
    ball.position = position(0, clearance / cos(M_PI / 6), 0);
    ball.linear_velocity = reals((-5 + 3) / (2 * sin(M_PI / 6)), (-5 - 3) / (2 * cos(M_PI / 6)), 3);
    const auto wall = [&](double angle, double friction, double of_rebound) {
      BodyDef def;
      def.type = BodyType::fixed;
      def.shape = half_space();
      def.rotation = rotation_near(detent_oracle::rotation_by({{0, 0, angle}}));
      def.material.friction = real(friction);
      def.material.restitution = real(of_rebound);
      lab.add(def);
    };
    wall(M_PI / 6, 0.5, restitution);
    wall(-M_PI / 6, 0, 1);
    const BodyId id = lab.add(ball);
    lab.run(10);
    return lab.motion(id).linear_velocity[2];
  };
  const double right = speed_along_groove(0);
  EXPECT_LT(right, 2.9) << "the rough wall brakes it";
  EXPECT_NEAR(speed_along_groove(0.25), right, 1e-3);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
