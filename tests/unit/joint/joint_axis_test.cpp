#include <algorithm>

#include "tests/unit/joint/joint_lab.h"
#include "tests/unit/math/samples.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A wheel of radius 0.5 m and width 1 m on a fixed axle along z.
struct Flywheel {
  Lab lab = Lab(room(2, 1), weightless());
  BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  BodyId wheel = add_shape(lab, sphere(real(0.5)), 0, 0, 0);
  JointId joint;
  double inertia = 0;

  explicit Flywheel(const JointAxis& axis) {
    JointDef rest;
    rest.axis = axis;
    joint = add_joint(lab, JointType::hinge, ground, wheel, 0, 0, 0, rest, k_x_to_z);
    Scaled mass;
    EXPECT_OK(get_mass(lab.world, wheel, mass));
    inertia = 0.4 * scaled_to_host(mass) * 0.25;
  }
  double speed() { return lab.motion(wheel).angular_velocity[2]; }
  double angle() { return joint_ends(lab.world, joint).turned(0); }
};

DETENT_TEST(joint, a_hinge_motor_gains_speed_by_its_torque_and_then_holds_it) {
  JointAxis axis;
  axis.speed = real(3);
  axis.force_max = scaled(20);
  Flywheel flywheel(axis);
  const double gain = 20 / flywheel.inertia / 60;
  for (int tick = 1; tick * gain < 2.9; ++tick) {
    flywheel.lab.run(1);
    ASSERT_NEAR(flywheel.speed(), tick * gain, 1e-3 * tick * gain) << tick;
  }
  flywheel.lab.run(60);
  EXPECT_NEAR(flywheel.speed(), 3, 1e-3);
  JointReaction reaction;
  ASSERT_OK(get_joint_reaction(flywheel.lab.world, flywheel.joint, reaction));
  EXPECT_NEAR(scaled_to_host(reaction.torque.z), 0, 0.05);
}

DETENT_TEST(joint, a_hinge_spring_swings_with_its_frequency_and_damping) {
  for (const double damping : {0.05, 0.3, 1.0}) {
    JointAxis axis;
    axis.frequency = real(0.5);
    axis.damping_ratio = real(damping);
    axis.target = real(0.8);
    Flywheel flywheel(axis);
    const double rate = 2 * k_pi * 0.5, decay = damping * rate;
    double worst = 0;
    for (int tick = 1; tick <= 240; ++tick) {
      flywheel.lab.run(1);
      const double t = tick / 60.0;
      double off = 0;
      if (damping < 1) {
        const double damped = std::sqrt(rate * rate - decay * decay);
        off = std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t));
      } else {
        off = std::exp(-rate * t) * (1 + rate * t);
      }
      worst = std::max(worst, std::abs(flywheel.angle() - 0.8 * (1 - off)));
    }
    EXPECT_LE(worst, 0.045 * 0.8) << damping;  // solved implicitly, a spring damps by rate x substep / 2 more
  }
}

/// A ball joint whose spring rotates B's frame to A's: the target rotation of B is `frame_a`.
struct BallSpring {
  Lab lab = Lab(room(2, 1), weightless());
  BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  BodyId ball = add_shape(lab, sphere(real(0.5)), 0, 0, 0);
  JointId joint;
  double inertia = 0;

  BallSpring(double frequency, double damping, double torque, const Quat& target) {
    JointDef def;
    def.type = JointType::ball;
    def.a = ground;
    def.b = ball;
    def.frame_a = target;
    def.axis.frequency = real(frequency);
    def.axis.damping_ratio = real(damping);
    def.axis.force_max = scaled(torque);
    EXPECT_OK(create_joint(lab.world, def, joint));
    Scaled mass;
    EXPECT_OK(get_mass(lab.world, ball, mass));
    inertia = 0.4 * scaled_to_host(mass) * 0.25;
  }
  /// The remaining rotation to the target.
  double off() {
    JointDef def;
    Pose pose;
    EXPECT_OK(get_joint(lab.world, joint, def));
    EXPECT_OK(get_pose(lab.world, ball, pose));
    const Turned is(pose.rotation), target(def.frame_a);
    const double cosine = std::abs(dot(is.vector, target.vector) + is.w * target.w);
    return 2 * std::acos(std::min(1.0, cosine));
  }
};

