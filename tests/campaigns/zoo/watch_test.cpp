#include "tests/campaigns/zoo/watch.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/campaigns/zoo/visit.h"

namespace detent_zoo {
namespace {

constexpr double k_tick = 1.0 / 60;

BodyFrame ball(const Vector& position, const Vector& linear_velocity = {}) {
  BodyFrame body;
  body.kind = Kind::dynamic;
  body.mass = 2;
  body.inertia = {0.5, 0.5, 0.5};
  body.position = position;
  body.linear_velocity = linear_velocity;
  return body;
}

/// A fixed body at the origin and a ball 1 m beside it, without gravity.
Frame pair(Held type, const Vector& linear_velocity = {}) {
  Frame frame;
  frame.tick_time = k_tick;
  frame.bodies = {BodyFrame(), ball({1, 0, 0}, linear_velocity)};
  JointFrame joint;
  joint.type = type;
  joint.b = 1;
  joint.anchor_a = {1, 0, 0};
  frame.joints = {joint};
  return frame;
}

Rotation about(const Vector& axis, double angle) {
  const double sine = sin(angle / 2);
  return {axis.x * sine, axis.y * sine, axis.z * sine, cos(angle / 2)};
}

/// Runs ticks in which nothing changes.
void let_settle(Watch& watch, const Frame& frame) {
  for (int i = 0; i < 30; ++i) watch.tick(frame, {});
}

TEST(zoo_watch, energy_that_comes_from_nowhere_is_a_gain) {
  Frame frame = pair(Held::ball, {0, 1, 0});
  Watch watch(frame);
  frame.bodies[1].linear_velocity = {0, 0.5, 0};
  watch.tick(frame, {});
  frame.bodies[1].linear_velocity = {0, 1, 0};
  watch.tick(frame, {});
  const Figures figures = watch.finish();
  EXPECT_NEAR(figures.gain.value, 0.75, 1e-12) << "over the least before, not over the first";
  EXPECT_EQ(figures.gain.tick, 2u);
}

TEST(zoo_watch, velocities_of_jointed_bodies_belong_to_the_middle_of_the_last_substep) {
  Frame frame = pair(Held::ball, {0, -3, 0});
  frame.gravity = {0, -10, 0};
  frame.bodies[1].position = {1, 5, 0};
  Watch watch(frame);
  // In free fall from the middle of the last of two substeps, a quarter of a tick before the frame.
  frame.bodies[1].position.y -= 3 * k_tick / 4;
  watch.tick(frame, {0, 2, 1, 0, 1});
  EXPECT_NEAR(watch.finish().gain.value, 0, 1e-12);
  EXPECT_NEAR(watch.finish().loss.value, 0, 1e-12);
  watch.tick(frame, {0, 2, 1, 0, 2});
  EXPECT_GT(watch.finish().loss.value, 1e-3) << "of two islands the number of substeps is not known";
}

TEST(zoo_watch, energy_that_goes_is_a_loss_since_the_start_and_a_call_is_none) {
  Frame frame = pair(Held::ball, {0, 2, 0});
  Watch watch(frame);
  frame.bodies[1].linear_velocity = {0, 1, 0};
  watch.calls(frame);
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().loss.value, 0, 1e-12);
  frame.bodies[1].linear_velocity = {0, 0, 0};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().loss.value, 1.0 / 4, 1e-12);
  EXPECT_NEAR(watch.finish().gain.value, 0, 1e-12);
}

TEST(zoo_watch, height_counts_as_energy_and_what_falls_gains_none) {
  Frame frame = pair(Held::ball);
  frame.gravity = {0, -10, 0};
  frame.bodies.push_back(ball({9, 0, 0}));
  Watch watch(frame);
  frame.bodies[1].position = {1, -1.25, 0};
  frame.bodies[1].linear_velocity = {0, -5, 0};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gain.value, 0, 1e-12);
  frame.bodies[1].linear_velocity = {0, -6, 0};
  watch.tick(frame, {});
  const double scale = 0.1 * 4 * 10 * (8 + size_of(frame.bodies[1]));
  EXPECT_NEAR(watch.finish().gain.value, 11 / scale, 1e-12);
}

