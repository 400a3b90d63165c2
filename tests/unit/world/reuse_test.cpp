#include <math.h>

#include "state/view.h"
#include "tests/unit/world/lab.h"

/// Recycled contact points of pairs that hardly move, in worlds.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef box_def(double x, double y, double z, double at_y, BodyType type = BodyType::dynamic) {
  BodyDef def;
  def.type = type;
  def.shape = box(reals(x, y, z));
  def.position = position(0, at_y, 0);
  return def;
}

Lab make_tower(uint32_t boxes, double reuse = 1.0 / 256, bool sleeping = false) {
  WorldDef def;
  def.contact_recycle_distance = real(reuse);
  Lab lab({boxes + 2, 4 * boxes, 0}, def, sleeping);
  lab.add(box_def(4, 0.5, 4, -0.5, BodyType::fixed));
  for (uint32_t i = 0; i < boxes; ++i) lab.add_box(0.5, 0.03 * (i % 3), 0.5 + i, 0);
  return lab;
}

uint32_t kept_manifolds(const Lab& lab) {
  uint32_t count = 0;
  for (const ManifoldState& manifold : view_of(lab.world).manifolds)
    count += manifold.rotation == ManifoldState{}.rotation ? 0u : 1u;
  return count;
}

DETENT_TEST(reuse, a_standing_tower_finds_no_contact_anew_and_stands_as_well) {
  Lab lab = make_tower(6), other = make_tower(6, 0);
  uint32_t reused = 0, contacts = 0;
  for (int i = 0; i < 300; ++i) {
    const StepReport report = lab.run(1);
    reused += report.contacts.recycled;
    contacts += report.contacts.count;
    EXPECT_EQ(other.run(1).contacts.recycled, 0u);
  }
  EXPECT_GT(reused * 20, contacts * 19);
  EXPECT_EQ(kept_manifolds(lab), 6u);
  EXPECT_EQ(kept_manifolds(other), 0u);
  for (BodyId id = next_body(lab.world, {}); !(id == BodyId{}); id = next_body(lab.world, id)) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(lab.motion(id).position[k], other.motion(id).position[k], 2e-3);
  }
}

/// Their speeds are far above what they would be allowed if they approached.
DETENT_TEST(reuse, bodies_that_a_turntable_or_a_carrier_takes_along_are_slow_to_each_other) {
  for (const bool turns : {false, true}) {
    Lab lab({8, 32, 0});
    BodyDef carrier = box_def(4, 0.5, 4, -0.5, BodyType::kinematic);
    if (turns)
      carrier.angular_velocity = reals(0, 1, 0);
    else
      carrier.linear_velocity = reals(5, 0, 3);
    lab.add(carrier);
    for (int i = 0; i < 4; ++i) {
      BodyDef def = box_def(0.25, 0.25, 0.25, 0.25);
      def.position = position(i % 2 == 0 ? 1 : -1, 0.25, i < 2 ? 1 : -1);
      def.linear_velocity = turns ? reals(i < 2 ? 1 : -1, 0, i % 2 == 0 ? -1 : 1) : carrier.linear_velocity;
      def.angular_velocity = carrier.angular_velocity;
      lab.add(def);
    }
    uint32_t recycled = 0, contacts = 0;
    for (int i = 0; i < 120; ++i) {
      const StepReport report = lab.run(1);
      recycled += report.contacts.recycled;
      contacts += report.contacts.count;
    }
    EXPECT_GT(contacts, 400u) << turns;
    EXPECT_GT(recycled * 4, contacts * 3) << turns;
  }
}

DETENT_TEST(reuse, a_world_restored_amid_it_goes_on_with_the_same_bits) {
  Lab lab = make_tower(5), restored = make_tower(5), loaded = make_tower(5);
  for (int round = 0; round < 5; ++round) {
    lab.run(7 + 10 * static_cast<uint32_t>(round));
    std::vector<uint64_t> bytes = lab.snapshot();
    ASSERT_OK(restore(restored.world, bytes_of(bytes), byte_count(bytes)));
    ASSERT_OK(load(loaded.world, bytes_of(bytes), byte_count(bytes)));
    for (int i = 0; i < 20; ++i) {
      EXPECT_GT(lab.run(1).contacts.recycled, 0u);
      restored.run(1);
      loaded.run(1);
      ASSERT_EQ(digest(restored.world), digest(lab.world));
      ASSERT_EQ(digest(loaded.world), digest(lab.world));
    }
  }
}