DETENT_TEST(joint, the_spring_of_a_ball_joint_turns_to_any_rotation_with_its_frequency_and_damping) {
  const Quat target = {0.36, -0.48, 0.0, 0.8};  // by 1.287 rad
  for (const double frequency : {0.5, 8.0}) {
    for (const double damping : {0.3, 1.0}) {
      BallSpring spring(frequency, damping, 0, target);
      const double whole = 2 * std::acos(0.8), rate = 2 * k_pi * frequency, decay = damping * rate;
      EXPECT_NEAR(spring.off(), whole, 1e-6);
      double worst = 0;
      for (int tick = 1; tick <= 240; ++tick) {
        spring.lab.run(1);
        const double t = tick / 60.0, damped = std::sqrt(std::abs(rate * rate - decay * decay));
        const double left = damping < 1
                                ? std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t))
                                : std::exp(-rate * t) * (1 + rate * t);
        worst = std::max(worst, std::abs(spring.off() - whole * std::abs(left)));
      }
      if (frequency < 1) {
        EXPECT_LE(worst, 0.045 * whole) << damping;
      }
      EXPECT_LE(spring.off(), damping < 1 && frequency < 1 ? 0.05 : 1e-3);
      const double turned = spring.off();
      JointDef def;
      ASSERT_OK(get_joint(spring.lab.world, spring.joint, def));
      def.frame_a = {0.0, 0.0, 0.6, 0.8};
      ASSERT_OK(set_joint(spring.lab.world, spring.joint, def));
      EXPECT_GT(spring.off(), 1 + turned) << "another target";
      spring.lab.run(480);
      EXPECT_LE(spring.off(), 1e-3);
    }
  }
}

DETENT_TEST(joint, the_spring_of_a_ball_joint_gives_no_more_torque_than_it_may) {
  for (const double frequency : {0.5, 8.0}) {
    BallSpring spring(frequency, 0, 2, {0.0, 0.0, 0.96, 0.28});
    spring.lab.run(6);
    const Motion motion = spring.lab.motion(spring.ball);
    EXPECT_NEAR(motion.angular_velocity[2], 2 / spring.inertia * 0.1, 0.01 * 2 / spring.inertia * 0.1);
    EXPECT_NEAR(motion.angular_velocity[0], 0, 1e-6);
    EXPECT_NEAR(motion.angular_velocity[1], 0, 1e-6);
  }
}

DETENT_TEST(joint, a_slider_motor_lifts_what_it_can_and_no_more) {
  Lab lab(room(2, 1));
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  BodyDef load;
  load.shape = box(reals(0.2, 0.2, 0.2));
  load.mass = scaled(10);
  load.position = position(0, 1, 0);
  const BodyId lift = lab.add(load);
  JointDef rest;
  rest.axis.speed = real(0.5);
  rest.axis.force_max = scaled(10 * 9.81 + 50);
  const JointId joint = add_joint(lab, JointType::slider, ground, lift, 0, 0, 0, rest, k_x_to_y);
  for (int tick = 1; tick <= 5; ++tick) {
    lab.run(1);
    EXPECT_NEAR(lab.motion(lift).linear_velocity[1], 5 * tick / 60.0, 1e-4);
  }
  lab.run(60);
  EXPECT_NEAR(lab.motion(lift).linear_velocity[1], 0.5, 1e-3);
  JointReaction reaction;
  ASSERT_OK(get_joint_reaction(lab.world, joint, reaction));
  EXPECT_NEAR(scaled_to_host(reaction.force.y), 98.1, 0.01);
  JointDef weaker;
  ASSERT_OK(get_joint(lab.world, joint, weaker));
  weaker.axis.force_max = scaled(98.1 - 10);
  ASSERT_OK(set_joint(lab.world, joint, weaker));
  lab.run(30);
  EXPECT_NEAR(lab.motion(lift).linear_velocity[1], 0.5 - 0.5, 5e-3) << "1 m/s^2 too little";
}

