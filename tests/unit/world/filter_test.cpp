#include <detent/body.h>

#include "tests/unit/world/lab.h"

/// Which bodies touch.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A rule: bodies collide if the sum of their user data is even.
bool even_sum(const FilterBody& own, const FilterBody& other) { return (own.user_data + other.user_data) % 2 == 0; }
bool not_the_other_group(const FilterBody& own, const FilterBody& other) {
  return own.filter.group == other.filter.group;
}
const FilterRule k_rules[] = {even_sum, not_the_other_group, nullptr};
const FilterRuleTable k_table = {k_rules, 3};

BodyDef box_at(double y, const Filter& filter, uint32_t user_data = 0) {
  BodyDef def;
  def.shape = box(reals(0.5, 0.5, 0.5));
  def.position = position(0, y, 0);
  def.filter = filter;
  def.user_data = user_data;
  return def;
}

bool rests_on(Lab& lab, BodyId upper, double height) {
  lab.run(120);
  return lab.motion(upper).position[1] > height - 0.1;
}

/// Whether a box comes to rest on a fixed one, or falls through it.
bool touch(const Filter& a, const Filter& b, uint32_t data_a = 0, uint32_t data_b = 0, double speed = 0) {
  Lab lab({2, 4, 0});
  lab.world.hooks.filter_rules = k_table;
  BodyDef fixed = box_at(0, a, data_a);
  fixed.type = BodyType::fixed;
  lab.add(fixed);
  BodyDef falling = box_at(1.2, b, data_b);
  falling.linear_velocity = reals(0, -speed, 0);
  return rests_on(lab, lab.add(falling), 1);
}

DETENT_TEST(filter, categories_masks_groups_and_rules_say_who_touches) {
  const double speeds[] = {0, 500};  // by contact points, and by continuous collision
  for (const double speed : speeds) {
    const auto meet = [&](const Filter& a, const Filter& b, uint32_t data_a = 0, uint32_t data_b = 0) {
      const bool touches = touch(a, b, data_a, data_b, speed);
      EXPECT_EQ(touch(b, a, data_b, data_a, speed), touches);
      return touches;
    };
    EXPECT_TRUE(meet({}, {}));
    EXPECT_FALSE(meet({1, 2, 0, 0}, {1, ~0u, 0, 0})) << "the first does not want the second";
    EXPECT_TRUE(meet({1, 2, 0, 0}, {2, 1, 0, 0}));
    EXPECT_FALSE(meet({4, ~0u, 0, 0}, {2, 3, 0, 0}));
    EXPECT_FALSE(meet({0, ~0u, 0, 0}, {}));
    EXPECT_TRUE(meet({1, 0, 5, 0}, {1, 0, 5, 0})) << "of one positive group";
    EXPECT_FALSE(meet({1, ~0u, -5, 0}, {1, ~0u, -5, 0})) << "of one negative group";
    EXPECT_TRUE(meet({1, ~0u, -5, 0}, {1, ~0u, -6, 0}));
    EXPECT_FALSE(meet({1, 0, 5, 0}, {1, 0, 6, 0}));
    EXPECT_TRUE(meet({1, ~0u, 0, 1}, {}, 3, 5));
    EXPECT_FALSE(meet({1, ~0u, 0, 1}, {}, 3, 4));
    EXPECT_FALSE(meet({1, ~0u, 2, 2}, {1, ~0u, 3, 1}, 2, 4)) << "one rule of two forbids";
    EXPECT_TRUE(meet({1, 0, 3, 2}, {1, 0, 3, 1}, 2, 4));
    EXPECT_FALSE(meet({1, 0, 3, 2}, {1, 0, 3, 1}, 2, 5)) << "a rule forbids what a group allows";
    EXPECT_FALSE(meet({1, 2, 0, 1}, {}, 2, 4)) << "a rule does not allow what masks forbid";
  }
}

DETENT_TEST(filter, a_rule_that_the_table_lacks_is_refused_wherever_it_comes_from) {
  Lab lab({2, 4, 0});
  BodyId id;
  const Filter ruled = {1, ~0u, 0, 1};
  EXPECT_EQ(create_body(lab.world, box_at(1, ruled), id), Status::rule_missing);
  lab.world.hooks.filter_rules = k_table;
  EXPECT_EQ(create_body(lab.world, box_at(1, {1, ~0u, 0, 3}), id), Status::rule_missing) << "null in the table";
  EXPECT_EQ(create_body(lab.world, box_at(1, {1, ~0u, 0, 4}), id), Status::rule_missing);
  ASSERT_OK(create_body(lab.world, box_at(1, ruled), id));
  EXPECT_EQ(set_filter(lab.world, id, {1, ~0u, 0, 4}), Status::rule_missing);
  Filter filter;
  ASSERT_OK(get_filter(lab.world, id, filter));
  EXPECT_TRUE(filter == ruled);
  EXPECT_EQ(get_filter(lab.world, {}, filter), Status::bad_id);
  EXPECT_EQ(set_filter(lab.world, {}, filter), Status::bad_id);
  Lab other({2, 4, 0});
  std::vector<uint64_t> snapshot = lab.snapshot();
  const uint64_t before = digest(other.world);
  EXPECT_EQ(load(other.world, bytes_of(snapshot), byte_count(snapshot)), Status::rule_missing);
  EXPECT_EQ(digest(other.world), before);
  other.world.hooks.filter_rules = {k_rules, 1};
  snapshot = lab.snapshot();
  EXPECT_OK(load(other.world, bytes_of(snapshot), byte_count(snapshot)));
  EXPECT_EQ(digest(other.world), digest(lab.world));
}

