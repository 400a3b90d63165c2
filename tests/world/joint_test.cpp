#include <detent/body_access.h>

#include <math.h>
#include <string.h>

#include <algorithm>
#include <vector>

#include "tests/math/samples.h"
#include "tests/world/joint_lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_pi = 3.14159265358979323846;

WorldDef weightless(uint32_t substeps = 0) {
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  def.substeps = substeps;
  return def;
}
Capacity room(uint32_t bodies, uint32_t joints) { return {bodies, 4 * bodies, 0, true, joints}; }

/// Two bricks with a joint half-way between them, in space, that fly off turning.
struct Pair {
  Lab lab;
  BodyId a, b;
  JointId joint;

  explicit Pair(JointType type, const JointDef& rest = {}, uint32_t substeps = 0)
      : lab(room(2, 1), weightless(substeps)) {
    a = add_shape(lab, box(reals(0.4, 0.2, 0.3)), 0, 0, 0);
    b = add_shape(lab, box(reals(0.5, 0.1, 0.2)), 1.2, 0, 0);
    joint = add_joint(lab, type, a, b, 0.5, 0, 0, rest);
    EXPECT_OK(set_velocity(lab.world, a, reals(0.5, -1, 2), reals(1, 2, -3)));
    EXPECT_OK(set_velocity(lab.world, b, reals(0.5, 1, -0.5), reals(-2, 1, 2)));
  }
};

constexpr JointType k_types[] = {JointType::ball,  JointType::hinge,      JointType::slider, JointType::distance,
                                 JointType::fixed, JointType::cone_twist, JointType::wheel};