DETENT_TEST(joint, friction_brakes_turns_and_then_holds_them) {
  for (const JointType type : {JointType::ball, JointType::hinge, JointType::cone_twist}) {
    SCOPED_TRACE(static_cast<int>(type));
    Lab lab(room(2, 1), weightless());
    const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
    const BodyId wheel = add_shape(lab, sphere(real(0.5)), 0, 0, 0);
    JointDef rest;
    rest.friction_torque = scaled(20);
    add_joint(lab, type, ground, wheel, 0, 0, 0, rest, k_x_to_z);
    Scaled mass;
    ASSERT_OK(get_mass(lab.world, wheel, mass));
    ASSERT_OK(set_velocity(lab.world, wheel, reals(0, 0, 0), reals(0, 0, 0.5)));
    lab.run(30);
    const double slower = 20 / (0.4 * scaled_to_host(mass) * 0.25) * 0.5;
    EXPECT_NEAR(lab.motion(wheel).angular_velocity[2], 0.5 - slower, 0.01 * slower);
    lab.run(90);
    EXPECT_NEAR(lab.motion(wheel).angular_velocity[2], 0, 1e-6);
  }
}

DETENT_TEST(joint, friction_holds_a_weight_that_it_can_bear) {
  for (const JointType type : {JointType::ball, JointType::hinge, JointType::cone_twist, JointType::slider}) {
    for (const double share : {0.9, 1.1}) {
      SCOPED_TRACE(static_cast<int>(type));
      Lab lab(room(2, 1));
      const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
      const BodyId bob = add_shape(lab, sphere(real(0.1)), 1, 0, 0);
      Scaled mass;
      ASSERT_OK(get_mass(lab.world, bob, mass));
      JointDef rest;  // at the arm of 1 m, or down the slide
      rest.friction_torque = rest.friction_force = scaled(share * 9.81 * scaled_to_host(mass));
      add_joint(lab, type, ground, bob, 0, 0, 0, rest, type == JointType::slider ? k_x_to_y : k_x_to_z);
      lab.run(120);
      const double fallen = -lab.motion(bob).position[1];
      if (share > 1)
        EXPECT_LE(std::abs(fallen), 2e-3);
      else
        EXPECT_GE(fallen, 0.5);
    }
  }
}

DETENT_TEST(joint, brakes_and_motors_bear_what_lies_on_them_as_far_as_they_can) {
  for (const bool motor : {false, true}) {
    for (const double share : {0.9, 1.1}) {
      SCOPED_TRACE(motor);
      Lab lab(room(3, 1));
      const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
      BodyDef def;
      def.shape = box(reals(1, 0.1, 1));
      def.mass = scaled(10);
      def.position = position(0, 2, 0);
      const BodyId plate = lab.add(def);
      def.shape = box(reals(0.5, 0.5, 0.5));
      def.mass = scaled(40);
      def.position = position(0, 2.6, 0);
      lab.add(def);
      JointDef rest;
      (motor ? rest.axis.force_max : rest.friction_force) = scaled((10 + share * 40) * 9.81);
      add_joint(lab, JointType::slider, ground, plate, 0, 0, 0, rest, k_x_to_y);
      lab.run(60);
      const double fallen = 2 - lab.motion(plate).position[1];
      EXPECT_NEAR(fallen, share > 1 ? 0 : 0.1 * 40 * 9.81 / 50 / 2, 0.02);
    }
  }
}