/// Two boxes asleep, one on the other, on the ground; with a buffer for contact events.
struct Sleepers {
  Lab lab;
  BodyId ground, low, high;
  std::vector<ContactEvent> buffer;

  Sleepers() : lab({4, 8, 0}, {}, true), buffer(8) {
    lab.world.hooks.filter_rules = k_table;
    lab.world.hooks.contact_events = {buffer.data(), 8};
    ground = lab.add_ground();
    low = lab.add(box_at(0.5, {}, 2));
    high = lab.add(box_at(1.5, {1, ~0u, 0, 1}, 4));
    lab.run(200);
    EXPECT_FALSE(awake(low) || awake(high));
  }
  bool awake(BodyId id) {
    bool result = false;
    EXPECT_OK(is_awake(lab.world, id, result));
    return result;
  }
  void expect_parted(BodyId a, BodyId b) {
    EXPECT_TRUE(awake(low) && awake(high));
    const StepReport report = lab.run(1);
    uint32_t ends = 0;
    for (uint32_t i = 0; i < report.events.contact; ++i) {
      if (buffer[i].type != ContactEventType::end) continue;
      ++ends;
      EXPECT_TRUE(buffer[i].a == a && buffer[i].b == b);
    }
    EXPECT_EQ(ends, 1u);
  }
};

DETENT_TEST(filter, a_change_ends_contacts_that_are_no_longer_allowed_and_wakes_both) {
  {
    Sleepers sleepers;
    ASSERT_OK(set_filter(sleepers.lab.world, sleepers.high, {2, ~0u, 0, 1}));
    EXPECT_EQ(sleepers.lab.run(1).contacts.count, 2u);
    sleepers.lab.run(200);
    ASSERT_OK(set_filter(sleepers.lab.world, sleepers.low, {1, 1, 0, 0}));
    sleepers.expect_parted(sleepers.low, sleepers.high);
    EXPECT_TRUE(rests_on(sleepers.lab, sleepers.high, 0.5)) << "on the ground, within the other";
  }
  {
    Sleepers sleepers;
    ASSERT_OK(set_filter(sleepers.lab.world, sleepers.ground, {1, 2, 0, 0}));
    EXPECT_TRUE(sleepers.awake(sleepers.low));
    EXPECT_EQ(sleepers.lab.run(1).contacts.count, 1u) << "both fall";
  }
  {
    Sleepers sleepers;
    ASSERT_OK(set_user_data(sleepers.lab.world, sleepers.ground, 2));
    ASSERT_OK(set_user_data(sleepers.lab.world, sleepers.low, 6));
    EXPECT_FALSE(sleepers.awake(sleepers.low)) << "the rule still allows it";
    ASSERT_OK(set_user_data(sleepers.lab.world, sleepers.low, 3));
    sleepers.expect_parted(sleepers.low, sleepers.high);
  }
}

DETENT_TEST(filter, what_may_not_touch_is_no_pair_and_takes_no_room) {
  Lab lab({41, 8, 0});
  lab.add_ground();
  for (int i = 0; i < 40; ++i) {
    BodyDef def = box_at(3, {1, ~0u, -1, 0});
    def.position = position(0.01 * i, 3, 0);
    lab.add(def);
  }
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.contacts.pairs, 40u) << "with the ground";
  EXPECT_EQ(report.contacts.count, 0u);
}

DETENT_TEST(filter, what_rebounds_within_a_tick_passes_through_what_it_may_not_touch) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  const auto end_of = [&](uint32_t mask) {
    Lab lab({3, 8, 0}, world);
    const double planes[] = {0, -5};
    for (const double x : planes) {
      BodyDef plane;
      plane.type = BodyType::fixed;
      plane.shape = box(reals(0.01, 4, 4));
      plane.position = position(x, 0, 0);
      plane.filter.mask = x < 0 ? mask : ~0u;
      lab.add(plane);
    }
    BodyDef ball;
    ball.shape = sphere(real(0.125));
    ball.position = position(-2, 1, 0.5);
    ball.linear_velocity = reals(600, 0, 0);
    ball.material.restitution = real(1);
    const BodyId id = lab.add(ball);
    lab.run(1);
    return lab.motion(id).position[0];
  };
  EXPECT_GT(end_of(1), -5);
  EXPECT_NEAR(end_of(2), -8, 0.5);
}

DETENT_TEST(filter, a_sleeper_is_not_woken_by_what_may_not_touch_it) {
  Sleepers sleepers;
  BodyDef def = box_at(0.5, {2, ~0u, 0, 0});
  def.filter.mask = 4;
  def.linear_velocity = reals(0, 0, 1);
  def.gravity_scale = real(0);
  sleepers.lab.add(def);
  const StepReport report = sleepers.lab.run(3);
  EXPECT_EQ(report.awake, 1u);
  EXPECT_EQ(report.woke, 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
