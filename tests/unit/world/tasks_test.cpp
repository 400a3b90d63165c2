#include "examples/scenes/scene.h"
#include "tests/common/support/scheduler.h"
#include "tests/unit/replay/match.h"
#include "tests/unit/world/lab.h"
#include "tests/unit/world/same_step.h"
#include "tests/unit/world/turmoil.h"
#include "threads/thread_pool.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(tasks, change_no_bit_of_the_scenes) {
  uint32_t count = 0;
  const Scene* const all = scenes(count);
  for (uint32_t i = 0; i < count; ++i) {
    const Scene& scene = all[i];
    for (Scheduler scheduler : k_schedulers) {
      Recording alone(scene.world(), false), shared(scene.world(), false);
      scene.build(alone.recorder);
      scene.build(shared.recorder);
      shared.owned.world.hooks.tasks = scheduler.tasks();
      const uint32_t ticks = scheduler.workers > 8 || scheduler.delayed ? 3 : 12;
      for (uint32_t tick = 0; tick < ticks; ++tick) {
        if (scene.before_tick != nullptr) {
          scene.before_tick(alone.recorder, tick);
          scene.before_tick(shared.recorder, tick);
        }
        expect_equal(shared.recorder.step(), alone.recorder.step());
        ASSERT_EQ(digest(shared.owned.world), digest(alone.owned.world))
            << scene.name << ", tick " << tick << ", " << scheduler.workers << " workers";
        if (HasFailure()) return;
      }
    }
  }
}

/// Random ticks with all kinds of bodies and joints, from worlds in equal states.
DETENT_TEST(tasks, change_no_bit_of_random_ticks) {
  for (uint64_t seed = 1; seed <= 45; ++seed) {
    Scheduler scheduler = k_schedulers[seed % 11];
    OwnedWorld alone = make_turmoiled(seed, 0), shared = make_turmoiled(seed, 0);
    shared.world.hooks.tasks = scheduler.tasks();
    for (uint32_t tick = 0; tick < 24; ++tick) {
      make_turmoil(alone.world, seed * 100 + tick);
      make_turmoil(shared.world, seed * 100 + tick);
      ASSERT_EQ(digest(shared.world), digest(alone.world)) << "seed " << seed << ", tick " << tick;
    }
  }
}

/// A heap of boxes and balls between walls, with chains that hang from the ceiling and from a kinematic body, a turning
/// floor and a sensor.
struct Heap : Lab {
  std::vector<ContactEvent> events = std::vector<ContactEvent>(200);
  std::vector<CapacityEvent> lost = std::vector<CapacityEvent>(50);

  Heap(uint32_t count, Capacity capacity, bool sleeping) : Lab(capacity, {}, sleeping) {
    world.hooks.contact_events = {events.data(), 200};
    world.hooks.capacity_events = {lost.data(), 50};
    add_ground();
    const BodyId ceiling = add_holder(0.0, 9.0, BodyType::fixed);
    const BodyId crane = add_holder(2.0, 7.0, BodyType::kinematic);
    EXPECT_OK(set_velocity(world, crane, reals(-0.4, 0.0, 0.1), reals(0.0, 0.3, 0.0)));
    BodyDef plate;
    plate.type = BodyType::kinematic;
    plate.shape = box(reals(2.0, 0.2, 2.0));
    plate.position = position(0.0, 0.2, 0.0);
    const BodyId turning = add(plate);
    EXPECT_OK(set_velocity(world, turning, reals(0.0, 0.0, 0.0), reals(0.0, 1.0, 0.0)));
    for (uint32_t i = 0; i < count; ++i) {
      BodyDef def;
      def.shape = i % 3 == 0 ? sphere(real(0.2)) : box(reals(0.2, 0.15 + 0.01 * (i % 7), 0.25));
      def.position = position(0.5 * (i % 6) - 1.3, 0.8 + 0.45 * (i / 36), 0.5 * (i / 6 % 6) - 1.3);
      def.material.restitution = real(i % 5 == 0 ? 0.5 : 0.0);
      add(def);
    }
    for (const BodyId holder : {ceiling, crane}) {
      for (uint32_t chain = 0; chain < 3; ++chain) hang_chain(holder, chain);
    }
  }
  BodyId add_holder(double x, double y, BodyType type) {
    BodyDef def;
    def.type = type;
    def.shape = box(reals(0.3, 0.1, 0.3));
    def.position = position(x, y, 0.0);
    return add(def);
  }
  void hang_chain(BodyId from, uint32_t chain) {
    Pose holder;
    EXPECT_OK(get_pose(world, from, holder));
    BodyId above = from;
    for (uint32_t link = 0; link < 4; ++link) {
      const double x = coord_to_host(holder.position.x) + 0.2 * chain,
                   y = coord_to_host(holder.position.y) - 0.3 - 0.3 * link;
      BodyDef def;
      def.shape = capsule(real(0.05), real(0.1));
      def.position = position(x, y, coord_to_host(holder.position.z));
      const BodyId below = add(def);
      JointDef joint;
      joint.a = above;
      joint.b = below;
      joint.type = JointType::ball;
      EXPECT_OK(place_joint(world, position(x, y + 0.15, coord_to_host(holder.position.z)), joint.frame_a, joint));
      JointId id;
      EXPECT_OK(create_joint(world, joint, id));
      above = below;
    }
  }
};

