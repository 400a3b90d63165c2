#include <algorithm>
#include <set>
#include <utility>

#include "state/view.h"
#include "tests/unit/world/lab.h"

/// Events for bodies that fall asleep or wake, and for bodies that found no capacity.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Watch {
  Lab lab;
  std::vector<BodyEvent> buffer;
  StepReport report;

  Watch(Capacity capacity, uint32_t room) : lab(capacity, {}, true), buffer(room) {
    lab.world.hooks.body_events = {buffer.data(), room};
  }
  std::vector<BodyEvent> run() {
    report = lab.run(1);
    return {buffer.data(), buffer.data() + report.events.body};
  }
};

DETENT_TEST(body_event, who_falls_asleep_and_who_is_woken_is_told_once_in_the_order_of_slots) {
  Watch watch({4, 16, 0}, 8);
  watch.lab.add_ground();
  const BodyId low = watch.lab.add_box(0.5, 0, 0.5, 0), high = watch.lab.add_box(0.5, 0, 1.5, 0);
  uint32_t slept = 0;
  for (int tick = 0; tick < 200; ++tick) {
    const std::vector<BodyEvent> events = watch.run();
    EXPECT_EQ(events.size(), watch.report.fell_asleep);
    if (events.empty()) continue;
    ASSERT_EQ(events.size(), 2u);
    ++slept;
    EXPECT_EQ(events[0].body, low);
    EXPECT_EQ(events[1].body, high);
    for (const BodyEvent& event : events) EXPECT_EQ(event.type, BodyEventType::fell_asleep);
  }
  EXPECT_EQ(slept, 1u);
  // wake_body() wakes the body and all bodies of its sleeping group.
  EXPECT_OK(wake_body(watch.lab.world, high));
  std::vector<BodyEvent> events = watch.run();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].type, BodyEventType::woke);
  EXPECT_EQ(events[0].body, low);
  EXPECT_TRUE(watch.run().empty());
  watch.lab.run(200);
  // Woken by being hit.
  BodyDef ball;
  ball.shape = sphere(real(0.25));
  ball.position = position(-3, 1.5, 0);
  ball.linear_velocity = reals(300, 0, 0);
  watch.lab.add(ball);
  uint32_t woke = 0;
  for (int tick = 0; tick < 4; ++tick) {
    for (const BodyEvent& event : watch.run()) woke += event.type == BodyEventType::woke ? 1u : 0u;
  }
  EXPECT_EQ(woke, 2u);
}

DETENT_TEST(body_event, who_is_put_to_sleep_by_a_call_raises_none_and_wakes_with_one) {
  Watch watch({3, 16, 0}, 8);
  const BodyId ball = watch.lab.add_box(0.5, 0, 5, 0);
  watch.lab.run(1);
  EXPECT_OK(sleep_body(watch.lab.world, ball));
  EXPECT_TRUE(watch.run().empty());
  EXPECT_OK(wake_body(watch.lab.world, ball));
  EXPECT_OK(sleep_body(watch.lab.world, ball));
  EXPECT_TRUE(watch.run().empty());
  std::vector<uint64_t> bytes = watch.lab.snapshot();
  EXPECT_OK(load(watch.lab.world, bytes_of(bytes), byte_count(bytes)));  // no news of a sleeper
  EXPECT_OK(set_gravity(watch.lab.world, reals(0, -1, 0)));
  const std::vector<BodyEvent> events = watch.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].type, BodyEventType::woke);
}

DETENT_TEST(body_event, a_snapshot_between_call_and_step_tells_the_same) {
  Watch watch({3, 16, 0}, 8), other({3, 16, 0}, 8);
  watch.lab.add_ground();
  const BodyId crate = watch.lab.add_box(0.5, 0, 0.5, 0);
  watch.lab.run(200);
  EXPECT_OK(wake_body(watch.lab.world, crate));
  std::vector<uint64_t> bytes = watch.lab.snapshot();
  EXPECT_OK(load(other.lab.world, bytes_of(bytes), byte_count(bytes)));
  EXPECT_EQ(other.run().size(), 1u);
  EXPECT_EQ(watch.run().size(), 1u);
}

