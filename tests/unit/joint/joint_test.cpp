#include <algorithm>
#include <initializer_list>

#include "tests/unit/joint/joint_lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Checks that each type of joint holds its constraints, up to these errors. `substeps`: 0 for the number that the
/// world chooses.
void expect_held(uint32_t substeps, double metres, double radians) {
  for (const JointType type : k_joint_types) {
    SCOPED_TRACE(static_cast<int>(type));
    Pair pair(type, {}, substeps);
    if (type == JointType::distance) {  // a rod from centre to centre
      JointDef def;
      ASSERT_OK(get_joint(pair.lab.world, pair.joint, def));
      def.anchor_a = def.anchor_b = reals(0, 0, 0);
      def.axis.limited = true;
      def.axis.lower = def.axis.upper = real(1.2);
      ASSERT_OK(set_joint(pair.lab.world, pair.joint, def));
    }
    double gap = 0, aside = 0, lean_x = 0, lean_z = 0, away = 0;
    for (int tick = 0; tick < 300; ++tick) {
      pair.lab.run(1);
      const JointEnds ends = joint_ends(pair.lab.world, pair.joint);
      const Vector displacement = ends.gap();
      const double along = dot(displacement, ends.a.axis[0]);
      gap = std::max(gap, length(displacement));
      aside = std::max(aside, length(displacement - ends.a.axis[0] * along));
      lean_x = std::max(lean_x, ends.between(0));
      lean_z = std::max(lean_z, ends.between(2));
      away = std::max(away, std::abs(length(displacement) - 1.2));
    }
    const bool points = type == JointType::ball || type == JointType::hinge || type == JointType::fixed ||
                        type == JointType::cone_twist;
    const bool slides = type == JointType::slider || type == JointType::wheel;
    if (points) {
      EXPECT_LE(gap, metres);
    }
    if (slides) {
      EXPECT_LE(aside, metres);
      EXPECT_GT(gap, 0.1) << "it does slide";
    }
    if (type == JointType::distance) {
      EXPECT_LE(away, metres);
    }
    if (type == JointType::parallel) {
      EXPECT_GT(gap, 0.1) << "it does slide";
    }
    if (type == JointType::hinge || type == JointType::slider || type == JointType::fixed ||
        type == JointType::parallel) {
      EXPECT_LE(lean_x, radians);
    }
    if (type == JointType::hinge || type == JointType::parallel) {
      EXPECT_GT(lean_z, 0.5) << "it does turn";
    }
    if (type == JointType::slider || type == JointType::fixed || type == JointType::wheel) {
      EXPECT_LE(lean_z, radians);
    }
    if (type == JointType::ball || type == JointType::cone_twist || type == JointType::wheel) {
      EXPECT_GT(lean_x, 0.5) << "it does turn";
    }
  }
}

DETENT_TEST(joint, each_type_holds_what_it_holds) { expect_held(4, 2e-3, 4e-3); }

/// The bricks rotate by 0.06 rad in a tick. The default number of substeps permits an error of a hundredth of their
/// size.
DETENT_TEST(joint, each_type_holds_to_a_hundredth_of_its_bodies_by_default) { expect_held(0, 1e-2, 1e-2); }

/// The energy that a pendulum released from horizontal loses or gains in 30 s, relative to the energy of its fall.
double energy_lost(uint32_t substeps) {
  WorldDef def;
  def.substeps = substeps;
  Lab lab(room(2, 1), def);
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId bob = add_shape(lab, sphere(real(0.1)), 1, 0, 0);
  add_joint(lab, JointType::ball, ground, bob, 0, 0, 0);
  double worst = 0;
  for (int tick = 0; tick < 1800; ++tick) {
    lab.run(1);
    const Motion motion = lab.motion(bob);
    const Vector linear_velocity = {motion.linear_velocity[0], motion.linear_velocity[1], motion.linear_velocity[2]};
    const double energy = dot(linear_velocity, linear_velocity) / 2 * (1 + 0.4 * 0.01) + 9.81 * motion.position[1];
    worst = std::max(worst, std::abs(energy) / 9.81);
  }
  return worst;
}

DETENT_TEST(joint, a_pendulum_keeps_its_energy) {
  EXPECT_LE(energy_lost(4), 0.02);
  EXPECT_LE(energy_lost(0), 0.04) << "most of it as it starts, at one substep";
}

