#include "world/events.h"

#include <math.h>

#include <algorithm>
#include <tuple>

#include "broad_phase/pair_key.h"
#include "tests/unit/math/samples.h"
#include "tests/unit/world/lab.h"

/// Events of contacts that a step begins and ends.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Listener {
  Lab lab;
  std::vector<ContactEvent> buffer;
  StepReport report;

  Listener(Capacity capacity, uint32_t room, WorldDef def = {}, bool sleeping = false)
      : lab(capacity, def, sleeping), buffer(room) {
    lab.world.hooks.contact_events = {buffer.data(), room};
  }
  std::vector<ContactEvent> run() {
    report = lab.run(1);
    return {buffer.data(), buffer.data() + report.events.contact};
  }
};

DETENT_TEST(events, a_ball_that_bounces_begins_hits_and_ends_each_time) {
  Listener listener({2, 4, 0}, 8);
  listener.lab.add_ground();
  BodyDef def;
  def.shape = sphere(real(0.25));
  def.position = position(3, 1.25, -2);
  def.material.restitution = real(0.5);
  const BodyId ball = listener.lab.add(def);
  int begins = 0, ends = 0, hits = 0;
  double last_speed = 100;
  for (int tick = 0; tick < 80; ++tick) {
    const double fall = listener.lab.motion(ball).linear_velocity[1];
    const double gap = fmax(listener.lab.motion(ball).position[1] - 0.25, 0);
    for (const ContactEvent& event : listener.run()) {
      EXPECT_EQ(event.a, (BodyId{1, 1}));
      EXPECT_EQ(event.b, ball);
      if (event.type == ContactEventType::end) {
        ++ends;
        EXPECT_EQ(begins, ends);
        continue;
      }
      EXPECT_NEAR(unit_to_host(event.normal.y), 1, 1e-6);
      EXPECT_NEAR(coord_to_host(event.point.x), 3, 1e-4);
      EXPECT_NEAR(coord_to_host(event.point.z), -2, 1e-4);
      begins += event.type == ContactEventType::begin ? 1 : 0;
      if (event.type != ContactEventType::hit) continue;
      ++hits;
      const double speed = real_to_host(event.approach_speed);
      EXPECT_NEAR(speed, sqrt(fall * fall + 2 * 9.81 * gap), 1e-4);
      EXPECT_LT(speed, last_speed);
      last_speed = speed;
    }
  }
  EXPECT_GE(hits, 2);
  EXPECT_GE(begins, hits) << "slow ones are no hits";
  EXPECT_LE(begins, hits + 2);
}

DETENT_TEST(events, a_resting_stack_touches_on_until_it_falls_asleep) {
  Listener listener({3, 8, 0}, 8, {}, true);
  listener.lab.add_ground();
  const BodyId low = listener.lab.add_box(0.5, 0, 0.5, 0), high = listener.lab.add_box(0.5, 0, 1.5, 0);
  listener.lab.run(10);
  for (int tick = 0; tick < 10; ++tick) {
    const std::vector<ContactEvent> events = listener.run();
    ASSERT_EQ(events.size(), 2u);
    for (const ContactEvent& event : events) EXPECT_EQ(event.type, ContactEventType::touch);
    EXPECT_EQ(events[0].b, low);
    EXPECT_EQ(events[1].a, low);
    EXPECT_EQ(events[1].b, high);
    EXPECT_NEAR(coord_to_host(events[1].point.y), 1, 0.01);
  }
  listener.lab.run(200);
  EXPECT_TRUE(listener.run().empty());
  // A contact of a body that wakes neither ends nor begins.
  ASSERT_OK(wake_body(listener.lab.world, high));
  for (const ContactEvent& event : listener.run()) EXPECT_EQ(event.type, ContactEventType::touch);
  // The contact of a body that is lifted away ends.
  ASSERT_OK(set_pose(listener.lab.world, high, position(0, 5, 0), {0.0, 0.0, 0.0, 1.0}));
  const std::vector<ContactEvent> events = listener.run();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].type, ContactEventType::touch);
  EXPECT_EQ(events[1].type, ContactEventType::end);
  EXPECT_EQ(events[1].a, low);
  EXPECT_EQ(events[1].b, high);
}

DETENT_TEST(events, what_is_met_on_the_way_is_a_hit_in_the_same_step) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Listener listener({2, 4, 0}, 8, world);
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = box(reals(0.01, 4, 4));
  listener.lab.add(def);
  def = {};
  def.shape = sphere(real(0.125));
  def.position = position(-2, 1, 0.5);
  def.linear_velocity = reals(600, 0, 0);
  def.material.restitution = real(1);
  const BodyId ball = listener.lab.add(def);
  const std::vector<ContactEvent> events = listener.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].type, ContactEventType::hit);
  EXPECT_EQ(events[0].b, ball);
  EXPECT_NEAR(unit_to_host(events[0].normal.x), -1, 1e-6);
  EXPECT_NEAR(coord_to_host(events[0].point.x), -0.01, 1e-3);
  EXPECT_NEAR(coord_to_host(events[0].point.y), 1, 1e-3);
  EXPECT_NEAR(real_to_host(events[0].approach_speed), 600, 1e-3);
  EXPECT_NEAR(listener.lab.motion(ball).linear_velocity[0], -600, 0.1);
}

