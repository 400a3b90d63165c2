#include <math.h>

#include "tests/common/oracle/bodies.h"
#include "tests/unit/world/lab.h"

/// The arms of contacts move during a tick. Arms as at the start of a tick would lag by half a tick on average.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_gravity = 9.81;

double speed_of(const double (&v)[3]) { return hypot(v[0], hypot(v[1], v[2])); }

DETENT_TEST(arms, a_turntable_carries_bodies_round_at_their_radius) {
  for (const double turning : {0.4, -0.8}) {
    for (const Shape& shape :
         {box({0.25, 0.125, 0.25}), cylinder(0.25, 0.125), rounded(box({0.25, 0.0625, 0.25}), 0.0625)}) {
      Lab lab({2, 2, 0});
      BodyDef table;
      table.type = BodyType::kinematic;
      table.shape = cylinder(4.0, 0.25);
      table.position = position(0, -0.25, 0);
      table.angular_velocity = reals(0, turning, 0);
      lab.add(table);
      BodyDef rider;
      rider.shape = shape;
      rider.position = position(3, 0.125, 0);
      rider.linear_velocity = reals(0, 0, -3 * turning);
      rider.angular_velocity = reals(0, turning, 0);
      const BodyId id = lab.add(rider);
      lab.run(600);
      const Motion motion = lab.motion(id);
      EXPECT_NEAR(hypot(motion.position[0], motion.position[2]), 3, 2e-3) << turning;
    }
  }
}

/// A coin whose centre moves in a circle of radius R leans by the angle a, with turning^2 (3/2 R + r/4 sin a) =
/// g tan a. It rolls without slipping, so it keeps its energy.
DETENT_TEST(arms, a_coin_that_leans_keeps_its_energy_in_a_circle) {
  constexpr double k_radius = 0.125, k_half = 0.00390625;
  const double cases[][2] = {{0.2, 6}, {0.4, 2}, {0.4, 6}, {0.7, 6}};
  for (const auto& [lean, circle] : cases) {
    Lab lab({2, 2, 0});
    lab.add_ground(2);
    BodyDef coin;
    coin.shape = cylinder(real(k_radius), real(k_half));
    coin.material.friction = real(2);
    coin.position = position(0, k_radius * cos(lean) + k_half * sin(lean), 0);
    coin.rotation = rotation_near(detent_oracle::rotation_by({{0, 0, lean - M_PI / 2}}));
    const double turning = -sqrt(k_gravity * tan(lean) / (k_radius * (1.5 * circle + 0.25 * sin(lean))));
    const double spin = -turning * (circle + sin(lean));
    coin.linear_velocity = reals(0, 0, -turning * circle * k_radius);
    coin.angular_velocity = reals(spin * cos(lean), spin * sin(lean) + turning, 0);
    const BodyId id = lab.add(coin);
    const auto energy = [&] {
      const Motion motion = lab.motion(id);
      Pose pose;
      EXPECT_OK(get_pose(lab.world, id, pose));
      Vec3<Real> linear_velocity, angular_velocity;
      EXPECT_OK(get_velocity(lab.world, id, linear_velocity, angular_velocity));
      const double own = real_to_host(vector_to_local(pose.rotation, angular_velocity).y);
      const double v = speed_of(motion.linear_velocity), w = speed_of(motion.angular_velocity);
      const double across = k_radius * k_radius / 4 + k_half * k_half / 3, along = k_radius * k_radius / 2;
      return k_gravity * motion.position[1] + 0.5 * (v * v + along * own * own + across * (w * w - own * own));
    };
    const double start = energy();
    double highest = start;
    for (int tick = 0; tick < 120; ++tick) {
      lab.run(1);
      highest = fmax(highest, energy());
    }
    EXPECT_LT(highest / start, 1.006) << lean << ", " << circle;
    EXPECT_GT(energy() / start, 0.94) << lean << ", " << circle;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
