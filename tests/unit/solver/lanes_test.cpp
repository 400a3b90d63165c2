#include <detent/joint.h>

#include "tests/unit/math/samples.h"
#include "tests/unit/world/lab.h"

// Compares the solver's passes over four or eight contacts at once with passes over one: every digest of every tick is
// equal.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A pile of all shapes that fall on each other, some of them rolling or heavy, beside a lift and a rotating table.
void build(Lab& lab, uint64_t seed) {
  Samples samples = {seed};
  const auto within = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(samples.below(1u << 20)) / (1 << 20));
  };
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  lab.add(ground);
  BodyDef table;
  table.type = BodyType::kinematic;
  table.shape = box(reals(2, 0.25, 2));
  table.position = position(0, 0.5, 0);
  table.linear_velocity = reals(0, 0.25, 0);
  table.angular_velocity = reals(0, 1, 0);
  lab.add(table);
  for (int i = 0; i < 60; ++i) {
    BodyDef def;
    const double size = within(0.2, 0.5), x = within(-2, 2), z = within(-2, 2);
    const double density = within(100, 4000), restitution = within(-0.5, 0.5);
    const double rolling = within(-0.05, 0.05), friction = within(0, 1);
    switch (i % 5) {
      case 0:
        def.shape = sphere(real(size));
        break;
      case 1:
        def.shape = capsule(real(size), real(size));
        break;
      case 2:
        def.shape = cylinder(real(size), real(size));
        break;
      default:
        def.shape = box(reals(size, 0.3, 0.4));
        break;
    }
    def.position = position(x, 1.5 + 0.4 * i, z);
    def.density = scaled(density);
    def.material.friction = real(friction);
    def.material.restitution = real(restitution < 0 ? 0 : restitution);
    def.material.rolling_resistance = real(rolling < 0 ? 0 : rolling);
    lab.add(def);
  }
}

void expect_same_bits(WorldDef def) {
  for (const uint64_t seed : {1u, 2u, 3u}) {
    Lab one({64, 400, 0}, def), four({64, 400, 0}, def), most({64, 400, 0}, def);
    for (Lab* const lab : {&one, &four, &most}) build(*lab, seed);
    if (one.world.lanes == 1) GTEST_SKIP() << "this machine, or this build, takes one contact at a time";
    one.world.lanes = 1;
    four.world.lanes = 4;
    uint64_t solved = 0;
    for (int tick = 0; tick < 240; ++tick) {
      solved += step(one.world).contacts.substeps;
      (void)step(most.world);
      ASSERT_EQ(digest(one.world), digest(most.world)) << "seed " << seed << ", tick " << tick;
      if (most.world.lanes == 4) continue;
      (void)step(four.world);
      ASSERT_EQ(digest(one.world), digest(four.world)) << "seed " << seed << ", tick " << tick;
    }
    EXPECT_GT(solved, 10000u);
  }
}

/// A build without lanes, or with four, accepts the request, too.
DETENT_TEST(lanes, that_are_asked_for_solve_every_contact) {
  for (const uint32_t lanes : {4u, 8u}) {
    Lab one({64, 400, 0}), asked({64, 400, 0});
    build(one, 1);
    build(asked, 1);
#if defined(__x86_64__) && !defined(DETENT_F64)
    if (one.world.lanes == 1) GTEST_SKIP() << "this machine takes one contact at a time";
    if (one.world.lanes < lanes) continue;  // an error of the caller
#endif
    one.world.lanes = 1;
    asked.world.lanes = lanes;
    for (int tick = 0; tick < 240; ++tick) {
      (void)step(one.world);
      (void)step(asked.world);
      ASSERT_EQ(digest(one.world), digest(asked.world)) << lanes << " lanes, tick " << tick;
    }
  }
}

DETENT_TEST(lanes, give_the_bits_of_one_contact_at_a_time) { expect_same_bits({}); }

/// Islands of one to four bodies, some jointed, some falling: they are solved together (group_islands()) where contacts
/// are solved in lanes, and one after the other where they are not.
DETENT_TEST(lanes, give_the_same_bits_where_islands_are_small) {
  const auto make = [](Lab& lab) {
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = box(reals(40, 1, 40));
    ground.position = position(0, -1, 0);
    lab.add(ground);
    for (int i = 0; i < 30; ++i) {
      BodyId last = {};
      for (int level = 0; level <= i % 4; ++level) {
        BodyDef def;
        def.shape = (i + level) % 3 == 0 ? sphere(real(0.5)) : box(reals(0.5, 0.5, 0.5));
        def.position = position(5 * (i % 6) - 12, 0.5 + 1.02 * level + 0.25 * (i % 5), 5 * (i / 6) - 12);
        def.density = scaled(100 * (1 + i % 7));
        const BodyId id = lab.add(def);
        JointDef joint;
        joint.a = last;
        joint.b = id;
        joint.anchor_a = reals(0, 0.51, 0);
        joint.anchor_b = reals(0, -0.51, 0);
        JointId ignored;
        if (level != 0 && i % 5 == 4) {
          ASSERT_OK(create_joint(lab.world, joint, ignored));
        }
        last = id;
      }
    }
  };
  WorldDef def;
  def.sleeping = false;
  Capacity capacity;
  capacity.bodies = 128;
  capacity.contacts = 400;
  capacity.joints = 32;
  Lab one(capacity, def), most(capacity, def);
  make(one);
  make(most);
  one.world.lanes = 1;
  if (most.world.lanes == 1) GTEST_SKIP() << "this machine, or this build, takes one contact at a time";
  for (int tick = 0; tick < 180; ++tick) {
    const StepReport report = step(one.world);
    EXPECT_GT(report.islands, 10u);
    EXPECT_EQ(step(most.world).contacts.substeps, report.contacts.substeps);
    ASSERT_EQ(digest(one.world), digest(most.world)) << tick;
  }
}

DETENT_TEST(lanes, give_the_same_bits_whatever_the_settings) {
  WorldDef def;
  def.relaxation = real(1.25);
  def.iterations = 3;
  def.substeps = 5;
  def.damping_ratio = real(2);
  def.gravity = reals(3, -20, 1);
  expect_same_bits(def);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