TEST(zoo_watch, angular_velocity_counts_with_the_inertia_about_the_bodys_own_axes) {
  BodyFrame body = ball({});
  body.inertia = {1, 2, 3};
  body.angular_velocity = {0, 4, 0};
  body.rotation = about({0, 0, 1}, M_PI / 2);
  EXPECT_NEAR(kinetic_energy(body), 0.5 * 1 * 16, 1e-12);
  EXPECT_NEAR(angular_momentum_of(body).y, 4, 1e-12);
}

TEST(zoo_watch, a_motor_may_do_its_work_and_no_more) {
  Frame frame = pair(Held::hinge, {0, 0, 1});
  frame.joints[0].axes[0].force_max = 30;
  frame.joints[0].axes[0].speed = 2;
  Watch watch(frame);
  frame.bodies[1].linear_velocity = {0, 0,
                                     sqrt(2)};  // 1 J more, the work of 30 N m at 2 rad/s in a sixtieth of a second
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gain.value, 0, 1e-12);
  frame.bodies[1].linear_velocity = {0, 0, 2};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gain.value, 1, 1e-12);
}

TEST(zoo_watch, a_brake_does_no_work) {
  Frame frame = pair(Held::hinge, {0, 0, 1});
  frame.joints[0].axes[0].force_max = 1e6;
  Watch watch(frame);
  frame.bodies[1].linear_velocity = {0, 0, 1.1};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gain.value, 0.21, 1e-12);
}

TEST(zoo_watch, a_spring_gives_back_what_it_took) {
  const double rate = 2 * M_PI * 3;
  Frame frame = pair(Held::slider, {rate, 0, 0});
  frame.joints[0].axes[0].frequency = 3;
  Watch watch(frame);
  const Frame start = frame;
  for (int i = 1; i <= 40; ++i) {  // an undamped oscillation of 1 m
    frame.bodies[1].position = {1 + sin(rate * i * k_tick), 0, 0};
    frame.bodies[1].linear_velocity = {rate * cos(rate * i * k_tick), 0, 0};
    watch.tick(frame, {});
  }
  EXPECT_NEAR(watch.finish().gain.value, 0, 1e-12);
}

TEST(zoo_watch, a_call_is_no_gain_and_the_next_tick_is_measured_from_it) {
  Frame frame = pair(Held::ball, {0, 1, 0});
  Watch watch(frame);
  frame.bodies[1].linear_velocity = {0, 3, 0};
  watch.calls(frame);
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gain.value, 0, 1e-12);
  frame.bodies[1].linear_velocity = {0, 6, 0};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gain.value, 3, 1e-12);
}

TEST(zoo_watch, what_is_not_a_number_is_the_worst) {
  Frame frame = pair(Held::ball, {0, 1, 0});
  Watch watch(frame);
  let_settle(watch, frame);
  frame.bodies[1].position.x = frame.bodies[1].linear_velocity.y = std::numeric_limits<double>::quiet_NaN();
  watch.tick(frame, {});
  const Figures figures = watch.finish();
  for (const Worst& worst : {figures.gain, figures.gap, figures.momentum}) EXPECT_TRUE(isinf(worst.value));
}

TEST(zoo_watch, a_gap_counts_from_the_thirty_first_tick_and_over_the_smaller_body) {
  Frame frame = pair(Held::ball);
  Watch watch(frame);
  frame.bodies[1].position = {1, 0.5, 0};
  let_settle(watch, frame);
  EXPECT_EQ(watch.finish().gap.value, 0);
  frame.bodies[1].position = {1, 0.03, 0.04};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().gap_metres.value, 0.05, 1e-12);
  EXPECT_NEAR(watch.finish().gap.value, 0.05 / sqrt(3), 1e-12);
}