/// Hangs a body by a hinge about z at the origin from a fixed body.
void hang(Lab& lab, const BodyDef& def, JointDef joint, BodyId& id) {
  BodyDef post;
  post.type = BodyType::fixed;
  post.shape = sphere(real(0.01));
  joint.a = lab.add(post);
  joint.b = id = lab.add(def);
  joint.type = JointType::hinge;
  // The axis of a hinge is x of its frames.
  constexpr Quat k_frame = {0.0, -0.70710678118654752, 0.0, 0.70710678118654752};
  EXPECT_OK(place_joint(lab.world, position(0, 0, 0), k_frame, joint));
  JointId made;
  EXPECT_OK(create_joint(lab.world, joint, made));
}

DETENT_TEST(joint, a_slow_motor_keeps_its_bodies_awake_until_it_is_held_up) {
  for (const bool limited : {false, true}) {
    WorldDef world = weightless();
    Lab lab(room(2, 1), world, true);
    BodyDef def;
    def.shape = box(reals(0.3, 0.3, 0.1));
    def.position = position(0, -0.3, 0);
    JointDef joint;
    joint.axis.speed = real(0.02);
    joint.axis.force_max = scaled(1000);
    joint.axis.limited = limited;
    joint.axis.lower = real(-0.01);
    joint.axis.upper = real(0.01);
    BodyId id;
    hang(lab, def, joint, id);
    const StepReport report = lab.run(300);
    EXPECT_EQ(report.awake, limited ? 0u : 1u);
    EXPECT_NEAR(fabs(lab.motion(id).angular_velocity[2]), limited ? 0 : 0.02, 1e-4);
  }
}

DETENT_TEST(joint, what_a_joint_gives_one_body_it_takes_from_the_other) {
  for (const JointType type : k_joint_types) {
    SCOPED_TRACE(static_cast<int>(type));
    Pair pair(type);
    const auto momentum = [&](Vector& linear, Vector& angular) {
      linear = angular = {0, 0, 0};
      for (const BodyId id : {pair.a, pair.b}) {
        const Motion motion = pair.lab.motion(id);
        Scaled mass;
        ASSERT_OK(get_mass(pair.lab.world, id, mass));
        const double m = scaled_to_host(mass);
        const Vector half = id == pair.a ? Vector{0.4, 0.2, 0.3} : Vector{0.5, 0.1, 0.2};
        const Vector at = {motion.position[0], motion.position[1], motion.position[2]};
        const Vector linear_velocity = {motion.linear_velocity[0], motion.linear_velocity[1],
                                        motion.linear_velocity[2]};
        const Vector angular_velocity = {motion.angular_velocity[0], motion.angular_velocity[1],
                                         motion.angular_velocity[2]};
        const JointEnd axes = joint_end(pair.lab.world, id, reals(0, 0, 0), {0.0, 0.0, 0.0, 1.0});
        const double inertia[3] = {m * (half.y * half.y + half.z * half.z) / 3,
                                   m * (half.z * half.z + half.x * half.x) / 3,
                                   m * (half.x * half.x + half.y * half.y) / 3};
        linear = linear + linear_velocity * m;
        angular = angular + cross(at, linear_velocity) * m;
        for (int i = 0; i < 3; ++i)
          angular = angular + axes.axis[i] * (inertia[i] * dot(angular_velocity, axes.axis[i]));
      }
    };
    Vector linear, angular, linear_after, angular_after;
    momentum(linear, angular);
    pair.lab.run(120);
    momentum(linear_after, angular_after);
    EXPECT_LE(length(linear_after - linear), 1e-4 * length(linear));
    EXPECT_LE(length(angular_after - angular), 0.02 * length(angular));
  }
}

/// The angular momentum of bodies about the world's origin.
Vector angular_momentum(Lab& lab, std::initializer_list<BodyId> ids) {
  Vector sum = {0, 0, 0};
  for (const BodyId id : ids) {
    const Motion motion = lab.motion(id);
    Scaled mass;
    Vec3<Scaled> inertia;
    EXPECT_OK(get_mass(lab.world, id, mass));
    EXPECT_OK(get_inertia(lab.world, id, inertia));
    const double about[3] = {scaled_to_host(inertia.x), scaled_to_host(inertia.y), scaled_to_host(inertia.z)};
    const Vector at = {motion.position[0], motion.position[1], motion.position[2]};
    const Vector linear_velocity = {motion.linear_velocity[0], motion.linear_velocity[1], motion.linear_velocity[2]};
    const Vector angular_velocity = {motion.angular_velocity[0], motion.angular_velocity[1],
                                     motion.angular_velocity[2]};
    const JointEnd axes = joint_end(lab.world, id, reals(0, 0, 0), {0.0, 0.0, 0.0, 1.0});
    sum = sum + cross(at, linear_velocity) * scaled_to_host(mass);
    for (int i = 0; i < 3; ++i) sum = sum + axes.axis[i] * (about[i] * dot(angular_velocity, axes.axis[i]));
  }
  return sum;
}