/// That each type holds what it holds, up to these errors; `substeps`: 0, as many as the world chooses.
void expect_held(uint32_t substeps, double metres, double radians) {
  for (const JointType type : k_types) {
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
      const Vector way = ends.gap();
      const double along = dot(way, ends.a.axis[0]);
      gap = std::max(gap, length(way));
      aside = std::max(aside, length(way - ends.a.axis[0] * along));
      lean_x = std::max(lean_x, ends.between(0));
      lean_z = std::max(lean_z, ends.between(2));
      away = std::max(away, std::abs(length(way) - 1.2));
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
    if (type == JointType::hinge || type == JointType::slider || type == JointType::fixed) {
      EXPECT_LE(lean_x, radians);
    }
    if (type == JointType::hinge) {
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

/// The bricks turn by 0.06 rad a tick: a hundredth of their size is all that needs no more substeps.
DETENT_TEST(joint, each_type_holds_to_a_hundredth_of_its_bodies_by_default) { expect_held(0, 1e-2, 1e-2); }

DETENT_TEST(joint, every_loop_of_a_net_is_held) {
  Lab lab(room(9, 12), weightless());
  BodyId knots[3][3];
  std::vector<JointId> joints;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      knots[i][j] = add_shape(lab, box(reals(0.2, 0.2, 0.2)), i, j, 0);
      const double push = (i * 3 + j) % 4 - 1.5;
      EXPECT_OK(set_velocity(lab.world, knots[i][j], reals(push, -push, 2 * push), reals(0, push, 0)));
      if (i > 0) joints.push_back(add_joint(lab, JointType::ball, knots[i - 1][j], knots[i][j], i - 0.5, j, 0));
      if (j > 0) joints.push_back(add_joint(lab, JointType::ball, knots[i][j - 1], knots[i][j], i, j - 0.5, 0));
    }
  }
  for (int tick = 0; tick < 60; ++tick) {
    lab.run(1);
    for (const JointId id : joints) ASSERT_LT(length(joint_ends(lab.world, id).gap()), 0.02) << tick << " " << id.slot;
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

/// The least number of substeps that a joint is given whose squared number is at least this. 0: too close to tell.
uint32_t substeps_for(double squared) {
  for (const uint32_t n : {1u, 2u, 3u, 4u, 6u, 8u}) {
    if (fabs(squared / (n * n) - 1) < 0.01) return 0;
    if (squared < n * n) return n;
  }
  return 8;
}

/// The measure of lib/dynamics/joint_substeps.cpp in doubles, for bodies whose unit of length is 1 m; motions are those
/// of a tick.
double bend_of(JointType type, const Vector (&velocity)[2], const Vector (&spin)[2], const Vector (&anchor)[2],
               Vector between, double length) {
  const auto sum = [](Vector v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); };
  const bool slides = type == JointType::slider || type == JointType::wheel;
  const Vector arm[2] = {slides ? between + anchor[1] : anchor[0], anchor[1]};
  const Vector by_a = cross(spin[0], arm[0]), by_b = cross(spin[1], arm[1]);
  const Vector apart = (velocity[1] + by_b) - (velocity[0] + by_a);
  if (type == JointType::distance) return sum(apart) * sum(apart) / length;
  Vector bends = cross(spin[1], by_b) - cross(spin[0], by_a);
  if (slides) bends = bends - cross(spin[0], apart) * 2;
  if (type == JointType::ball || type == JointType::cone_twist) return sum(bends);
  return fmax(sum(bends), sum(cross(spin[0], spin[1])));
}

DETENT_TEST(joint, substeps_are_those_that_the_paths_of_its_bodies_ask_for) {
  Samples samples = {77};
  const auto draw = [&](double most) { return most * unit_to_host(samples.uniform()); };
  const auto vector = [&](double most) {
    const double x = draw(most), y = draw(most), z = draw(most);
    return Vector{x, y, z};
  };
  for (const JointType type : k_types) {
    uint32_t seen[9] = {};
    for (uint32_t round = 0; round < 60; ++round) {
      // Some pairs have one velocity, joints at the centres, or no spin.
      const double fast = exp2(-static_cast<double>(round % 6));
      Vector velocity[2] = {vector(4 * fast), vector(4 * fast)}, spin[2] = {vector(6 * fast), vector(6 * fast)};
      Vector anchor[2] = {vector(0.3), vector(0.3)};
      if (round % 5 == 0) velocity[1] = velocity[0];
      if (round % 7 == 0) anchor[0] = anchor[1] = {0, 0, 0};
      if (round % 10 == 0) spin[0] = spin[1] = {0, 0, 0};
      const double length = 0.5 + fabs(draw(2));
      WorldDef def = weightless();
      def.tick = real(0.25);
      Lab lab(room(2, 1), def);
      JointDef joint;
      joint.type = type;
      joint.axis.limited = type == JointType::distance;
      joint.axis.upper = real(joint.axis.limited ? length : 0);
      for (int i = 0; i < 2; ++i) {
        BodyDef body;
        body.shape = box(reals(0.5, 0.5, 0.5));
        body.position = position(1.5 * i, 0, 0);
        body.velocity = reals(velocity[i].x, velocity[i].y, velocity[i].z);
        body.spin = reals(spin[i].x, spin[i].y, spin[i].z);
        (i == 0 ? joint.a : joint.b) = lab.add(body);
        (i == 0 ? joint.anchor_a : joint.anchor_b) = reals(anchor[i].x, anchor[i].y, anchor[i].z);
        velocity[i] = velocity[i] * 0.25;
        spin[i] = spin[i] * 0.25;
      }
      JointId id;
      ASSERT_OK(create_joint(lab.world, joint, id));
      const uint32_t expected = substeps_for(fmin(64 * bend_of(type, velocity, spin, anchor, {1.5, 0, 0}, length), 63));
      const uint32_t taken = lab.run(1).substeps_max;
      if (expected != 0) {
        EXPECT_EQ(taken, expected) << static_cast<int>(type) << " " << round;
        ++seen[expected];
      }
    }
    for (const uint32_t n : {1u, 2u, 4u, 8u}) EXPECT_GT(seen[n], 0u) << static_cast<int>(type) << " " << n;
  }
}

DETENT_TEST(joint, substeps_are_those_that_its_springs_its_loops_and_contacts_ask_for) {
  constexpr Real k_softs[] = {0.125, 0.25, 0.5};
  for (const Real soft : k_softs) {
    for (uint32_t which = 0; which < 2; ++which) {
      WorldDef def = weightless();
      def.tick = real(0.25);
      Lab lab(room(2, 1), def);
      JointDef joint;
      (which == 0 ? joint.axis : joint.second).frequency = soft;
      add_joint(lab, JointType::wheel, add_shape(lab, box(reals(0.5, 0.5, 0.5)), 0, 0, 0),
                add_shape(lab, box(reals(0.5, 0.5, 0.5)), 2, 0, 0), 1, 0, 0, joint);
      const double phase = 2 * k_pi * real_to_host(soft) * 0.25;
      EXPECT_EQ(lab.run(1).substeps_max, substeps_for(fmin(25 * phase * phase, 15.9))) << which;
    }
  }
  const auto chain = [](int links, bool hung_twice, bool touching) {
    Lab lab(room(5, 4), weightless());
    BodyId last = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
    for (int i = 0; i < links; ++i) {
      const BodyId next = add_shape(lab, box(reals(0.4, 0.1, 0.1)), 0.5 + i, 0, 0);
      add_joint(lab, JointType::ball, last, next, i, 0, 0);
      last = next;
    }
    const double end = links;
    if (hung_twice)
      add_joint(lab, JointType::ball, last, add_shape(lab, box(reals(0.1, 0.1, 0.1)), end, 0, 0, BodyType::fixed), end,
                0, 0);
    if (touching) add_shape(lab, box(reals(0.1, 0.1, 0.1)), end - 0.5, 0.1999, 0);
    return lab.run(1).substeps_max;
  };
  EXPECT_EQ(chain(2, false, false), 1u);
  EXPECT_EQ(chain(2, true, false), 4u);
  EXPECT_EQ(chain(2, false, true), 8u);
}

/// Nothing of an earlier tick is read: of bodies that do not move, in loops, or where points alone hold.
DETENT_TEST(joint, what_the_work_space_holds_before_a_step_does_not_matter) {
  const auto fill = [](Lab& lab, uint8_t byte) {
    const Capacity capacity = get_info(lab.world).capacity;
    bool fits = false;
    const Layout layout = layout_of(capacity, fits);
    memset(lab.block() + layout.joint_work, byte, sizeof(JointWork) * capacity.joints);
    memset(lab.block() + layout.joint_bodies, byte, sizeof(JointBody) * joint_body_count(capacity));
  };
  for (const JointType type : k_types) {
    SCOPED_TRACE(static_cast<int>(type));
    const auto make = [type](Lab& lab) {
      BodyId last = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
      const BodyId wall = last;
      BodyId link[4];
      for (int i = 0; i < 4; ++i) {
        link[i] = add_shape(lab, box(reals(0.4, 0.05, 0.1)), 0.5 + i, 0, 0);
        add_joint(lab, i == 2 ? type : JointType::ball, last, link[i], i, 0, 0);
        last = link[i];
      }
      add_joint(lab, type, link[1], link[3], 2.5, 0.1, 0);
      add_joint(lab, JointType::ball, link[0], wall, 0, 0.1, 0);
      EXPECT_OK(set_velocity(lab.world, last, reals(0, 3, 1), reals(1, 0, 2)));
    };
    Lab lab(room(5, 6)), other(room(5, 6));
    make(lab);
    make(other);
    for (int tick = 0; tick < 40; ++tick) {
      fill(lab, 0xff);
      fill(other, 0x5a);
      lab.run(1);
      other.run(1);
      ASSERT_EQ(digest(lab.world), digest(other.world)) << "tick " << tick;
    }
  }
}

DETENT_TEST(joint, what_a_joint_gives_one_body_it_takes_from_the_other) {
  for (const JointType type : k_types) {
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
        const Vector velocity = {motion.velocity[0], motion.velocity[1], motion.velocity[2]};
        const Vector spin = {motion.spin[0], motion.spin[1], motion.spin[2]};
        const JointEnd axes = joint_end(pair.lab.world, id, reals(0, 0, 0), {0.0, 0.0, 0.0, 1.0});
        const double inertia[3] = {m * (half.y * half.y + half.z * half.z) / 3,
                                   m * (half.z * half.z + half.x * half.x) / 3,
                                   m * (half.x * half.x + half.y * half.y) / 3};
        linear = linear + velocity * m;
        angular = angular + cross(at, velocity) * m;
        for (int i = 0; i < 3; ++i) angular = angular + axes.axis[i] * (inertia[i] * dot(spin, axes.axis[i]));
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

/// A wheel of 0.5 m and 1 m wide on a fixed axle along z.
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
  double speed() { return lab.motion(wheel).spin[2]; }
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
    EXPECT_NEAR(lab.motion(lift).velocity[1], 5 * tick / 60.0, 1e-4);
  }
  lab.run(60);
  EXPECT_NEAR(lab.motion(lift).velocity[1], 0.5, 1e-3);
  JointReaction reaction;
  ASSERT_OK(get_joint_reaction(lab.world, joint, reaction));
  EXPECT_NEAR(scaled_to_host(reaction.force.y), 98.1, 0.01);
  JointDef weaker;
  ASSERT_OK(get_joint(lab.world, joint, weaker));
  weaker.axis.force_max = scaled(98.1 - 10);
  ASSERT_OK(set_joint(lab.world, joint, weaker));
  lab.run(30);
  EXPECT_NEAR(lab.motion(lift).velocity[1], 0.5 - 0.5, 5e-3) << "1 m/s^2 too little";
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

DETENT_TEST(joint, motors_and_springs_leave_a_limit_that_they_start_from) {
  for (const bool spring : {false, true}) {
    for (const double way : {1.0, -1.0}) {
      JointAxis axis;
      axis.limited = true;
      axis.lower = real(way > 0 ? 0 : -1);
      axis.upper = real(way > 0 ? 1 : 0);
      if (spring) {
        axis.frequency = real(1);
        axis.target = real(0.5 * way);
      } else {
        axis.speed = real(way);
        axis.force_max = scaled(1000);
      }
      Flywheel flywheel(axis);
      flywheel.lab.run(30);
      EXPECT_GT(flywheel.angle() * way, 0.3) << spring << way;
    }
  }
}

DETENT_TEST(joint, what_a_type_does_not_leave_free_is_not_driven) {
  for (const JointType type : k_types) {
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

DETENT_TEST(joint, a_tree_holds_masses_ten_thousand_times_apart_and_takes_any) {
  for (const double ratio : {1e4, 1e8}) {
    Lab lab(room(5, 4));
    const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
    BodyDef def;
    def.shape = sphere(real(0.25));
    BodyId last = ground;
    for (int i = 0; i < 4; ++i) {
      def.mass = scaled(i == 1 || i == 2 ? 1e-3 * ratio : 1e-3);
      def.position = position(0.5 * (i + 1), 0, 0);
      const BodyId next = lab.add(def);
      add_joint(lab, JointType::hinge, last, next, 0.5 * i + 0.25, 0, 0);
      last = next;
    }
    uint32_t saturations = 0;
    for (int tick = 0; tick < 60; ++tick) saturations += lab.run(1).saturations;
    if (ratio > 1e4) continue;  // a link so light is too weak to be seen beside what hangs from it: it lets go
    EXPECT_EQ(saturations, 0u);
    for (JointId id = next_joint(lab.world, {}); !(id == JointId{}); id = next_joint(lab.world, id))
      EXPECT_LE(length(joint_ends(lab.world, id).gap()), 0.05);
  }
}

/// A chain of bricks from a wall, level, each joint of a type, and a weight of so many bricks at its end.
struct HangingChain {
  Lab lab;
  BodyId wall, last;

  HangingChain(int links, double weight, JointType middle = JointType::ball)
      : lab(room(static_cast<uint32_t>(links) + 8, static_cast<uint32_t>(links) + 8)) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(0.1, 0.1, 0.1));
    last = wall = lab.add(def);
    def.type = BodyType::dynamic;
    def.shape = box(reals(0.2, 0.05, 0.05));
    def.filter.mask = 0;
    for (int i = 0; i <= links; ++i) {
      def.mass = scaled(i == links ? weight : 1);
      def.position = position(0.5 * i + 0.25, 0, 0);
      const BodyId next = lab.add(def);
      add_joint(lab, i == links / 2 ? middle : JointType::ball, last, next, 0.5 * i, 0, 0);
      last = next;
    }
  }
  double widest() {
    double gap = 0;
    for (JointId id = next_joint(lab.world, {}); !(id == JointId{}); id = next_joint(lab.world, id))
      gap = std::max(gap, length(joint_ends(lab.world, id).gap()));
    return gap;
  }
};

DETENT_TEST(joint, a_weight_of_a_thousand_links_does_not_shake_its_chain_apart) {
  for (const int links : {6, 30}) {
    SCOPED_TRACE(links);
    HangingChain chain(links, 1000);
    double widest = 0;
    for (int tick = 0; tick < 600; ++tick) {
      chain.lab.run(1);
      widest = std::max(widest, chain.widest());
    }
    EXPECT_LE(widest, 0.01);
  }
}

/// What pulls at its links has no bound.
DETENT_TEST(joint, a_chain_taut_between_two_walls_stays_together) {
  for (const int links : {10, 20, 40}) {
    SCOPED_TRACE(links);
    HangingChain chain(links, 1);
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(0.1, 0.1, 0.1));
    def.filter.mask = 0;
    def.position = position(0.5 * (links + 1), 0, 0);
    add_joint(chain.lab, JointType::ball, chain.last, chain.lab.add(def), 0.5 * (links + 1), 0, 0);
    double widest = 0;
    for (int tick = 0; tick < 600; ++tick) {
      chain.lab.run(1);
      widest = std::max(widest, chain.widest());
    }
    EXPECT_LE(widest, 0.01);
  }
}

DETENT_TEST(joint, a_tree_of_points_holds_with_branches_and_other_types_in_it) {
  HangingChain tree(6, 1, JointType::hinge);
  for (int branch = 0; branch < 2; ++branch) {
    BodyDef def;
    def.shape = box(reals(0.2, 0.05, 0.05));
    def.filter.mask = 0;
    def.position = position(3.75, 0, 0);
    const BodyId first = tree.lab.add(def);
    add_joint(tree.lab, JointType::ball, tree.last, first, 3.5, 0, 0);
    def.position = position(4.25, 0, 0);
    const BodyId second = tree.lab.add(def);
    add_joint(tree.lab, JointType::ball, first, second, 4.0, 0, 0);
    EXPECT_OK(set_velocity(tree.lab.world, second, reals(0, 0, branch == 0 ? 4 : -4), reals(0, 0, 0)));
  }
  double widest = 0;
  for (int tick = 0; tick < 300; ++tick) {
    tree.lab.run(1);
    widest = std::max(widest, tree.widest());
  }
  EXPECT_LE(widest, 0.01);
}

DETENT_TEST(joint, an_anchor_far_outside_a_body_that_shrinks_is_still_loaded_and_stepped) {
  Lab lab(room(2, 1));
  const BodyId ground = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId ball = add_shape(lab, sphere(real(0.5)), 0, -4, 0);
  const JointId joint = add_joint(lab, JointType::ball, ground, ball, 0, 0, 0);
  ASSERT_OK(set_shape(lab.world, ball, sphere(real(0.125))));
  std::vector<uint64_t> saved = lab.snapshot();
  ASSERT_OK(load(lab.world, bytes_of(saved), byte_count(saved)));
  for (int tick = 0; tick < 60; ++tick) EXPECT_EQ(lab.run(1).saturations, 0u);
  EXPECT_LE(length(joint_ends(lab.world, joint).gap()), 1e-3);
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
  EXPECT_NEAR(lab.motion(ball).velocity[1], -9.81 / 3, 1e-3) << "it falls freely";
  double lowest = 0;
  for (int tick = 0; tick < 120; ++tick) {
    lab.run(1);
    lowest = std::min(lowest, lab.motion(ball).position[1]);
  }
  EXPECT_NEAR(lowest, -2, 0.002);
  EXPECT_NEAR(lab.motion(ball).position[1], -2, 1e-3);
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
    const Vector spin = {x, y, z}, way = {now.position[0], now.position[1], now.position[2]};
    const Vector velocity = cross(spin, way);
    ASSERT_OK(set_velocity(lab.world, arm, reals(velocity.x, velocity.y, velocity.z), reals(x, y, z)));
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
    const Vector velocity = {motion.velocity[0], motion.velocity[1], motion.velocity[2]};
    const Vector spin = {motion.spin[0], motion.spin[1], motion.spin[2]};
    return dot(velocity, velocity) + 0.4 * 0.04 * dot(spin, spin);
  };
  for (int round = 0; round < 20; ++round) {
    const auto draw = [&] { return (samples.below(6001) - 3000.0) / 300; };
    const double x = draw(), y = draw(), z = draw();
    const Motion now = lab.motion(arm);
    const Vector spin = {x, y, z}, way = {now.position[0], now.position[1], now.position[2]};
    const Vector velocity = cross(spin, way);
    ASSERT_OK(set_velocity(lab.world, arm, reals(velocity.x, velocity.y, velocity.z), reals(x, y, z)));
    const double start = energy(lab.motion(arm));
    for (int tick = 0; tick < 60; ++tick) {
      lab.run(1);
      ASSERT_LE(energy(lab.motion(arm)), 1.05 * start) << "round " << round << ", tick " << tick;
    }
  }
}

DETENT_TEST(joint, a_chain_between_two_walls_is_held_at_both_ends) {
  Lab lab(room(12, 11));
  const BodyId left = add_shape(lab, box(reals(0.1, 0.1, 0.1)), -0.5, 0, 0, BodyType::fixed);
  BodyId last = left;
  std::vector<JointId> joints;
  for (int i = 0; i < 10; ++i) {
    const BodyId link = add_shape(lab, box(reals(0.4, 0.05, 0.2)), 0.5 + i, 0, 0);
    joints.push_back(add_joint(lab, JointType::ball, last, link, i, 0, 0));
    last = link;
  }
  const BodyId right = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 10.5, 0, 0, BodyType::fixed);
  joints.push_back(add_joint(lab, JointType::ball, last, right, 9.99, 0, 0));
  double worst = 0;
  for (int tick = 0; tick < 600; ++tick) {
    lab.run(1);
    for (const JointId id : joints) worst = std::max(worst, length(joint_ends(lab.world, id).gap()));
  }
  EXPECT_LE(worst, 0.01);
}