DETENT_TEST(joint, a_filter_joint_keeps_its_bodies_from_colliding_and_holds_nothing) {
  Lab lab({3, 16, 1, true, 1}, {}, true);
  const BodyId ground = add_shape(lab, box(reals(5, 0.5, 5)), 0, -0.5, 0, BodyType::fixed);
  const BodyId lower = lab.add_box(0.5, 0, 0.5, 0), upper = lab.add_box(0.25, 0, 1.5, 0);
  JointDef rest;
  add_joint(lab, JointType::filter, lower, upper, 0, 0, 0, rest);
  lab.run(20);
  ASSERT_OK(set_velocity(lab.world, upper, reals(0.5, -1, 0), reals(0, 0, 0)));
  for (int tick = 0; tick < 40; ++tick) {
    lab.run(1);
    EXPECT_NEAR(lab.motion(lower).position[1], 0.5, 1e-3);
    EXPECT_NEAR(lab.motion(lower).position[0], 0, 1e-4);
  }
  EXPECT_NEAR(lab.motion(upper).position[1], 0.25, 0.01) << "on the ground, within the lower";
  bool awake = true;
  for (int tick = 0; tick < 240 && awake; ++tick) {
    lab.run(1);
    ASSERT_OK(is_awake(lab.world, lower, awake));
  }
  EXPECT_FALSE(awake);
  ASSERT_OK(set_velocity(lab.world, upper, reals(0.5, 0, 0), reals(0, 0, 0)));
  lab.run(1);
  ASSERT_OK(is_awake(lab.world, lower, awake));
  EXPECT_FALSE(awake) << "it sleeps by itself";
  EXPECT_TRUE(is_valid(lab.world, ground));
}

DETENT_TEST(joint, limits_stop_what_they_limit_and_push_only_one_way) {
  JointAxis axis;
  axis.limited = true;
  axis.lower = real(-0.5);
  axis.upper = real(0.75);
  Flywheel flywheel(axis);
  ASSERT_OK(set_velocity(flywheel.lab.world, flywheel.wheel, reals(0, 0, 0), reals(0, 0, 2)));
  double most = 0, least = 0;
  for (int tick = 0; tick < 60; ++tick) {
    flywheel.lab.run(1);
    most = std::max(most, flywheel.angle());
  }
  EXPECT_NEAR(most, 0.75, 0.001);
  EXPECT_NEAR(flywheel.angle(), 0.75, 0.002) << "it stays there";
  ASSERT_OK(set_velocity(flywheel.lab.world, flywheel.wheel, reals(0, 0, 0), reals(0, 0, -2)));
  flywheel.lab.run(15);
  EXPECT_NEAR(flywheel.angle(), 0.25, 0.02) << "nothing holds it back";
  for (int tick = 0; tick < 60; ++tick) {
    flywheel.lab.run(1);
    least = std::min(least, flywheel.angle());
  }
  EXPECT_NEAR(least, -0.5, 0.001);
}

/// The initial velocity does not rotate the arm. Only the solved motion shows that the arm will rotate, and beyond its
/// limit.
DETENT_TEST(joint, a_limit_holds_in_the_substep_in_which_holding_the_joint_turns_the_arm_towards_it) {
  Lab lab(room(2, 1), weightless());
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId arm = add_shape(lab, box(reals(0.5, 0.05, 0.05)), 0.5, 0, 0);
  JointDef rest;
  rest.axis.limited = true;
  rest.axis.upper = real(0.02);
  const JointId joint = add_joint(lab, JointType::hinge, ground, arm, 0, 0, 0, rest, k_x_to_z);
  ASSERT_OK(set_velocity(lab.world, arm, reals(0, 20, 0), reals(0, 0, 0)));
  lab.run(1);
  EXPECT_LE(joint_ends(lab.world, joint).turned(0), 0.03);
}

DETENT_TEST(joint, motors_and_springs_leave_a_limit_that_they_start_from) {
  for (const bool spring : {false, true}) {
    for (const double displacement : {1.0, -1.0}) {
      JointAxis axis;
      axis.limited = true;
      axis.lower = real(displacement > 0 ? 0 : -1);
      axis.upper = real(displacement > 0 ? 1 : 0);
      if (spring) {
        axis.frequency = real(1);
        axis.target = real(0.5 * displacement);
      } else {
        axis.speed = real(displacement);
        axis.force_max = scaled(1000);
      }
      Flywheel flywheel(axis);
      flywheel.lab.run(30);
      EXPECT_GT(flywheel.angle() * displacement, 0.3) << spring << displacement;
    }
  }
}