DETENT_TEST(body_event, beyond_the_buffer_are_dropped_and_counted_and_alter_nothing) {
  std::vector<uint64_t> digests;
  for (const uint32_t room : {0u, 2u, 8u}) {
    Watch watch({6, 16, 0}, room);
    watch.lab.add_ground();
    for (int i = 0; i < 5; ++i) watch.lab.add_box(0.5, 3 * i, 0.5, 0);
    uint32_t kept = 0, dropped = 0;
    for (int tick = 0; tick < 200; ++tick) {
      kept += static_cast<uint32_t>(watch.run().size());
      dropped += watch.report.events.body_dropped;
    }
    EXPECT_EQ(kept, room < 5 ? room : 5);
    EXPECT_EQ(dropped, room == 2 ? 3u : 0u);
    digests.push_back(digest(watch.lab.world));
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

DETENT_TEST(capacity_event, names_whose_contact_was_dropped) {
  Lab lab({6, 3, 0});
  CapacityEvent lost[8];
  lab.world.hooks.capacity_events = {lost, 8};
  const BodyId ground = lab.add_ground();
  std::vector<BodyId> crates;
  for (int i = 0; i < 5; ++i) crates.push_back(lab.add_box(0.5, 3 * i, 0.5 - 0.01 * i, 0));  // the first are shallowest
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.lost.contacts, 2u);
  ASSERT_EQ(report.events.capacity, 2u);
  for (uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(lost[i].type, CapacityEventType::contact);
    EXPECT_EQ(lost[i].a, ground);
    EXPECT_EQ(lost[i].b, crates[i]);
  }
  EXPECT_EQ(lab.run(1).events.capacity, 2u);
}

DETENT_TEST(capacity, of_contacts_keeps_the_deepest_of_many_in_order) {
  constexpr uint32_t k_crates = 90;
  for (const uint32_t room : {0u, 1u, 37u, 89u, 90u}) {
    Lab lab({k_crates + 1, room, 0});
    CapacityEvent lost[k_crates];
    lab.world.hooks.capacity_events = {lost, k_crates};
    lab.add_ground();
    std::vector<std::pair<double, uint32_t>> by_depth;
    for (uint32_t i = 0; i < k_crates; ++i) {
      const double depth = 1e-3 * (i * 37 % 45);  // each of two crates, of which the first is kept
      lab.add_box(0.5, 3 * i, 0.5 - depth, 0);
      by_depth.push_back({-depth, i + 1});
    }
    std::sort(by_depth.begin(), by_depth.end());
    std::set<uint32_t> kept;
    for (uint32_t i = 0; i < room; ++i) kept.insert(by_depth[i].second);
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.lost.pairs, room == 0 ? k_crates : k_crates > 2 * room ? k_crates - 2 * room : 0);
    if (room == 0) continue;
    const auto state = view_of(lab.world);
    ASSERT_EQ(state.world.contact_count, room);
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < room; ++i) found.push_back(state.contacts[i].body_b);
    EXPECT_EQ(found, std::vector<uint32_t>(kept.begin(), kept.end())) << room;
  }
}

DETENT_TEST(capacity_event, names_whose_pair_was_dropped_though_its_own_buffer_is_short) {
  Lab lab({8, 1, 0});
  CapacityEvent lost[2];
  lab.world.hooks.capacity_events = {lost, 2};
  const BodyId ground = lab.add_ground();
  std::vector<BodyId> crates;
  for (int i = 0; i < 6; ++i) crates.push_back(lab.add_box(0.5, 3 * i, 0.5 - 0.01 * i, 0));
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.lost.pairs, 4u);
  ASSERT_EQ(report.events.capacity, 2u) << "the first two of five";
  for (uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(lost[i].type, CapacityEventType::pair);
    EXPECT_EQ(lost[i].a, ground);
    EXPECT_EQ(lost[i].b, crates[i]);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