/// A wheel of radius `size` on an axle of the same length, which a ball joint holds at its end. It spins and precesses
/// steadily. Returns how far it sinks in 2 s, in lengths of the axle.
double sunk_gyroscope(double size, double spin) {
  Lab lab(room(2, 1));
  const BodyId post = add_shape(lab, sphere(real(0.01)), 0, 0, 0, BodyType::fixed);
  BodyDef def;
  def.shape = cylinder(real(size), real(size / 5));
  def.rotation = {0.0, 0.0, -0.70710678118654752, 0.70710678118654752};  // y to x
  def.position = position(size, 0, 0);
  const BodyId wheel = lab.add(def);
  const double precession = 9.81 * size / (size * size / 2 * spin);
  EXPECT_OK(set_velocity(lab.world, wheel, reals(0, 0, -precession * size), reals(spin, precession, 0)));
  add_joint(lab, JointType::ball, post, wheel, 0, 0, 0);
  lab.run(120);
  return -lab.motion(wheel).position[1] / size;
}

DETENT_TEST(joint, a_gyroscope_does_not_sink) {
  EXPECT_NEAR(sunk_gyroscope(0.05, 200), 0, 0.02);
  EXPECT_NEAR(sunk_gyroscope(1, 60), 0, 0.002);
}

DETENT_TEST(joint, a_box_with_a_flywheel_keeps_its_angular_momentum) {
  Lab lab(room(2, 1), weightless());
  const BodyId frame = add_shape(lab, box(reals(0.3, 0.2, 0.25)), 0, 0, 0);
  BodyDef def;
  def.shape = cylinder(real(0.2), real(0.05));
  def.rotation = {0.0, 0.0, -0.70710678118654752, 0.70710678118654752};  // y to x
  def.position = position(0.4, 0, 0);
  const BodyId wheel = lab.add(def);
  ASSERT_OK(set_velocity(lab.world, frame, reals(0, 0, 0), reals(0, 2, 0)));
  ASSERT_OK(set_velocity(lab.world, wheel, reals(0, 0, -0.8), reals(50, 2, 0)));
  add_joint(lab, JointType::hinge, frame, wheel, 0.4, 0, 0);
  const Vector before = angular_momentum(lab, {frame, wheel});
  lab.run(60);
  EXPECT_LE(length(angular_momentum(lab, {frame, wheel}) - before), 0.004 * length(before));
}

/// A ball joint and a wheel joint both constrain one motion: their rows may act against each other with any force.
DETENT_TEST(joint, a_pair_that_is_held_twice_keeps_its_angular_momentum) {
  Lab lab(room(2, 2), weightless());
  const BodyId a = add_shape(lab, sphere(real(0.3)), 0, 0, 0), b = add_shape(lab, sphere(real(0.3)), 0.8, 0.2, 0.1);
  ASSERT_OK(set_velocity(lab.world, a, reals(3, 1, 0), reals(1, 2, 3)));
  ASSERT_OK(set_velocity(lab.world, b, reals(-2, 0, 1), reals(-2, 1, 0)));
  add_joint(lab, JointType::ball, a, b, 0.4, 0, 0.1);
  add_joint(lab, JointType::wheel, a, b, 0.3, 0.25, 0);
  const auto momentum = [&] {
    Vector sum = {0, 0, 0};
    for (const BodyId id : {a, b}) {
      const Motion motion = lab.motion(id);
      const Vector at = {motion.position[0], motion.position[1], motion.position[2]};
      const Vector linear_velocity = {motion.linear_velocity[0], motion.linear_velocity[1], motion.linear_velocity[2]};
      sum = sum + cross(at, linear_velocity) +
            Vector{motion.angular_velocity[0], motion.angular_velocity[1], motion.angular_velocity[2]} *
                (0.4 * 0.3 * 0.3);
    }
    return sum;
  };
  const Vector before = momentum();
  lab.run(1);
  EXPECT_LE(length(momentum() - before), 0.02 * length(before));
}