DETENT_TEST(joint, what_a_type_does_not_leave_free_is_not_driven) {
  for (const JointType type : k_joint_types) {
    JointDef rest;
    JointAxis* const axes[2] = {&rest.axis, &rest.second};
    for (JointAxis* axis : axes) {
      axis->limited = true;
      axis->lower = real(-0.5);
      axis->upper = real(0.5);
      axis->frequency = real(30);
      axis->speed = real(3);
      axis->force_max = scaled(100);
    }
    Pair pair(type, rest);
    for (int tick = 0; tick < 60; ++tick) EXPECT_EQ(pair.lab.run(1).saturations, 0u);
  }
}

DETENT_TEST(joint, a_rope_is_slack_until_it_is_taut) {
  Lab lab(room(2, 1));
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId ball = add_shape(lab, sphere(real(0.1)), 0, -0.5, 0);
  JointDef def;
  def.type = JointType::distance;
  def.a = ground;
  def.b = ball;
  def.axis.limited = true;
  def.axis.upper = real(2);
  JointId joint;
  ASSERT_OK(create_joint(lab.world, def, joint));
  lab.run(20);
  EXPECT_NEAR(lab.motion(ball).linear_velocity[1], -9.81 / 3, 1e-3) << "it falls freely";
  double lowest = 0;
  for (int tick = 0; tick < 120; ++tick) {
    lab.run(1);
    lowest = std::min(lowest, lab.motion(ball).position[1]);
  }
  EXPECT_NEAR(lowest, -2, 0.002);
  EXPECT_NEAR(lab.motion(ball).position[1], -2, 1e-3);
}

/// A rod from a fixed point to a ball, whose anchor is at the end of a long arm. At the start the rod pulls along the
/// arm, after a quarter turn across it.
void spin_on_a_rod(double radius, double arm, double speed) {
  SCOPED_TRACE(testing::Message() << "radius " << radius << ", arm " << arm << ", speed " << speed);
  Lab lab(room(2, 1), weightless());
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId ball = add_shape(lab, sphere(real(radius)), 2 + arm, 0, 0);
  JointDef def;
  def.type = JointType::distance;
  def.a = ground;
  def.b = ball;
  def.anchor_b = reals(-arm, 0, 0);
  def.axis.limited = true;
  def.axis.lower = def.axis.upper = real(2);
  JointId joint;
  ASSERT_OK(create_joint(lab.world, def, joint));
  ASSERT_OK(set_velocity(lab.world, ball, reals(0, 0, 0), reals(0, 0, speed)));
  for (int tick = 0; tick < 60; ++tick) {
    lab.run(1);
    ASSERT_NEAR(length(joint_ends(lab.world, joint).gap()), 2, 0.04) << tick;
  }
}

DETENT_TEST(joint, a_rod_on_a_long_arm_holds_when_the_arm_turns_across_it) {
  for (const double radius : {1.0, 0.1, 0.02, 0.005}) {
    for (const double arm : {0.1, 1.0, 4.0, 16.0}) {
      for (const double speed : {1.0, 10.0, 40.0}) spin_on_a_rod(radius, arm, speed);
    }
  }
}