DETENT_TEST(reuse, without_room_for_manifolds_a_world_is_smaller_and_does_what_it_does_with_reuse_off) {
  const Capacity without = {8, 24, 0, false};
  EXPECT_EQ(world_bytes({8, 24, 0}) - world_bytes(without), 24 * 2 * sizeof(ManifoldState));
  EXPECT_EQ(snapshot_bytes({8, 24, 0}) - snapshot_bytes(without), 24 * sizeof(ManifoldState));
  Lab lab = make_tower(6, 0), small(without);
  small.add(box_def(4, 0.5, 4, -0.5, BodyType::fixed));
  for (uint32_t i = 0; i < 6; ++i) small.add_box(0.5, 0.03 * (i % 3), 0.5 + i, 0);
  for (int i = 0; i < 100; ++i) {
    lab.run(1);
    EXPECT_EQ(small.run(1).contacts.recycled, 0u);
    ASSERT_EQ(digest(lab.world), digest(small.world));
  }
  std::vector<uint64_t> bytes = small.snapshot();
  EXPECT_EQ(load(lab.world, bytes_of(bytes), byte_count(bytes)), Status::capacity_differs);
  EXPECT_OK(load(small.world, bytes_of(bytes), byte_count(bytes)));
}

DETENT_TEST(reuse, a_body_put_elsewhere_is_found_anew) {
  Lab lab = make_tower(3);
  lab.run(60);
  const BodyId top = {4 + 1, 1};
  const BodyId upper = {4, 1};
  ASSERT_FALSE(is_valid(lab.world, top));
  ASSERT_EQ(lab.run(1).contacts.recycled, 3u);
  const Motion before = lab.motion(upper);
  // Moved sideways, but still above the next one.
  ASSERT_OK(
      set_pose(lab.world, upper, position(before.position[0] + 0.25, before.position[1], 0), Quat{0.0, 0.0, 0.0, 1.0}));
  StepReport report = lab.run(1);
  EXPECT_EQ(report.contacts.count, 3u);
  EXPECT_EQ(report.contacts.recycled, 2u);
  EXPECT_EQ(lab.run(1).contacts.recycled, 3u);
  // Turned on the spot.
  const double half_angle = 0.1;
  ASSERT_OK(set_pose(lab.world, upper, position(before.position[0], before.position[1], 0),
                     Quat{Unit(0.0), unit(sin(half_angle)), Unit(0.0), unit(cos(half_angle))}));
  EXPECT_EQ(lab.run(1).contacts.recycled, 2u);
  // Moved off it, and then to a very large distance.
  ASSERT_OK(
      set_pose(lab.world, upper, position(before.position[0], before.position[1] + 2, 0), Quat{0.0, 0.0, 0.0, 1.0}));
  report = lab.run(1);
  EXPECT_EQ(report.contacts.count, 2u);
  ASSERT_OK(set_pose(lab.world, upper, position(-30000, 30000, 30000), Quat{0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(lab.run(1).contacts.count, 2u);
}

DETENT_TEST(reuse, a_box_pushed_slowly_over_an_edge_falls_as_it_does_without) {
  uint32_t fell[2] = {};
  for (const bool reuses : {false, true}) {
    WorldDef def;
    def.contact_recycle_distance = real(reuses ? 1.0 / 256 : 0);
    Lab lab({3, 8, 0}, def);
    lab.add(box_def(2, 0.5, 2, -0.5, BodyType::fixed));
    BodyDef pushed = box_def(0.5, 0.5, 0.5, 0.5);
    pushed.position.x = coord(1.8);
    pushed.material.friction = real(0.0);
    pushed.linear_velocity = reals(0.1, 0, 0);
    const BodyId id = lab.add(pushed);
    uint32_t tick = 0, reused = 0;
    for (; tick < 600 && lab.motion(id).position[1] > 0; ++tick) reused += lab.run(1).contacts.recycled;
    fell[reuses ? 1 : 0] = tick;
    EXPECT_EQ(reused > 0, reuses);
  }
  EXPECT_LT(fell[0], 600u);
  EXPECT_NEAR(fell[1], fell[0], 3);
}

DETENT_TEST(reuse, a_pair_that_may_close_what_was_out_of_reach_is_found_anew) {
  for (const bool fast : {false, true}) {
    Lab lab = make_tower(2);
    lab.run(60);
    ASSERT_EQ(lab.run(1).contacts.recycled, 2u);
    ASSERT_OK(set_velocity(lab.world, {3, 1}, reals(fast ? 1.0 : 0.3, 0, 0), reals(0, 0, 0)));
    EXPECT_EQ(lab.run(1).contacts.recycled, fast ? 1u : 2u);
  }
}

/// A slab of half extent 20 m carries a box near its end, and rotates by its own motion.
DETENT_TEST(reuse, a_large_body_that_turns_carries_what_stands_far_out) {
  for (const bool about_y : {false, true}) {
    Lab lab({3, 8, 0});
    BodyDef slab = box_def(20, 0.5, 20, -0.5, BodyType::kinematic);
    const double angular_velocity = 0.002;
    slab.angular_velocity = reals(0, about_y ? angular_velocity : 0, about_y ? 0 : angular_velocity);
    const BodyId below = lab.add(slab);
    BodyDef rider = box_def(0.5, 0.5, 0.5, 0.5);
    rider.position.x = coord(15.0);
    rider.linear_velocity = reals(0, about_y ? 0 : 15 * angular_velocity, about_y ? -15 * angular_velocity : 0);
    const BodyId id = lab.add(rider);
    uint32_t reused = 0;
    for (int i = 0; i < 600; ++i) reused += lab.run(1).contacts.recycled;
    EXPECT_GT(reused, 300u);
    Pose pose_below, pose;
    EXPECT_OK(get_pose(lab.world, below, pose_below));
    EXPECT_OK(get_pose(lab.world, id, pose));
    const double angle = angular_velocity * 10;
    const double c = cos(angle), s = sin(angle);
    const Motion at = lab.motion(id);
    const double y = at.position[1] + 0.5;  // over the slab's middle
    const double along = about_y ? c * at.position[0] - s * at.position[2] : c * at.position[0] + s * y;
    const double above = about_y ? y : c * y - s * at.position[0];
    EXPECT_NEAR(along, 15, 5e-3);
    EXPECT_NEAR(above, 1, 4e-3);
  }
}

DETENT_TEST(reuse, sleepers_keep_their_manifolds_and_use_them_when_they_wake) {
  Lab lab = make_tower(3, 1.0 / 256, true);
  uint32_t ticks = 0;
  while (lab.run(1).awake != 0 && ticks < 1000) ++ticks;
  ASSERT_LT(ticks, 1000u);
  lab.run(10);
  EXPECT_EQ(kept_manifolds(lab), 3u);
  ASSERT_OK(wake_body(lab.world, {2, 1}));
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.contacts.count, 3u);
  EXPECT_EQ(report.contacts.recycled, 3u);
}

DETENT_TEST(reuse, every_state_of_a_heap_that_runs_out_of_room_can_be_loaded) {
  for (const uint32_t room : {200u, 40u}) {
    Lab lab({40, room, 0}, {}, true), other({40, room, 0});
    lab.add(box_def(3, 0.5, 3, -0.5, BodyType::fixed));
    for (uint32_t i = 0; i < 36; ++i) {
      BodyDef def;
      const Real some = real(0.2 + 0.02 * (i % 5)), more = real(0.25);
      def.shape = i % 4 == 0   ? box({some, more, some})
                  : i % 4 == 1 ? cylinder(some, more)
                  : i % 4 == 2 ? capsule(some, more)
                               : rounded(box({some, more, some}), real(0.05));
      def.position = position(0.6 * (i % 3) - 0.6, 0.5 + 0.6 * (i / 6), 0.6 * (i / 3 % 2) - 0.3);
      def.angular_velocity = reals(i % 3, 0, i % 2);
      lab.add(def);
    }
    uint32_t reused = 0, dropped = 0;
    for (int tick = 0; tick < 240; ++tick) {
      const StepReport report = lab.run(1);
      reused += report.contacts.recycled;
      dropped += report.lost.contacts;
      if (tick == 120) {
        EXPECT_OK(destroy_body(lab.world, {5, 1}));
      }
      if (tick % 4 != 0) continue;
      std::vector<uint64_t> bytes = lab.snapshot();
      ASSERT_OK(load(other.world, bytes_of(bytes), byte_count(bytes))) << "tick " << tick;
    }
    EXPECT_GT(reused, 0u);
    EXPECT_EQ(dropped > 0, room == 40);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
