#include "state/view.h"
#include "tests/unit/joint/joint_lab.h"

/// Tests that a step skips islands at rest, and which calls and events wake them.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_ticks_to_rest = 240;

bool awake(const Lab& lab, BodyId id) {
  bool result = false;
  EXPECT_OK(is_awake(lab.world, id, result));
  return result;
}

/// Two sleeping stacks of three boxes, ten metres apart.
struct Stacks {
  Lab lab = Lab({12, 40, 0}, {}, true);
  BodyId ground = lab.add_ground();
  BodyId left[3], right[3];

  Stacks() {
    for (int i = 0; i < 3; ++i) {
      left[i] = lab.add_box(0.5, 0, 0.5 + i, 0);
      right[i] = lab.add_box(0.5, 10, 0.5 + i, 0);
    }
    lab.run(k_ticks_to_rest);
    expect(false, false);
  }
  void expect(bool left_awake, bool right_awake) {
    for (const BodyId id : left) EXPECT_EQ(awake(lab, id), left_awake);
    for (const BodyId id : right) EXPECT_EQ(awake(lab, id), right_awake);
  }
};

DETENT_TEST(sleep, a_stack_at_rest_falls_asleep_and_the_step_then_changes_nothing_but_the_tick) {
  Stacks stacks;
  const std::vector<uint64_t> before = stacks.lab.snapshot();
  const StepReport report = stacks.lab.run(100);
  EXPECT_EQ(report.awake, 0u);
  EXPECT_EQ(report.bodies, 7u);
  EXPECT_EQ(report.tick, k_ticks_to_rest + 100);
  view_of(stacks.lab.world).world.tick = k_ticks_to_rest;
  EXPECT_EQ(stacks.lab.snapshot(), before);
  EXPECT_EQ(get_info(stacks.lab.world).contacts, 6u) << "they touch while they sleep";
}

DETENT_TEST(sleep, nothing_sleeps_in_a_world_without_it) {
  Lab lab({2, 4, 0});
  lab.add_ground();
  const BodyId id = lab.add_box(0.5, 0, 0.5, 0);
  EXPECT_EQ(lab.run(k_ticks_to_rest).awake, 1u);
  EXPECT_TRUE(awake(lab, id));
}

/// At 0.1 rad/s the surface of the rod moves at 3 mm/s in a rotation about its axis, and its ends at 50 mm/s in a
/// rotation about another axis.
DETENT_TEST(sleep, a_rod_may_turn_faster_about_its_axis_than_about_another) {
  Lab lab({2, 4, 0}, weightless(), true);
  const BodyId rolls = add_shape(lab, capsule(Real(0.03), Real(0.5)), 0, 0, 0);
  const BodyId swings = add_shape(lab, capsule(Real(0.03), Real(0.5)), 3, 0, 0);
  ASSERT_OK(set_velocity(lab.world, rolls, reals(0, 0, 0), reals(0, 0.1, 0)));
  ASSERT_OK(set_velocity(lab.world, swings, reals(0, 0, 0), reals(0.1, 0, 0)));
  lab.run(k_ticks_to_rest);
  EXPECT_FALSE(awake(lab, rolls));
  EXPECT_TRUE(awake(lab, swings));
}

DETENT_TEST(sleep, a_push_wakes_the_stack_it_meets_and_no_other) {
  Stacks stacks;
  ASSERT_OK(apply_impulse(stacks.lab.world, stacks.left[2], scaleds(1, 0, 0)));
  stacks.expect(true, false);
  EXPECT_EQ(stacks.lab.run(1).awake, 3u);
  stacks.lab.run(k_ticks_to_rest);
  stacks.expect(false, false);
}

DETENT_TEST(sleep, a_body_thrown_at_a_stack_wakes_all_of_it_in_the_tick_it_touches) {
  Stacks stacks;
  BodyDef ball;
  ball.shape = sphere(real(0.25));
  ball.position = position(-4, 1.5, 0);
  ball.linear_velocity = reals(8, 1, 0);
  stacks.lab.add(ball);
  uint32_t woke = 0, contacts = 0;
  for (int i = 0; i < 60 && woke == 0; ++i) {
    stacks.expect(false, false);
    const StepReport report = stacks.lab.run(1);
    woke = report.woke;
    contacts = report.contacts.count;
  }
  EXPECT_EQ(woke, 3u);
  EXPECT_GE(contacts, 4u) << "what stands on each other still does";
  stacks.expect(true, false);
  EXPECT_GT(stacks.lab.motion(stacks.left[1]).linear_velocity[0], 0.01) << "nothing of the blow is lost";
}

