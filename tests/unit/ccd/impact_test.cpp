#include <math.h>

#include "state/view.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef ball(double mass, double x, double speed) {
  BodyDef def;
  def.shape = sphere(real(0.5));
  def.mass = scaled(mass);
  def.position = position(x, 0, 0);
  def.linear_velocity = reals(speed, 0, 0);
  def.material.restitution = real(1);
  return def;
}

DETENT_TEST(impact, balls_that_meet_head_on_part_as_newton_says) {
  const double error = sizeof(Real) == 4 ? 1e-5 : 1e-6;
  for (const double ratio : {1.0, 3.0, 1000.0, 0.01}) {
    Lab lab({2, 2, 0}, weightless());
    const BodyId a = lab.add(ball(1, -0.75, 2)), b = lab.add(ball(ratio, 0.75, -1));
    lab.run(60);
    const double mean = (2 - ratio) / (1 + ratio);  // speed of the centre of mass, which each speed is mirrored at
    EXPECT_NEAR(lab.motion(a).linear_velocity[0], 2 * mean - 2, 3 * error) << ratio;
    EXPECT_NEAR(lab.motion(b).linear_velocity[0], 2 * mean + 1, 3 * error) << ratio;
    EXPECT_NEAR(lab.motion(a).linear_velocity[1], 0, error);
  }
}

DETENT_TEST(impact, balls_that_meet_off_centre_without_friction_exchange_what_lies_along_the_line_of_centres) {
  Lab lab({2, 2, 0}, weightless());
  BodyDef moving = ball(1, -2, 2), resting = ball(1, 0, 0);
  moving.position = position(-2, 0.5, 0);
  moving.material.friction = resting.material.friction = real(0);
  const BodyId a = lab.add(moving), b = lab.add(resting);
  lab.run(120);
  const Motion first = lab.motion(a), second = lab.motion(b);
  EXPECT_NEAR(first.linear_velocity[0] + second.linear_velocity[0], 2, 1e-5);
  EXPECT_NEAR(first.linear_velocity[1] + second.linear_velocity[1], 0, 1e-5);
  const double product =
      first.linear_velocity[0] * second.linear_velocity[0] + first.linear_velocity[1] * second.linear_velocity[1];
  EXPECT_NEAR(product, 0, 1e-3) << "equal balls part at a right angle";
  EXPECT_NEAR(second.linear_velocity[1] / second.linear_velocity[0], -tan(asin(0.5)), 0.05);
}

struct Sums {
  Vector linear = {{0, 0, 0}}, angular = {{0, 0, 0}};
  double linear_size = 0, angular_size = 0;  ///< of the parts, to measure errors by
};

std::vector<Vector> positions_in(Lab& lab) {
  std::vector<Vector> result;
  for (const BodyPose& pose : view_of(lab.world).poses) result.push_back(difference(pose.position, Position{}));
  return result;
}

/// Momentum, and angular momentum about the origin for bodies at `positions`.
Sums sums_of(Lab& lab, const std::vector<Vector>& positions) {
  Sums sums;
  const auto state = view_of(lab.world);
  for (uint32_t i = 0; i < state.world.slots_used; ++i) {
    const double mass = scaled_to_host(state.properties[i].mass);
    const Vector linear = host(state.motions[i].linear_velocity) * mass;
    const Vector own = host(state.motions[i].angular_momentum) * (mass * unit_of(state.properties[i]));
    const Vector orbital = cross(positions[i], linear);
    sums.linear = sums.linear + linear;
    sums.angular = sums.angular + orbital + own;
    sums.linear_size += length(linear);
    sums.angular_size += length(orbital) + length(own);
  }
  return sums;
}

DETENT_TEST(impact, an_isolated_cluster_keeps_its_momentum) {
  Samples samples = {51};
  WorldDef world = weightless();
  world.continuous = false;  // impacts within a tick act where the bodies are then, not where it began
  Lab lab({27, 400, 0}, world);
  for (int i = 0; i < 27; ++i) {
    const Vector at = {{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0}};
    const Vector half = {{uniform(samples, 0.2, 0.45), uniform(samples, 0.2, 0.45), uniform(samples, 0.2, 0.45)}};
    BodyDef def;
    def.shape = box(reals_near(half));
    def.position = position_near(at * 1.2);
    def.rotation = rotation_near(any_rotation(samples));
    def.linear_velocity = reals_near(at * -1.5 + any_direction(samples));
    def.angular_velocity = reals_near(any_direction(samples) * 2);
    lab.add(def);
  }
  const Sums start = sums_of(lab, positions_in(lab));
  Vector torque = {{0, 0, 0}};
  uint32_t contacts = 0;
  for (int tick = 0; tick < 240; ++tick) {
    const std::vector<Vector> positions = positions_in(lab);
    const Sums before = sums_of(lab, positions);
    contacts += lab.run(1).contacts.count;
    torque = torque + (sums_of(lab, positions).angular - before.angular);
  }
  const Sums end = sums_of(lab, positions_in(lab));
  EXPECT_GT(contacts, 500u);
  EXPECT_LT(length(end.linear - start.linear) / start.linear_size, 1e-6);
  EXPECT_LT(length(torque) / start.angular_size, 1e-6) << "every impulse acts on both bodies at one point";
  // The contact point is kept for a tick while the bodies pass each other: the error is of the order of the tick.
  const double drift = length(end.angular - start.angular) / start.angular_size;
  ::testing::Test::RecordProperty("angular_drift", ::testing::PrintToString(drift));
  ::testing::Test::RecordProperty("torque", ::testing::PrintToString(length(torque) / start.angular_size));
  EXPECT_LT(drift, 0.1);
}

/// Five boxes of 1 m on the ground, created in the given order, must stand for ten seconds.
void expect_stack_stands(const int (&order)[5]) {
  Lab lab({6, 20, 0});
  lab.add_ground();
  std::vector<BodyId> ids;
  std::vector<Motion> start;
  for (const int level : order) ids.push_back(lab.add_box(0.5, 0, 0.5 + level, 0));
  for (const BodyId id : ids) start.push_back(lab.motion(id));
  double speed = 0;
  for (int tick = 0; tick < 600; ++tick) {
    EXPECT_TRUE(lab.run(1).complete());
    if (tick < 60) continue;
    for (const BodyId id : ids) {
      const Motion motion = lab.motion(id);
      speed +=
          length(Vector{{motion.linear_velocity[0], motion.linear_velocity[1], motion.linear_velocity[2]}}) / (540 * 5);
    }
  }
  EXPECT_LT(speed, 1e-3);
  for (size_t i = 0; i < ids.size(); ++i) {
    const Motion motion = lab.motion(ids[i]);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(motion.position[k], start[i].position[k], 0.01);
  }
}

DETENT_TEST(impact, a_stack_of_five_stands_in_whatever_order_it_was_made) {
  expect_stack_stands({0, 1, 2, 3, 4});
  expect_stack_stands({4, 3, 2, 1, 0});
  expect_stack_stands({2, 4, 0, 3, 1});
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