DETENT_TEST(joint, a_cone_leans_no_farther_and_twists_no_farther_than_it_may) {
  JointDef rest;
  rest.second.limited = true;
  rest.second.upper = real(0.4);
  rest.axis.limited = true;
  rest.axis.lower = real(-0.2);
  rest.axis.upper = real(0.3);
  Lab lab(room(2, 1), weightless());
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId arm = add_shape(lab, capsule(real(0.1), real(0.3)), 0.5, 0, 0);
  const JointId joint = add_joint(lab, JointType::cone_twist, ground, arm, 0, 0, 0, rest);
  Samples samples = {5};
  for (int round = 0; round < 10; ++round) {
    const auto draw = [&] { return (samples.below(6001) - 3000.0) / 1000; };
    const double x = draw(), y = draw(), z = draw();
    const Motion now = lab.motion(arm);
    const Vector angular_velocity = {x, y, z}, displacement = {now.position[0], now.position[1], now.position[2]};
    const Vector linear_velocity = cross(angular_velocity, displacement);
    ASSERT_OK(
        set_velocity(lab.world, arm, reals(linear_velocity.x, linear_velocity.y, linear_velocity.z), reals(x, y, z)));
    for (int tick = 0; tick < 60; ++tick) {
      lab.run(1);
      const JointEnds ends = joint_ends(lab.world, joint);
      EXPECT_LE(ends.between(0), 0.4 + 0.02);
      EXPECT_LE(length(ends.gap()), 5e-3);
    }
  }
}

DETENT_TEST(joint, what_swings_round_a_wide_cone_gains_nothing_from_the_limits_of_its_twist) {
  JointDef rest;
  rest.second.limited = rest.axis.limited = true;
  rest.second.upper = real(1.4);
  rest.axis.lower = real(-0.3);
  rest.axis.upper = real(0.3);
  Lab lab(room(2, 1), weightless());
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId arm = add_shape(lab, sphere(real(0.2)), 0.5, 0, 0);
  add_joint(lab, JointType::cone_twist, ground, arm, 0, 0, 0, rest);
  Samples samples = {9};
  const auto energy = [&](const Motion& motion) {  // over half the mass, m^2/s^2
    const Vector linear_velocity = {motion.linear_velocity[0], motion.linear_velocity[1], motion.linear_velocity[2]};
    const Vector angular_velocity = {motion.angular_velocity[0], motion.angular_velocity[1],
                                     motion.angular_velocity[2]};
    return dot(linear_velocity, linear_velocity) + 0.4 * 0.04 * dot(angular_velocity, angular_velocity);
  };
  for (int round = 0; round < 20; ++round) {
    const auto draw = [&] { return (samples.below(6001) - 3000.0) / 300; };
    const double x = draw(), y = draw(), z = draw();
    const Motion now = lab.motion(arm);
    const Vector angular_velocity = {x, y, z}, displacement = {now.position[0], now.position[1], now.position[2]};
    const Vector linear_velocity = cross(angular_velocity, displacement);
    ASSERT_OK(
        set_velocity(lab.world, arm, reals(linear_velocity.x, linear_velocity.y, linear_velocity.z), reals(x, y, z)));
    const double start = energy(lab.motion(arm));
    for (int tick = 0; tick < 60; ++tick) {
      lab.run(1);
      ASSERT_LE(energy(lab.motion(arm)), 1.05 * start) << "round " << round << ", tick " << tick;
    }
  }
}

/// A wheel on an axle whose bearing is held at both ends, so that a joint closes a loop; `driven` selects the hinge
/// that has the motor.
struct Axle {
  Lab lab = Lab(room(3, 3), weightless());
  BodyId frame = add_shape(lab, box(reals(1, 0.2, 1)), 0, -1, 0);
  BodyId bearing = add_shape(lab, box(reals(0.1, 0.1, 0.5)), 0, 0, 0);
  BodyId wheel = add_shape(lab, sphere(real(0.5)), 0, 2, 0);
  JointId joint;

  Axle(const JointAxis& axis, bool loop) {
    JointDef driven;
    driven.axis = axis;
    add_joint(lab, JointType::hinge, frame, bearing, 0, 0, -0.5, {}, k_x_to_z);
    const JointId second =
        add_joint(lab, JointType::hinge, frame, bearing, 0, 0, 0.5, loop ? driven : JointDef{}, k_x_to_z);
    joint = loop ? second : add_joint(lab, JointType::hinge, bearing, wheel, 0, 2, 0, driven, k_x_to_z);
  }
};