DETENT_TEST(sleep, bodies_that_fell_asleep_apart_wake_each_other_within_a_tick) {
  Stacks stacks;
  for (const BodyId id : stacks.left) ASSERT_OK(wake_body(stacks.lab.world, id));
  for (const BodyId id : stacks.left) ASSERT_OK(sleep_body(stacks.lab.world, id));
  stacks.expect(false, false);
  stacks.lab.run(1);
  ASSERT_OK(wake_body(stacks.lab.world, stacks.left[0]));
  const StepReport report = stacks.lab.run(1);
  EXPECT_EQ(report.woke, 2u);
  EXPECT_EQ(report.contacts.count, 3u);
  stacks.expect(true, false);
}

DETENT_TEST(sleep, a_kinematic_body_that_moves_wakes_what_it_touches) {
  Stacks stacks;
  BodyDef wall;
  wall.type = BodyType::kinematic;
  wall.shape = box(reals(0.25, 0.25, 0.25));
  wall.position = position(-2, 0.5, 0);
  const BodyId pusher = stacks.lab.add(wall);
  stacks.lab.run(10);
  EXPECT_FALSE(awake(stacks.lab, pusher));
  stacks.expect(false, false);
  ASSERT_OK(set_velocity(stacks.lab.world, pusher, reals(2, 0, 0), reals(0, 0, 0)));
  EXPECT_TRUE(awake(stacks.lab, pusher));
  stacks.lab.run(60);
  stacks.expect(true, false);
}

DETENT_TEST(sleep, what_loses_its_support_wakes) {
  Stacks destroyed;
  ASSERT_OK(destroy_body(destroyed.lab.world, destroyed.left[0]));
  EXPECT_TRUE(awake(destroyed.lab, destroyed.left[1]));
  EXPECT_TRUE(awake(destroyed.lab, destroyed.left[2]));
  destroyed.lab.run(k_ticks_to_rest);
  EXPECT_NEAR(destroyed.lab.motion(destroyed.left[2]).position[1], 1.5, 0.05);

  Stacks moved;
  ASSERT_OK(set_pose(moved.lab.world, moved.ground, position(0, -5, 0), {0.0, 0.0, 0.0, 1.0}));
  moved.expect(true, true);

  Stacks weightless;
  ASSERT_OK(set_gravity(weightless.lab.world, reals(0, 1, 0)));
  weightless.expect(true, true);
}

DETENT_TEST(sleep, is_given_and_taken_by_hand) {
  Lab lab({3, 4, 0}, {}, true);
  lab.add_ground();
  const BodyId id = lab.add_box(0.5, 0, 5, 0);
  ASSERT_OK(sleep_body(lab.world, id));
  EXPECT_FALSE(awake(lab, id));
  lab.run(60);
  EXPECT_EQ(lab.motion(id).position[1], 5) << "it sleeps in the air";
  ASSERT_OK(wake_body(lab.world, id));
  EXPECT_TRUE(awake(lab, id));
  lab.run(60);
  EXPECT_LT(lab.motion(id).position[1], 3);
  EXPECT_EQ(wake_body(lab.world, BodyId{1, 1}), Status::bad_argument);
  EXPECT_EQ(sleep_body(lab.world, BodyId{1, 1}), Status::bad_argument);
  EXPECT_EQ(wake_body(lab.world, BodyId{3, 1}), Status::bad_id);
  EXPECT_EQ(sleep_body(lab.world, BodyId{3, 1}), Status::bad_id);
  bool ignored = false;
  EXPECT_EQ(is_awake(lab.world, BodyId{3, 1}, ignored), Status::bad_id);
}

DETENT_TEST(sleep, survives_a_snapshot) {
  Stacks stacks;
  std::vector<uint64_t> snapshot = stacks.lab.snapshot();
  Stacks other;
  ASSERT_OK(apply_impulse(other.lab.world, other.right[1], scaleds(1000, 0, 0)));
  other.lab.run(30);
  ASSERT_OK(load(other.lab.world, bytes_of(snapshot), byte_count(snapshot)));
  for (Lab* lab : {&stacks.lab, &other.lab}) {
    ASSERT_OK(apply_impulse(lab->world, stacks.right[1], scaleds(500, 0, 0)));
    lab->run(30);
  }
  EXPECT_EQ(digest(stacks.lab.world), digest(other.lab.world));
}