DETENT_TEST(events, beyond_the_buffer_are_dropped_and_counted_and_alter_nothing) {
  std::vector<uint64_t> digests;
  for (const uint32_t room : {0u, 3u, 16u}) {
    Listener listener({9, 16, 0}, room);
    listener.lab.add_ground();
    for (int i = 0; i < 8; ++i) listener.lab.add_box(0.5, 3.0 * i, 0.5, 0);
    listener.lab.run(5);
    const std::vector<ContactEvent> events = listener.run();
    EXPECT_EQ(events.size(), room < 8 ? room : 8);
    EXPECT_EQ(listener.report.events.contact_dropped, room == 3 ? 5u : 0u);
    for (uint32_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].b.slot, 2 + i) << "the lowest slots are kept";
    digests.push_back(digest(listener.lab.world));
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

DETENT_TEST(events, hits_are_sorted_by_their_bodies_among_the_other_events_and_the_last_are_dropped) {
  Samples samples = {91};
  std::vector<BodyProperties> properties(5);
  for (uint32_t i = 0; i < 5; ++i) properties[i].generation = i + 7;
  for (const uint32_t room : {0u, 1u, 5u, 12u, 40u}) {
    // The buffer starts with sorted events of contacts; the hits are added one by one.
    std::vector<ContactEvent> events(room), expected;
    for (uint32_t slot = 1; slot < 4; ++slot) {
      ContactEvent begin;
      begin.type = ContactEventType::begin;
      begin.a = {slot, slot + 6};
      begin.b = {slot + 1, slot + 7};
      expected.push_back(begin);
    }
    EventCount count;
    for (; count.kept < room && count.kept < expected.size(); ++count.kept) events[count.kept] = expected[count.kept];
    expected.resize(count.kept);
    std::vector<ImpactHit> hits;
    for (int i = 0; i < 24; ++i) {
      const uint32_t a = samples.below(4), b = a + 1 + samples.below(4 - a);
      ImpactHit hit{};
      hit.key = pair_key(a, b);
      hit.point.x = coord(i);
      hit.approach = real(i + 1);
      hits.push_back(hit);
      ContactEvent event;
      event.type = ContactEventType::hit;
      event.a = {a + 1, a + 7};
      event.b = {b + 1, b + 7};
      event.point.x = hit.point.x;
      event.approach_speed = hit.approach;
      expected.push_back(event);
    }
    add_hits({properties.data(), 5}, {hits.data(), 24}, {events.data(), room}, count);
    std::stable_sort(expected.begin(), expected.end(), [](const ContactEvent& a, const ContactEvent& b) {
      return std::make_tuple(a.a.slot, a.b.slot, a.type) < std::make_tuple(b.a.slot, b.b.slot, b.type);
    });
    const uint32_t all = static_cast<uint32_t>(expected.size());
    ASSERT_EQ(count.kept, all < room ? all : room);
    EXPECT_EQ(count.dropped, all - count.kept);
    for (uint32_t i = 0; i < count.kept; ++i) {
      EXPECT_TRUE(events[i].type == expected[i].type && events[i].a == expected[i].a && events[i].b == expected[i].b &&
                  events[i].point.x == expected[i].point.x && events[i].approach_speed == expected[i].approach_speed)
          << room << " " << i;
    }
  }
}

/// One step that raises an event of each kind, with the buffers given.
struct Eventful {
  Lab lab = Lab({.bodies = 6, .contacts = 1, .joints = 1, .sensed = 1});
  StepReport report;

  explicit Eventful(const WorldHooks& hooks) {
    lab.world.hooks = hooks;
    const BodyId ground = lab.add_ground();
    BodyId box;
    for (int i = 0; i < 3; ++i) box = lab.add_box(0.5, 3.0 * i, 0.5, 0);
    BodyDef zone;
    zone.type = BodyType::fixed;
    zone.shape = sphere(real(1));
    zone.sensor = true;
    lab.add(zone);
    BodyDef load;
    load.shape = sphere(real(0.25));
    load.position = position(0, 5, 0);
    JointDef joint;
    joint.type = JointType::ball;
    joint.a = ground;
    joint.b = lab.add(load);
    joint.break_force = scaled(0.01);
    const Quat rotation = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)};
    EXPECT_OK(place_joint(lab.world, load.position, rotation, joint));
    JointId id;
    EXPECT_OK(create_joint(lab.world, joint, id));
    EXPECT_OK(sleep_body(lab.world, box));
    EXPECT_OK(wake_body(lab.world, box));
    report = lab.run(1);
  }
};

DETENT_TEST(events, a_buffer_without_memory_is_none_whatever_its_capacity) {
  ContactEvent contacts[1];
  JointEvent joints[1];
  SensorEvent sensors[1];
  BodyEvent bodies[4];
  CapacityEvent lost[4];
  const Eventful heard({.contact_events = {contacts, 1},
                        .joint_events = {joints, 1},
                        .sensor_events = {sensors, 1},
                        .body_events = {bodies, 4},
                        .capacity_events = {lost, 4}});
  EXPECT_EQ(heard.report.events.contact, 1u);
  EXPECT_EQ(heard.report.events.joint, 1u);
  EXPECT_EQ(heard.report.events.sensor, 1u);
  EXPECT_NE(heard.report.events.body, 0u);
  EXPECT_NE(heard.report.events.capacity, 0u);
  const Eventful deaf({.contact_events = {nullptr, 4},
                       .joint_events = {nullptr, 4},
                       .sensor_events = {nullptr, 4},
                       .body_events = {nullptr, 4},
                       .capacity_events = {nullptr, 4}});
  EXPECT_EQ(deaf.report.events.contact + deaf.report.events.contact_dropped, 0u);
  EXPECT_EQ(deaf.report.events.joint + deaf.report.events.joint_dropped, 0u);
  EXPECT_EQ(deaf.report.events.sensor + deaf.report.events.sensor_dropped, 0u);
  EXPECT_EQ(deaf.report.events.body + deaf.report.events.body_dropped, 0u);
  EXPECT_EQ(deaf.report.events.capacity, 0u);
  EXPECT_EQ(deaf.report.joints.broken, 1u);
  EXPECT_EQ(digest(deaf.lab.world), digest(heard.lab.world));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