DETENT_TEST(joint, a_motor_gives_no_more_than_it_can_beside_a_loop) {
  JointAxis axis;
  axis.speed = real(1000);
  axis.force_max = scaled(20);
  Axle axle(axis, false);
  Scaled mass;
  ASSERT_OK(get_mass(axle.lab.world, axle.wheel, mass));
  axle.lab.run(60);
  const double gained = 20 / (0.4 * scaled_to_host(mass) * 0.25);
  EXPECT_NEAR(axle.lab.motion(axle.wheel).angular_velocity[2], gained, 0.02 * gained);
  JointReaction reaction;
  ASSERT_OK(get_joint_reaction(axle.lab.world, axle.joint, reaction));
  EXPECT_NEAR(scaled_to_host(reaction.torque.z), 20, 0.4);
}

DETENT_TEST(joint, a_soft_spring_acts_in_a_joint_that_closes_a_loop) {
  JointAxis axis;
  axis.frequency = real(0.5);
  axis.damping_ratio = real(1);
  axis.target = real(0.5);
  Axle axle(axis, true);
  axle.lab.run(180);
  EXPECT_NEAR(std::abs(joint_ends(axle.lab.world, axle.joint).turned(0)), 0.5, 0.05);
}

DETENT_TEST(joint, a_soft_spring_under_a_weight_rests_where_both_balance) {
  for (const double damping : {0.1, 0.7}) {
    WorldDef def;
    def.gravity = {9.81, 0.0, 0.0};
    Lab lab(room(2, 1), def);
    const BodyId wall = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
    const BodyId bob = add_shape(lab, box(reals(0.2, 0.2, 0.2)), 1, 0, 0);
    JointDef rail;
    rail.axis.frequency = real(2);
    rail.axis.damping_ratio = real(damping);
    add_joint(lab, JointType::slider, wall, bob, 1, 0, 0, rail);
    lab.run(900);
    const double rate = 2 * k_pi * 2;
    EXPECT_NEAR(lab.motion(bob).position[0] - 1, 9.81 / (rate * rate), 2e-4);
  }
}

/// A load on the ground bears a plate on a spring; a spring pulls up a weight that stands on the ground.
DETENT_TEST(joint, a_damped_spring_is_as_stiff_where_the_ground_bears_its_load) {
  for (const double frequency : {1.0, 4.0}) {
    SCOPED_TRACE(frequency);
    const double rate = 2 * k_pi * frequency;
    JointDef rail;
    rail.axis.frequency = real(frequency);
    rail.axis.damping_ratio = real(0.7);
    Lab lab(room(3, 1));
    lab.add_ground();
    const BodyId load = lab.add_box(0.2, 0, 0.2, 0), plate = lab.add_box(0.1, 0, 2, 0);
    ASSERT_OK(set_mass(lab.world, load, scaled(40)));
    ASSERT_OK(set_mass(lab.world, plate, scaled(10)));
    add_joint(lab, JointType::slider, load, plate, 0, 2, 0, rail, k_x_to_y);
    lab.run(600);
    // The spring's frequency is that of both bodies against each other: its stiffness is rate^2 x 8 kg.
    const double sag = 10 * 9.81 / (8 * rate * rate);
    const double now = 1.8 - (lab.motion(plate).position[1] - lab.motion(load).position[1]);
    EXPECT_NEAR(now, sag, 0.01 * sag);

    Lab hung(room(3, 1));
    hung.add_ground();
    const BodyId beam = add_shape(hung, box(reals(0.1, 0.1, 0.1)), 0, 2, 0, BodyType::fixed);
    const BodyId weight = hung.add_box(0.2, 0, 0.2, 0);
    ASSERT_OK(set_mass(hung.world, weight, scaled(10)));
    rail.axis.target = real(0.5 * 9.81 / (rate * rate));  // it bears half of the weight
    const JointId joint = add_joint(hung, JointType::slider, beam, weight, 0, 0.2, 0, rail, k_x_to_y);
    hung.run(600);
    JointReaction reaction;
    ASSERT_OK(get_joint_reaction(hung.world, joint, reaction));
    EXPECT_NEAR(scaled_to_host(reaction.force.y), 49.05, 0.5);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