/// The motion of a stack of three boxes far from a tower of four, whose top box has `mass` kg.
std::vector<double> neighbours_of_a_tower(double mass, uint32_t& substeps_max) {
  Lab lab({9, 40, 0});
  lab.add_ground();
  std::vector<BodyId> stack;
  for (int i = 0; i < 3; ++i) stack.push_back(lab.add_box(0.5, 20, 0.5 + i, 0));
  for (int i = 0; i < 3; ++i) lab.add_box(0.5, 0, 0.5 + i, 0);
  BodyDef top;
  top.shape = box(reals(0.5, 0.5, 0.5));
  top.position = position(0, 3.5, 0);
  top.mass = scaled(mass);
  const BodyId heavy = lab.add(top);
  substeps_max = lab.run(120).substeps_max;
  EXPECT_NEAR(lab.motion(heavy).position[1], 3.5, 0.05);
  std::vector<double> result;
  for (const BodyId id : stack) {
    EXPECT_LE(view_of(lab.world).activities[id.slot - 1].substeps, 3u) << "a light island stays cheap";
    const Motion motion = lab.motion(id);
    result.insert(result.end(), motion.position, motion.position + 3);
    result.insert(result.end(), motion.linear_velocity, motion.linear_velocity + 3);
  }
  return result;
}

DETENT_TEST(substeps, are_chosen_for_each_island_alone) {
  uint32_t light = 0, heavy = 0;
  EXPECT_EQ(neighbours_of_a_tower(1000, light), neighbours_of_a_tower(1e6, heavy));
  EXPECT_LE(light, 4u);
  EXPECT_GE(heavy, 24u);
}

DETENT_TEST(substeps, keep_the_number_that_is_asked_for) {
  WorldDef def;
  def.substeps = 5;
  Lab lab({3, 9, 0}, def);
  lab.add_ground();
  lab.add_box(0.5, 0, 0.5, 0);
  EXPECT_EQ(lab.run(10).substeps_max, 5u);
  def.substeps = 0;
  def.substeps_max = 1;
  Lab least({3, 9, 0}, def);
  least.add_ground();
  least.add_box(0.5, 0, 0.5, 0);
  EXPECT_EQ(least.run(10).substeps_max, 1u);
}

/// A light box bears one of 20 times its mass.
DETENT_TEST(substeps, keep_contacts_at_rest_within_the_permitted_penetration) {
  for (const double permitted : {1.0 / 32, 1.0 / 144, 1.0 / 512}) {
    WorldDef def;
    def.resting_penetration = real(permitted);
    def.substeps_max = 64;
    def.sleeping = false;
    Lab lab({3, 9, 0}, def);
    lab.add_ground();
    const BodyId light = lab.add_box(0.5, 0, 0.5, 0);
    BodyDef top;
    top.shape = box(reals(0.5, 0.5, 0.5));
    top.position = position(0, 1.5, 0);
    top.mass = scaled(20000);
    const BodyId heavy = lab.add(top);
    lab.run(240);
    const double sunk = 0.5 - lab.motion(light).position[1];
    const double between = lab.motion(light).position[1] + 1 - lab.motion(heavy).position[1];
    EXPECT_LE(sunk, permitted);
    EXPECT_LE(between, permitted);
    EXPECT_GT(sunk + between, permitted / 16) << "it takes no more substeps than that";
  }
}

DETENT_TEST(sleep, what_joints_hold_wakes_whom_its_longer_reach_touches) {
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  def.continuous = false;
  Lab lab({3, 8, 0, true, 1}, def, true);
  const BodyId sleeper = add_shape(lab, sphere(Real(0.5)), 1.6, 0, 0);
  const BodyId front = add_shape(lab, sphere(Real(0.5)), 0, 0, 0), back = add_shape(lab, sphere(Real(0.5)), -1, 0, 0);
  add_joint(lab, JointType::ball, front, back, -0.5, 0, 0);
  for (const BodyId id : {front, back}) ASSERT_OK(set_velocity(lab.world, id, reals(60, 0, 0), reals(0, 0, 0)));
  lab.run(1);  // from here on the work space holds what an earlier step left
  ASSERT_OK(set_pose(lab.world, front, position(0, 0, 0), {0.0, 0.0, 0.0, 1.0}));
  ASSERT_OK(set_pose(lab.world, back, position(-1, 0, 0), {0.0, 0.0, 0.0, 1.0}));
  ASSERT_OK(set_pose(lab.world, sleeper, position(1.6, 0, 0), {0.0, 0.0, 0.0, 1.0}));
  for (const BodyId id : {front, back}) ASSERT_OK(set_velocity(lab.world, id, reals(60, 0, 0), reals(0, 0, 0)));
  ASSERT_OK(sleep_body(lab.world, sleeper));
  const StepReport report = lab.run(1);
  EXPECT_TRUE(awake(lab, sleeper));
  EXPECT_EQ(report.woke, 1u);
  EXPECT_EQ(report.islands, 1u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