void expect_equal_heaps(uint32_t count, Capacity capacity, bool sleeping, const Tasks& tasks, uint32_t ticks) {
  Heap alone(count, capacity, sleeping), shared(count, capacity, sleeping);
  shared.world.hooks.tasks = tasks;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    const StepReport report = step(shared.world);
    expect_equal(report, step(alone.world));
    ASSERT_EQ(digest(shared.world), digest(alone.world)) << "tick " << tick;
    expect_equal(shared.events, alone.events, report.events.contact);
    for (uint32_t i = 0; i < 50; ++i) {
      ASSERT_EQ(shared.lost[i].a, alone.lost[i].a);
      ASSERT_EQ(shared.lost[i].b, alone.lost[i].b);
    }
    if (testing::Test::HasFailure()) return;
  }
}

DETENT_TEST(tasks, change_no_bit_of_a_heap_on_a_pool_of_threads) {
  for (const uint32_t workers : {2u, 8u}) {
    detent_host::ThreadPool pool(workers);
    expect_equal_heaps(250, {320, 1400, 0, true, 40}, workers == 2, pool.tasks<Tasks>(), 40);
  }
}

DETENT_TEST(tasks, drop_the_same_pairs_and_contacts_where_pools_are_full) {
  for (const uint32_t contacts : {40u, 150u, 400u}) {
    Scheduler scheduler = {Calls::threads, Parts::shuffled, 3};
    expect_equal_heaps(150, {220, contacts, 0, true, 40}, false, scheduler.tasks(), 40);
  }
}

std::thread::id rule_thread;
bool rules_stayed = true;
bool allow_all(const FilterBody&, const FilterBody&) {
  rules_stayed = rules_stayed && std::this_thread::get_id() == rule_thread;
  return true;
}

DETENT_TEST(tasks, leave_the_rules_of_filters_to_the_thread_that_steps) {
  constexpr FilterRule k_rules[] = {allow_all};
  Scheduler scheduler = {Calls::threads, Parts::shuffled, 3};
  Lab lab({120, 500, 0, true});
  lab.world.hooks.filter_rules = {k_rules, 1};
  lab.world.hooks.tasks = scheduler.tasks();
  lab.add_ground();
  for (uint32_t i = 0; i < 100; ++i) {
    BodyDef def;
    def.shape = sphere(real(0.25));
    def.position = position(0.45 * (i % 10), 0.3 + 0.1 * (i % 7), 0.45 * (i / 10));
    def.linear_velocity = reals(i % 2 == 0 ? 20.0 : -20.0, 0.0, 0.0);
    def.filter.rule = 1;
    lab.add(def);
  }
  rule_thread = std::this_thread::get_id();
  rules_stayed = true;
  for (int tick = 0; tick < 20; ++tick) step(lab.world);
  EXPECT_TRUE(rules_stayed);
}

DETENT_TEST(tasks, that_make_no_call_leave_the_step_to_the_thread_that_called_it) {
  Tasks none = {[](void*, uint32_t, void (*)(void*), void*) {}, nullptr, nullptr, 4, 1, nullptr};
  expect_equal_heaps(20, {60, 300, 0, true, 40}, false, none, 20);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