TEST(zoo_watch, each_type_of_joint_has_its_own_errors) {
  Frame frame = pair(Held::hinge);
  BodyFrame& body = frame.bodies[1];
  JointFrame& joint = frame.joints[0];
  body.rotation = about({1, 0, 0}, 2);
  EXPECT_NEAR(state_of(joint, frame).angle, 0, 1e-12);
  EXPECT_NEAR(state_of(joint, frame).values[0], 2, 1e-12);
  joint.axes[0].limited = true;
  joint.axes[0].upper = 1.5;
  EXPECT_NEAR(state_of(joint, frame).limit, 0.5, 1e-12);
  joint.type = Held::slider;
  EXPECT_NEAR(state_of(joint, frame).angle, 2, 1e-12);
  joint.type = Held::fixed;
  EXPECT_NEAR(state_of(joint, frame).angle, 2, 1e-12);
  body.rotation = about({0, 1, 0}, 0.25);
  joint.type = Held::hinge;
  EXPECT_NEAR(state_of(joint, frame).angle, 0.25, 1e-12);
  joint.type = Held::cone_twist;
  joint.axes[1].limited = true;
  joint.axes[1].upper = 0.1;
  EXPECT_NEAR(state_of(joint, frame).angle, 0, 1e-12);
  EXPECT_NEAR(state_of(joint, frame).limit, 0.15, 1e-12);
  joint.type = Held::wheel;
  EXPECT_NEAR(state_of(joint, frame).angle, 0.25, 1e-12);
  body.position = {3, 0.5, 0};
  EXPECT_NEAR(state_of(joint, frame).gap, 0.5, 1e-12);
  EXPECT_NEAR(state_of(joint, frame).values[0], 2, 1e-12);
  joint.type = Held::distance;
  joint.axes[0].upper = 2;
  EXPECT_NEAR(state_of(joint, frame).gap, sqrt(4.25) - 2, 1e-12);
}

TEST(zoo_watch, momentum_that_changes_is_told) {
  Frame frame = pair(Held::ball);
  frame.joints.clear();
  frame.bodies = {ball({0, 0, 0}, {0, 1, 0}), ball({2, 0, 0}, {0, -1, 0})};
  Watch watch(frame);
  frame.bodies[0].linear_velocity = {0, 1.1, 0};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().momentum.value, 0.2 / 4, 1e-12);
  frame.bodies[0].linear_velocity = {0, 1, 0};
  frame.bodies[0].angular_velocity = {0, 0, 1};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().angular_momentum.value, 0.5 / 4, 1e-12);
}

/// A ball that lies on a fixed body.
Frame lying(double depth) {
  Frame frame = pair(Held::ball);
  frame.joints.clear();
  frame.contacts = {{0, 1, depth / 2}, {0, 1, depth}};
  return frame;
}

TEST(zoo_watch, thickness_is_the_least_side_of_the_box_of_that_inertia) {
  BodyFrame body = ball({});
  body.inertia = {2.0 / 12 * (4 + 9), 2.0 / 12 * (1 + 9), 2.0 / 12 * (1 + 4)};
  EXPECT_NEAR(thickness_of(body), 1, 1e-12);
  EXPECT_NEAR(thickness_of(ball({})), sqrt(6 * 0.5 / 2), 1e-12);
  body.inertia.y = 0;
  EXPECT_EQ(thickness_of(body), 0);
}

TEST(zoo_watch, what_sinks_in_for_ten_ticks_is_told_and_a_blow_is_no_sinking) {
  const Frame deep = lying(0.3), flat = lying(0.01);
  Watch watch(flat);
  let_settle(watch, flat);
  for (int i = 0; i < 9; ++i) watch.tick(deep, {});
  watch.tick(flat, {});
  const double thickness = thickness_of(flat.bodies[1]);
  EXPECT_NEAR(watch.finish().sunk.value, 0.01 / thickness, 1e-12);
  EXPECT_NEAR(watch.finish().pierced.value, 0.3 / thickness, 1e-12);
  EXPECT_EQ(watch.finish().pierced.tick, 31u);
  for (int i = 0; i < 10; ++i) watch.tick(deep, {});
  EXPECT_NEAR(watch.finish().sunk.value, 0.3 / thickness, 1e-12);
  EXPECT_EQ(watch.finish().sunk.index, 1u);
}

