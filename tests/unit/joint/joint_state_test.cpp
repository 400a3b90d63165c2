#include <detent/body.h>
#include <detent/world.h>

#include <math.h>
#include <string.h>

#include <vector>

#include "tests/unit/joint/joint_lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A step reads no work space of an earlier tick: tested for bodies that do not move, for loops, and for joints that
/// hold points only.
DETENT_TEST(joint, what_the_work_space_holds_before_a_step_does_not_matter) {
  const auto fill = [](Lab& lab, uint8_t byte) {
    const Capacity capacity = get_info(lab.world).capacity;
    bool fits = false;
    const Layout layout = layout_of(capacity, fits);
    memset(lab.block() + layout.joint_work, byte, sizeof(JointWork) * capacity.joints);
    memset(lab.block() + layout.joint_bodies, byte, sizeof(JointBody) * joint_body_count(capacity));
    if (k_may_have_joint_lanes) memset(lab.block() + layout.joint_lanes, byte, sizeof(JointLanes) * capacity.joints);
    memset(lab.block() + layout.joint_numbers, byte,
           sizeof(Real) * joint_number_room<k_may_have_joint_lanes>(capacity));
  };
  for (const JointType type : k_joint_types) {
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

/// With lanes the rows of a block have 4 or 8 numbers. The count of couplings and that of their numbers without this
/// rounding are limited. The room that these limits permit is greatest for couplings of at most two shapes, because
/// there are two limits.
DETENT_TEST(joint, the_room_for_blocks_with_lanes_holds_whatever_the_limits_permit) {
  struct Shape {
    double numbers, room;
  };
  std::vector<Shape> shapes;
  for (int rows = 1; rows <= 6; ++rows) {
    for (int width = 1; width <= 6; ++width) shapes.push_back({1.0 * rows * width, rows * (width > 4 ? 8.0 : 4.0)});
  }
  for (const uint32_t joints : {1u, 2u, 3u, 8u, 14u, 15u, 16u, 31u, 32u, 33u, 1000u}) {
    const Capacity capacity = room(2, joints);
    const double couplings = joint_coupling_count(capacity), numbers = joint_number_count(capacity);
    double most = 0;
    for (const Shape& one : shapes) {
      most = fmax(most, one.room * fmin(couplings, numbers / one.numbers));
      for (const Shape& other : shapes) {  // both limits are reached
        const double of_one = (numbers - couplings * other.numbers) / (one.numbers - other.numbers);
        if (of_one >= 0 && of_one <= couplings)
          most = fmax(most, of_one * one.room + (couplings - of_one) * other.room);
      }
    }
    EXPECT_LE(most, 9 * numbers / 4) << joints;
    EXPECT_EQ(joint_number_count(capacity) % 4, 0u) << joints;
    EXPECT_EQ(joint_number_room<true>(capacity),
              k_may_have_joint_lanes ? joint_number_count(capacity) / 4 * 9 : joint_number_count(capacity));
  }
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
  refused(Status::bad_argument, [&](JointDef& def) { def.type = static_cast<JointType>(10); });
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
  ASSERT_OK(create_world(bytes_of(words), byte_count(words), def, {},
                         feature_table<without(Features::all, Features::joints)>, world));
  JointId id;
  EXPECT_EQ(create_joint(world, {}, id), Status::feature_missing);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