DETENT_TEST(joint, a_door_on_two_hinges_is_held_by_either) {
  Lab lab(room(2, 2));
  const BodyId wall = add_shape(lab, box(reals(0.1, 1, 0.1)), -0.1, 0, 0, BodyType::fixed);
  const BodyId door = add_shape(lab, box(reals(0.5, 1, 0.05)), 0.5, 0, 0);
  const JointId low = add_joint(lab, JointType::hinge, wall, door, 0, -0.8, 0, {}, k_x_to_y);
  const JointId high = add_joint(lab, JointType::hinge, wall, door, 0, 0.8, 0, {}, k_x_to_y);
  ASSERT_OK(apply_impulse_at(lab.world, door, scaleds(0, 0, 50), reals(0.4, 0, 0)));
  double worst = 0, swing = 0;
  for (int tick = 0; tick < 300; ++tick) {
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.saturations, 0u);
    for (const JointId id : {low, high}) worst = std::max(worst, length(joint_ends(lab.world, id).gap()));
    swing = std::max(swing, joint_ends(lab.world, low).between(2));
  }
  EXPECT_LE(worst, 2e-3);
  EXPECT_GT(swing, 0.5);
}

DETENT_TEST(joint, a_ring_of_links_stays_closed) {
  constexpr int k_links = 6;
  Lab lab(room(k_links, k_links), weightless());
  std::vector<BodyId> links;
  std::vector<JointId> joints;
  const double radius = 1;
  for (int i = 0; i < k_links; ++i) {
    const double angle = 2 * k_pi * (i + 0.5) / k_links;
    links.push_back(add_shape(lab, sphere(real(0.2)), radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  for (int i = 0; i < k_links; ++i) {
    const double angle = 2 * k_pi * (i + 1) / k_links;
    joints.push_back(add_joint(lab, JointType::ball, links[static_cast<size_t>(i)],
                               links[static_cast<size_t>((i + 1) % k_links)], radius * std::cos(angle),
                               radius * std::sin(angle), 0));
  }
  ASSERT_OK(set_velocity(lab.world, links[0], reals(1, 0, 1), reals(0, 0, 0)));
  double worst = 0;
  for (int tick = 0; tick < 300; ++tick) {
    lab.run(1);
    for (const JointId id : joints) worst = std::max(worst, length(joint_ends(lab.world, id).gap()));
  }
  EXPECT_LE(worst, 0.02);
}

/// A wheel on an axle whose bearing is held at both of its ends, so that one joint closes a loop; `driven` says which
/// of the two hinges has the axis.
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
  EXPECT_NEAR(axle.lab.motion(axle.wheel).spin[2], gained, 0.02 * gained);
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

DETENT_TEST(joint, a_body_hangs_from_a_kinematic_one_as_that_turns) {
  Lab lab(room(2, 1));
  BodyDef arm;
  arm.type = BodyType::kinematic;
  arm.shape = box(reals(0.5, 0.1, 0.1));
  arm.spin = reals(0, 1, 0);
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

/// What a pendulum that falls from level loses or gains in 30 s, of what it falls through.
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
    const Vector velocity = {motion.velocity[0], motion.velocity[1], motion.velocity[2]};
    const double energy = dot(velocity, velocity) / 2 * (1 + 0.4 * 0.01) + 9.81 * motion.position[1];
    worst = std::max(worst, std::abs(energy) / 9.81);
  }
  return worst;
}

DETENT_TEST(joint, a_pendulum_keeps_its_energy) {
  EXPECT_LE(energy_lost(4), 0.02);
  EXPECT_LE(energy_lost(0), 0.04) << "most of it as it starts, at one substep";
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

DETENT_TEST(joint, bodies_that_it_connects_collide_only_if_it_says_so) {
  for (const bool collide : {false, true}) {
    Lab lab(room(2, 1), weightless());
    const BodyId a = lab.add_box(0.5, 0, 0, 0), b = lab.add_box(0.5, 0.9, 0, 0);
    JointDef rest;
    rest.collide = collide;
    add_joint(lab, JointType::ball, a, b, 0.45, 0, 0, rest);
    EXPECT_EQ(lab.run(1).contacts, collide ? 1u : 0u);
  }
}

DETENT_TEST(joint, one_that_bears_more_than_it_can_breaks_and_says_so) {
  Lab lab(room(2, 1));
  JointEvent events[2];
  lab.world.joint_events = {events, 2};
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
  EXPECT_EQ(lab.run(120).joints_broken, 0u);
  ASSERT_TRUE(is_valid(lab.world, joint));
  ASSERT_OK(apply_force(lab.world, box, scaleds(0, -5, 0)));
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.joints_broken, 1u);
  ASSERT_EQ(report.joint_events, 1u);
  EXPECT_FALSE(is_valid(lab.world, joint));
  EXPECT_TRUE(events[0].joint == joint && events[0].a == ground && events[0].b == box && events[0].user_data == 77);
  EXPECT_NEAR(scaled_to_host(events[0].reaction.force.y), 98.1 + 5, 0.05);
  lab.run(1);
  EXPECT_LT(lab.motion(box).velocity[1], -0.1) << "it falls";
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
  ASSERT_OK(put_to_sleep(lab.world, link[1]));
  EXPECT_FALSE(awake(link[1]));
  lab.run(1);
  EXPECT_TRUE(awake(link[1])) << "its neighbours move";
}

DETENT_TEST(joint, a_snapshot_holds_the_joints) {
  Pair pair(JointType::hinge);
  pair.lab.run(20);
  std::vector<uint64_t> saved = pair.lab.snapshot();
  pair.lab.run(30);
  const uint64_t later = digest(pair.lab.world);
  ASSERT_OK(destroy_joint(pair.lab.world, pair.joint));
  ASSERT_OK(restore(pair.lab.world, bytes_of(saved), byte_count(saved)));
  pair.lab.run(30);
  EXPECT_EQ(digest(pair.lab.world), later);
  ASSERT_OK(load(pair.lab.world, bytes_of(saved), byte_count(saved)));
  pair.lab.run(30);
  EXPECT_EQ(digest(pair.lab.world), later);
}

DETENT_TEST(joint, every_flipped_bit_of_a_joint_is_refused_or_can_be_stepped) {
  Pair pair(JointType::wheel);
  pair.lab.run(5);
  const std::vector<uint64_t> saved = pair.lab.snapshot();
  bool fits = false;
  const Layout layout = layout_of(get_info(pair.lab.world).capacity, fits);
  for (uint32_t bit = 0; bit < 8 * sizeof(JointState); ++bit) {
    std::vector<uint64_t> flipped = saved;
    bytes_of(flipped)[layout.joints + bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    if (load(pair.lab.world, bytes_of(flipped), byte_count(flipped)) == Status::ok) pair.lab.run(2);
  }
}

DETENT_TEST(joint, bad_definitions_are_refused_and_change_nothing) {
  Lab lab(room(3, 1));
  const BodyId a = lab.add_box(0.5, 0, 0, 0), b = lab.add_box(0.5, 2, 0, 0);
  const BodyId ground = add_shape(lab, box(reals(1, 1, 1)), 0, 5, 0, BodyType::fixed);
  const uint64_t before = digest(lab.world);
  JointId id;
  const auto refused = [&](Status expected, const auto& change) {
    JointDef def;
    def.a = a;
    def.b = b;
    change(def);
    EXPECT_STREQ(status_text(create_joint(lab.world, def, id)), status_text(expected));
    EXPECT_EQ(digest(lab.world), before);
    EXPECT_TRUE(id == JointId{});
  };
  refused(Status::bad_id, [&](JointDef& def) { def.a = {}; });
  refused(Status::bad_argument, [&](JointDef& def) { def.b = a; });
  refused(Status::bad_argument, [&](JointDef& def) { def.type = static_cast<JointType>(8); });
  refused(Status::not_normalised, [&](JointDef& def) { def.frame_b = {0.5, 0.0, 0.0, 0.5}; });
  refused(Status::out_of_range, [&](JointDef& def) { def.anchor_a = reals(0, 5000, 0); });
  refused(Status::out_of_range, [&](JointDef& def) { def.axis.lower = real(1); });
  refused(Status::out_of_range, [&](JointDef& def) { def.axis.frequency = real(2000); });
  refused(Status::out_of_range, [&](JointDef& def) { def.axis.force_max = scaled(-1); });
  refused(Status::out_of_range, [&](JointDef& def) { def.break_force = scaled(-1); });
  JointDef def;
  def.a = ground;
  def.b = b;
  ASSERT_OK(create_joint(lab.world, def, id));
  JointId second;
  EXPECT_EQ(create_joint(lab.world, def, second), Status::pool_full);
  ASSERT_OK(destroy_body(lab.world, b));
  EXPECT_FALSE(is_valid(lab.world, id)) << "its joints go with a body";
  EXPECT_EQ(destroy_joint(lab.world, id), Status::bad_id);
  def.b = a;
  ASSERT_OK(create_joint(lab.world, def, second));
  EXPECT_EQ(second.slot, id.slot);
  EXPECT_EQ(second.generation, 2u);
  EXPECT_TRUE(next_joint(lab.world, {}) == second && next_joint(lab.world, second) == JointId{});
}

DETENT_TEST(joint, a_world_without_them_refuses_them) {
  std::vector<uint64_t> words(world_bytes(room(2, 1)) / 8);
  WorldDef def;
  def.capacity = room(2, 1);
  World world;
  ASSERT_OK(create_world(bytes_of(words), byte_count(words), def, {}, world,
                         feature_table<without(Features::all, Features::joints)>));
  JointId id;
  EXPECT_EQ(create_joint(world, {}, id), Status::feature_missing);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