TEST(zoo_watch, what_parts_in_between_has_not_sunk) {
  const Frame deep = lying(0.3), apart = lying(-0.1);
  Watch watch(deep);
  let_settle(watch, apart);
  for (int i = 0; i < 30; ++i) watch.tick(i % 5 == 0 ? apart : deep, {});
  EXPECT_EQ(watch.finish().sunk.value, 0);
}

TEST(zoo_watch, a_body_moves_from_where_it_was_at_tick_30) {
  Frame frame = pair(Held::ball);
  Watch watch(frame);
  frame.bodies[1].position = {1, 5, 0};
  let_settle(watch, frame);
  EXPECT_EQ(watch.finish().moved.value, 0);
  frame.bodies[1].position = {1, 5.3, 0.4};
  watch.tick(frame, {});
  frame.bodies[1].position = {1, 5, 0};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().moved.value, 0.5 / size_of(frame.bodies[1]), 1e-12);
  EXPECT_EQ(watch.finish().moved.tick, 31u);
}

TEST(zoo_watch, a_body_falls_below_0_and_rises_above_its_first_height) {
  Frame frame = pair(Held::ball);
  frame.bodies[1].position = {1, 2, 0};
  Watch watch(frame);
  frame.bodies[1].position = {1, 0.5, 0};
  watch.tick(frame, {});
  EXPECT_EQ(watch.finish().fallen.value, 0);
  EXPECT_EQ(watch.finish().risen.value, 0);
  frame.bodies[1].position = {1, -0.5, 0};
  watch.tick(frame, {});
  frame.bodies[1].position = {1, 2.25, 0};
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().fallen.value, 0.5, 1e-12);
  EXPECT_NEAR(watch.finish().risen.value, 0.25, 1e-12);
  frame.bodies.push_back(ball({1, 9, 0}));
  watch.calls(frame);
  watch.tick(frame, {});
  EXPECT_NEAR(watch.finish().risen.value, 0.25, 1e-12) << "a new body begins where it is made";
}

TEST(zoo_watch, who_wakes_again_does_not_sleep) {
  Frame frame = pair(Held::ball);
  Watch watch(frame);
  watch.tick(frame, {0, 1, 1, 0});
  watch.tick(frame, {0, 0, 0, 0});
  watch.tick(frame, {0, 0, 0, 0});
  EXPECT_EQ(measured(watch.finish(), "asleep"), 2);
  watch.tick(frame, {0, 1, 1, 0});
  EXPECT_TRUE(isinf(measured(watch.finish(), "asleep")));
}

TEST(zoo_watch, a_kinematic_body_that_turns_may_push_what_lies_far_from_its_centre) {
  Frame frame = pair(Held::ball);
  frame.joints.clear();
  frame.gravity = {0, -10, 0};
  frame.bodies[0].kind = Kind::kinematic;
  frame.bodies[0].angular_velocity = {0, 0, 1};
  Watch alone(frame);
  frame.bodies[1].linear_velocity = {0, 1, 0};
  alone.tick(frame, {});
  EXPECT_GT(alone.finish().gain.value, 0.1);
  frame.bodies[1].linear_velocity = {};
  frame.contacts = {{0, 1, 0}};
  Watch touching(frame);
  frame.bodies[1].linear_velocity = {0, 1, 0};
  touching.tick(frame, {});
  EXPECT_EQ(touching.finish().gain.value, 0);
}

}  // namespace
}  // namespace detent_zoo