DETENT_TEST(joint, a_body_hangs_from_a_kinematic_one_as_that_turns) {
  Lab lab(room(2, 1));
  BodyDef arm;
  arm.type = BodyType::kinematic;
  arm.shape = box(reals(0.5, 0.1, 0.1));
  arm.angular_velocity = reals(0, 1, 0);
  const BodyId turning = lab.add(arm);
  const BodyId ball = add_shape(lab, sphere(real(0.1)), 0.5, -0.6, 0);
  const JointId joint = add_joint(lab, JointType::ball, turning, ball, 0.5, 0, 0);
  double worst = 0;
  for (int tick = 0; tick < 300; ++tick) {
    lab.run(1);
    worst = std::max(worst, length(joint_ends(lab.world, joint).gap()));
  }
  EXPECT_LE(worst, 2e-3);
}

DETENT_TEST(joint, bodies_that_it_connects_collide_only_if_it_says_so) {
  for (const bool collide : {false, true}) {
    Lab lab(room(2, 1), weightless());
    const BodyId a = lab.add_box(0.5, 0, 0, 0), b = lab.add_box(0.5, 0.9, 0, 0);
    JointDef rest;
    rest.collide = collide;
    add_joint(lab, JointType::ball, a, b, 0.45, 0, 0, rest);
    EXPECT_EQ(lab.run(1).contacts.count, collide ? 1u : 0u);
  }
}

DETENT_TEST(joint, bodies_that_its_movement_wakes_are_counted) {
  Lab lab({3, 8, 0, true, 2}, {}, true);
  const BodyId hook = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::kinematic);
  const BodyId upper = add_shape(lab, box(reals(0.1, 0.4, 0.1)), 0, -0.5, 0);
  const BodyId lower = add_shape(lab, box(reals(0.1, 0.4, 0.1)), 0, -1.5, 0);
  add_joint(lab, JointType::ball, hook, upper, 0, 0, 0);
  add_joint(lab, JointType::ball, upper, lower, 0, -1, 0);
  uint32_t asleep = 0;
  for (int tick = 0; tick < 600 && asleep == 0; ++tick) asleep = lab.run(1).fell_asleep;
  ASSERT_EQ(asleep, 2u);
  EXPECT_OK(set_velocity(lab.world, hook, reals(0.5, 0, 0), {}));
  EXPECT_EQ(lab.run(1).woke, 2u);
  EXPECT_EQ(lab.run(1).woke, 0u);
}

DETENT_TEST(joint, what_is_joined_sleeps_and_wakes_together) {
  Lab lab(room(5, 3), {}, true);
  lab.add_ground();
  BodyId link[4];
  for (int i = 0; i < 4; ++i) link[i] = add_shape(lab, box(reals(0.4, 0.1, 0.2)), i, 0.1, 0);
  for (int i = 0; i < 3; ++i) add_joint(lab, JointType::ball, link[i], link[i + 1], i + 0.5, 0.1, 0);
  lab.run(240);
  const auto awake = [&](BodyId id) {
    bool result = false;
    EXPECT_OK(is_awake(lab.world, id, result));
    return result;
  };
  for (const BodyId id : link) EXPECT_FALSE(awake(id));
  ASSERT_OK(apply_impulse(lab.world, link[3], scaleds(0, 5, 0)));
  for (const BodyId id : link) EXPECT_TRUE(awake(id));
  ASSERT_OK(sleep_body(lab.world, link[1]));
  EXPECT_FALSE(awake(link[1]));
  lab.run(1);
  EXPECT_TRUE(awake(link[1])) << "its neighbours move";
}

DETENT_TEST(joint, one_that_bears_more_than_it_can_breaks_and_says_so) {
  Lab lab(room(2, 1));
  JointEvent events[2];
  lab.world.hooks.joint_events = {events, 2};
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  BodyDef load;
  load.shape = box(reals(0.2, 0.2, 0.2));
  load.mass = scaled(10);
  load.position = position(0, -1, 0);
  const BodyId box = lab.add(load);
  JointDef rest;
  rest.break_force = scaled(99);
  rest.user_data = 77;
  const JointId joint = add_joint(lab, JointType::ball, ground, box, 0, 0, 0, rest);
  EXPECT_EQ(lab.run(120).joints.broken, 0u);
  ASSERT_TRUE(is_valid(lab.world, joint));
  ASSERT_OK(apply_force(lab.world, box, scaleds(0, -5, 0)));
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.joints.broken, 1u);
  ASSERT_EQ(report.events.joint, 1u);
  EXPECT_FALSE(is_valid(lab.world, joint));
  EXPECT_TRUE(events[0].joint == joint && events[0].a == ground && events[0].b == box && events[0].user_data == 77);
  EXPECT_NEAR(scaled_to_host(events[0].reaction.force.y), 98.1 + 5, 0.05);
  lab.run(1);
  EXPECT_LT(lab.motion(box).linear_velocity[1], -0.1) << "it falls";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
