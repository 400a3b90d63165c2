#include <algorithm>
#include <vector>

#include "tests/unit/joint/joint_lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

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

/// A horizontal chain of bricks from a wall, with joints of one type, and a weight of the given number of bricks at its
/// end.
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
  void hold_at_both_ends() {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(0.1, 0.1, 0.1));
    def.filter.mask = 0;
    const double end = lab.motion(last).position[0] + 0.25;
    def.position = position(end, 0, 0);
    add_joint(lab, JointType::ball, last, lab.add(def), end, 0, 0);
  }
  /// The greatest speed of a link, m/s.
  double fastest() {
    double speed = 0;
    for (BodyId id = next_body(lab.world, {}); !(id == BodyId{}); id = next_body(lab.world, id)) {
      const Motion motion = lab.motion(id);
      const double* const v = motion.linear_velocity;
      speed = std::max(speed, std::hypot(v[0], v[1], v[2]));
    }
    return speed;
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

/// The force on the links has no upper bound.
DETENT_TEST(joint, a_chain_taut_between_two_walls_stays_together) {
  for (const int links : {10, 20, 40}) {
    SCOPED_TRACE(links);
    HangingChain chain(links, 1);
    chain.hold_at_both_ends();
    double widest = 0;
    for (int tick = 0; tick < 600; ++tick) {
      chain.lab.run(1);
      widest = std::max(widest, chain.widest());
    }
    EXPECT_LE(widest, 0.01);
  }
}

/// Its tension is 1,000 times the weight of a link, so that rows which yield by their softness let it sink at 0.1 m/s.
DETENT_TEST(joint, a_chain_taut_between_two_walls_comes_to_rest) {
  HangingChain chain(40, 1);
  chain.hold_at_both_ends();
  chain.lab.run(180);
  EXPECT_LE(chain.fastest(), 5e-3);
  EXPECT_LE(chain.widest(), 1e-3);
}

/// The impulses with which the next substep begins are then too great, and nothing opposes them.
DETENT_TEST(joint, a_taut_chain_that_loses_its_weight_is_not_thrown) {
  HangingChain chain(40, 1);
  chain.hold_at_both_ends();
  chain.lab.run(180);
  ASSERT_OK(set_gravity(chain.lab.world, reals(0, 0, 0)));
  double fastest = 0;
  for (int tick = 0; tick < 60; ++tick) {
    chain.lab.run(1);
    fastest = std::max(fastest, chain.fastest());
  }
  EXPECT_LE(fastest, 0.02);
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

/// A plate, on which two pairs of balls stand without weight, as one island. The upper ball of a pair moves sideways,
/// so it pulls the lower one off the plate: no contact has an impulse.
struct PairsOnAPlate {
  Lab lab{room(5, 2), weightless(8)};
  BodyId lower{}, upper{};

  PairsOnAPlate(bool plate, double speed_of_other) {
    if (plate) {
      add_shape(lab, box(reals(2, 0.1, 2)), 0, 0, 0);
      add_pair(1, speed_of_other);
    }
    upper = add_pair(-1, 2);
    lower = {upper.slot - 1, upper.generation};
  }
  BodyId add_pair(double x, double speed) {
    const BodyId low = add_shape(lab, sphere(real(0.1)), x, 0.2, 0);
    const BodyId high = add_shape(lab, sphere(real(0.1)), x, 0.6, 0);
    add_joint(lab, JointType::ball, low, high, x, 0.4, 0);
    EXPECT_OK(set_velocity(lab.world, high, reals(speed, 0, 0), reals(0, 0, 0)));
    return high;
  }
};

DETENT_TEST(joint, assemblies_that_touch_are_solved_alone) {
  PairsOnAPlate beside_rest(true, 0), beside_motion(true, 30), alone(false, 0);
  const StepReport report = beside_rest.lab.run(1);
  EXPECT_EQ(report.islands, 1u);
  EXPECT_EQ(report.contacts.count, 2u);
  beside_motion.lab.run(1);
  alone.lab.run(1);
  for (const bool upper : {false, true}) {
    const auto motion = [&](PairsOnAPlate& pairs) { return pairs.lab.motion(upper ? pairs.upper : pairs.lower); };
    const Motion a = motion(beside_rest), b = motion(beside_motion), c = motion(alone);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(a.position[i], b.position[i]);
      EXPECT_EQ(a.linear_velocity[i], b.linear_velocity[i]);
      EXPECT_EQ(a.angular_velocity[i], b.angular_velocity[i]);
      // Contacts without impulses change only the rate at which gaps are closed. fx32 stores velocities in units of
      // 2^-14.
      constexpr double k_near = k_config == Config::fx32 ? 0x1p-12 : 1e-5;
      EXPECT_NEAR(a.linear_velocity[i], c.linear_velocity[i], k_near);
      EXPECT_NEAR(a.angular_velocity[i], c.angular_velocity[i], k_near);
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
