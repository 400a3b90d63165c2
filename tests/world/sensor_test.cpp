#include <detent/body_access.h>
#include <detent/distance.h>
#include <detent/query.h>
#include <detent/recording.h>
#include <detent/sensor.h>

#include <math.h>
#include <stdlib.h>

#include <random>

#include "collision/body_convex.h"
#include "geometry/sweep.h"
#include "tests/world/lab.h"
#include "world/step_probe.h"
#include "world/view.h"

/// Who is within a sensor, and who was on the way.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr SensorEventType k_enter = SensorEventType::enter, k_leave = SensorEventType::leave;

WorldDef weightless() {
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  return def;
}

BodyDef sensor_def(const Shape& shape, double x = 0, double y = 0, double z = 0, BodyType type = BodyType::fixed) {
  BodyDef def;
  def.type = type;
  def.shape = shape;
  def.position = position(x, y, z);
  def.sensor = true;
  return def;
}

BodyDef ball_def(double radius, double x, double y, double z, const Vec3<Real>& velocity = {}) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.position = position(x, y, z);
  def.velocity = velocity;
  return def;
}

struct Trap {
  Lab lab;
  std::vector<SensorEvent> buffer;
  StepReport report;

  explicit Trap(Capacity capacity, WorldDef def = weightless(), bool sleeping = false, uint32_t room = 32)
      : lab(capacity, def, sleeping), buffer(room) {
    lab.world.sensor_events = {buffer.data(), room};
  }
  std::vector<SensorEvent> run() {
    report = lab.run(1);
    return {buffer.data(), buffer.data() + report.sensor_events};
  }
  std::vector<BodyId> within(BodyId sensor) {
    BodyId bodies[16];
    uint32_t count = 0;
    EXPECT_OK(get_sensed(lab.world, sensor, bodies, 16, count));
    return {bodies, bodies + (count < 16 ? count : 16)};
  }
};

bool is_event(const SensorEvent& event, SensorEventType type, BodyId sensor, BodyId body) {
  return event.type == type && event.sensor == sensor && event.body == body;
}

Capacity room_for(uint32_t bodies, uint32_t sensed = 16) { return {bodies, 4 * bodies, 0, true, 0, sensed}; }

DETENT_TEST(sensor, a_slow_body_enters_once_and_leaves_once) {
  Trap trap(room_for(2));
  const BodyId gate = trap.lab.add(sensor_def(box(reals(0.5, 1, 1))));
  const BodyId ball = trap.lab.add(ball_def(0.25, -2, 0.3, 0.2, reals(3, 0, 0)));
  int enters = 0, leaves = 0;
  for (int tick = 0; tick < 100; ++tick) {
    const double before = trap.lab.motion(ball).position[0];
    for (const SensorEvent& event : trap.run()) {
      const bool enter = event.type == k_enter;
      EXPECT_TRUE(is_event(event, enter ? k_enter : k_leave, gate, ball));
      const double now = trap.lab.motion(ball).position[0], edge = enter ? -0.75 : 0.75;
      EXPECT_LE(before, edge + 1e-4);
      EXPECT_GE(now, edge - 1e-4);
      enters += enter ? 1 : 0;
      leaves += enter ? 0 : 1;
    }
    EXPECT_EQ(trap.within(gate).size(), static_cast<size_t>(enters - leaves));
    EXPECT_EQ(get_info(trap.lab.world).sensed, static_cast<uint32_t>(enters - leaves));
  }
  EXPECT_EQ(enters, 1);
  EXPECT_EQ(leaves, 1);
  EXPECT_NEAR(trap.lab.motion(ball).position[0], 3, 1e-3) << "nothing slowed it";
}

DETENT_TEST(sensor, a_bullet_through_a_thin_one_enters_and_leaves_in_the_same_step) {
  for (const bool continuous : {true, false}) {
    WorldDef def = weightless();
    def.continuous = continuous;
    Trap trap(room_for(2), def);
    const BodyId gate = trap.lab.add(sensor_def(box(reals(0.005, 1, 1))));
    const BodyId bullet = trap.lab.add(ball_def(0.0625, -3, 0.1, 0.2, reals(500, 0, 0)));
    const std::vector<SensorEvent> events = trap.run();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_TRUE(is_event(events[0], k_enter, gate, bullet));
    EXPECT_TRUE(is_event(events[1], k_leave, gate, bullet));
    EXPECT_TRUE(trap.within(gate).empty());
    EXPECT_EQ(trap.report.impacts, 0u);
    EXPECT_EQ(trap.report.sensed_undecided, 0u);
    EXPECT_NEAR(trap.lab.motion(bullet).velocity[0], 500, 1e-3);
    EXPECT_TRUE(trap.run().empty());
  }
}

DETENT_TEST(sensor, a_bullet_stopped_by_a_wall_enters_what_is_before_it_and_not_what_is_behind) {
  Trap trap(room_for(5));
  const BodyId before = trap.lab.add(sensor_def(box(reals(0.005, 1, 1)), -1));
  const BodyId within = trap.lab.add(sensor_def(box(reals(0.25, 1, 1))));
  const BodyId behind = trap.lab.add(sensor_def(box(reals(0.25, 1, 1)), 1));
  BodyDef wall;
  wall.type = BodyType::fixed;
  wall.shape = box(reals(0.1, 1, 1));
  trap.lab.add(wall);
  BodyDef def = ball_def(0.0625, -3, 0.1, 0.2, reals(500, 0, 0));
  def.material.restitution = real(0);
  const BodyId bullet = trap.lab.add(def);
  const std::vector<SensorEvent> events = trap.run();
  EXPECT_EQ(trap.report.impacts, 1u);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_TRUE(is_event(events[0], k_enter, before, bullet));
  EXPECT_TRUE(is_event(events[1], k_leave, before, bullet));
  EXPECT_TRUE(is_event(events[2], k_enter, within, bullet));
  for (int tick = 0; tick < 20; ++tick) EXPECT_TRUE(trap.run().empty());
  EXPECT_EQ(trap.within(within).size(), 1u);
  EXPECT_TRUE(trap.within(behind).empty());
}

DETENT_TEST(sensor, one_that_is_reached_only_by_rebound_is_entered_in_the_same_step) {
  Trap trap(room_for(3));
  const BodyId gate = trap.lab.add(sensor_def(box(reals(1, 0.005, 1)), 0, 2));
  BodyDef wall;
  wall.type = BodyType::fixed;
  wall.shape = box(reals(1, 0.1, 1));
  wall.rotation = {0.0, 0.0, unit(0.38268343236), unit(0.92387953251)};  // deals out upwards what comes along x
  wall.material.friction = real(0);
  trap.lab.add(wall);
  BodyDef def = ball_def(0.0625, -2, 0, 0, reals(400, 0, 0));
  def.material = wall.material;
  def.material.restitution = real(1);
  const BodyId bullet = trap.lab.add(def);
  const std::vector<SensorEvent> events = trap.run();
  EXPECT_EQ(trap.report.impacts, 1u);
  ASSERT_EQ(events.size(), 2u) << "first along x, then along y";
  EXPECT_TRUE(is_event(events[0], k_enter, gate, bullet));
  EXPECT_GT(trap.lab.motion(bullet).position[1], 3.2);
}

DETENT_TEST(sensor, one_that_is_passed_on_the_way_to_a_rebound_is_not_missed) {
  Trap trap(room_for(3));
  const BodyId gate = trap.lab.add(sensor_def(box(reals(0.005, 1, 1)), 0, 0));
  BodyDef wall;
  wall.type = BodyType::fixed;
  wall.shape = box(reals(0.1, 1, 1));
  wall.position = position(1, 0, 0);
  trap.lab.add(wall);
  BodyDef def = ball_def(0.0625, -2, 0.1, 0, reals(400, 0, 0));
  def.material.restitution = real(1);
  const BodyId bullet = trap.lab.add(def);
  std::vector<SensorEvent> events = trap.run();
  EXPECT_EQ(trap.report.impacts, 1u);
  ASSERT_EQ(events.size(), 2u) << "there and back is one visit";
  EXPECT_TRUE(is_event(events[0], k_enter, gate, bullet));
  EXPECT_TRUE(is_event(events[1], k_leave, gate, bullet));
  EXPECT_LT(trap.lab.motion(bullet).position[0], -0.5);
}

DETENT_TEST(sensor, what_rests_within_stays_within_also_asleep_and_is_not_kept_awake) {
  Trap trap(room_for(4), {}, true);
  trap.lab.add_ground();
  const BodyId gate = trap.lab.add(sensor_def(box(reals(1, 1, 1))));
  const BodyId crate = trap.lab.add_box(0.25, 0, 0.25, 0);
  std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, gate, crate));
  for (int tick = 0; tick < 120; ++tick) EXPECT_TRUE(trap.run().empty());
  bool awake = true;
  EXPECT_OK(is_awake(trap.lab.world, crate, awake));
  EXPECT_FALSE(awake);
  EXPECT_EQ(trap.within(gate).size(), 1u);
  // One that comes to a sleeper senses it and lets it sleep.
  const BodyId other = trap.lab.add(sensor_def(sphere(real(0.5)), 0.4, 0.3, 0.1));
  events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, other, crate));
  EXPECT_OK(is_awake(trap.lab.world, crate, awake));
  EXPECT_FALSE(awake);
  // And so does one that sweeps over it, though what is solid would wake it.
  EXPECT_OK(set_type(trap.lab.world, gate, BodyType::kinematic));
  EXPECT_OK(set_velocity(trap.lab.world, gate, reals(6, 0, 0), {}));
  uint32_t leaves = 0;
  for (int tick = 0; tick < 30; ++tick) {
    for (const SensorEvent& event : trap.run()) leaves += is_event(event, k_leave, gate, crate) ? 1u : 0u;
  }
  EXPECT_EQ(leaves, 1u);
  EXPECT_OK(is_awake(trap.lab.world, crate, awake));
  EXPECT_FALSE(awake);
}

DETENT_TEST(sensor, what_is_put_elsewhere_leaves_and_enters_without_a_way) {
  Trap trap(room_for(3));
  const BodyId gate = trap.lab.add(sensor_def(box(reals(0.5, 0.5, 0.5))));
  const BodyId between = trap.lab.add(sensor_def(box(reals(0.5, 0.5, 0.5)), 3));
  const BodyId ball = trap.lab.add(ball_def(0.25, 0, 0, 0));
  trap.run();
  EXPECT_OK(set_pose(trap.lab.world, ball, position(6, 0, 0), {0.0, 0.0, 0.0, 1.0}));
  std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_leave, gate, ball));
  // So it is with the sensor.
  EXPECT_OK(set_pose(trap.lab.world, between, position(6, 0, 0), {0.0, 0.0, 0.0, 1.0}));
  events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, between, ball));
}

DETENT_TEST(sensor, who_is_destroyed_or_no_longer_sensed_is_forgotten) {
  Trap trap(room_for(4));
  const BodyId gate = trap.lab.add(sensor_def(box(reals(0.5, 0.5, 0.5))));
  const BodyId other = trap.lab.add(sensor_def(box(reals(0.5, 0.5, 0.5)), 0.1));
  const BodyId ball = trap.lab.add(ball_def(0.25, 0, 0, 0));
  EXPECT_EQ(trap.run().size(), 2u);
  EXPECT_OK(destroy_body(trap.lab.world, ball));
  EXPECT_TRUE(trap.within(gate).empty());
  EXPECT_TRUE(trap.run().empty());
  const BodyId second = trap.lab.add(ball_def(0.25, 0, 0, 0));
  EXPECT_EQ(second.slot, ball.slot);
  EXPECT_EQ(trap.run().size(), 2u);
  EXPECT_OK(destroy_body(trap.lab.world, other));
  EXPECT_TRUE(trap.run().empty());
  EXPECT_EQ(get_info(trap.lab.world).sensed, 1u);
  EXPECT_OK(set_sensor(trap.lab.world, gate, false));
  EXPECT_EQ(get_info(trap.lab.world).sensed, 0u);
  EXPECT_TRUE(trap.run().empty());
  EXPECT_EQ(trap.report.contacts, 1u) << "it is solid now";
  EXPECT_OK(set_sensor(trap.lab.world, second, true));
  bool sensor = false;
  EXPECT_OK(get_sensor(trap.lab.world, second, sensor));
  EXPECT_TRUE(sensor);
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u) << "a dynamic sensor senses what is fixed";
  EXPECT_TRUE(is_event(events[0], k_enter, second, gate));
  EXPECT_EQ(trap.report.contacts, 0u);
}

DETENT_TEST(sensor, types_and_filters_say_who_senses_whom) {
  Trap trap(room_for(8));
  const Shape shape = sphere(real(0.5));
  const auto add = [&](BodyType type, bool sensor) {
    BodyDef def = sensor_def(shape, 0, 0, 0, type);
    def.sensor = sensor;
    def.filter.mask = sensor ? ~0u : 0x80000000u;  // the others do not push each other
    def.filter.category = sensor ? 0x80000000u : 1u;
    return trap.lab.add(def);
  };
  const BodyId fixed_sensor = add(BodyType::fixed, true), kinematic_sensor = add(BodyType::kinematic, true);
  const BodyId dynamic_sensor = add(BodyType::dynamic, true);
  const BodyId fixed = add(BodyType::fixed, false), kinematic = add(BodyType::kinematic, false);
  const BodyId dynamic = add(BodyType::dynamic, false);
  trap.run();
  EXPECT_EQ(trap.within(fixed_sensor), (std::vector<BodyId>{kinematic, dynamic}));
  EXPECT_EQ(trap.within(kinematic_sensor), (std::vector<BodyId>{kinematic, dynamic}));
  EXPECT_EQ(trap.within(dynamic_sensor), (std::vector<BodyId>{fixed, kinematic, dynamic}));
  Filter filter;
  filter.category = 0x80000000u;
  filter.mask = 0;
  EXPECT_OK(set_filter(trap.lab.world, dynamic_sensor, filter));
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 3u);
  for (const SensorEvent& event : events) EXPECT_EQ(event.type, k_leave);
  EXPECT_TRUE(trap.within(dynamic_sensor).empty());
}

bool same_data(const FilterBody& own, const FilterBody& other) { return own.user_data == other.user_data; }

DETENT_TEST(sensor, a_rule_sees_new_user_data_though_all_are_asleep) {
  const FilterRule rules[] = {same_data};
  Trap trap(room_for(3), {}, true);
  trap.lab.world.filter_rules = {rules, 1};
  trap.lab.add_ground();
  BodyDef def = sensor_def(box(reals(1, 1, 1)));
  def.filter.rule = 1;
  const BodyId gate = trap.lab.add(def);
  const BodyId crate = trap.lab.add_box(0.25, 0, 0.25, 0);
  trap.lab.run(200);
  EXPECT_EQ(trap.within(gate).size(), 1u);
  EXPECT_OK(set_user_data(trap.lab.world, crate, 7));
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_leave, gate, crate));
  bool awake = true;
  EXPECT_OK(is_awake(trap.lab.world, crate, awake));
  EXPECT_FALSE(awake);
}

DETENT_TEST(sensor, one_that_moves_or_turns_finds_what_rests) {
  Trap trap(room_for(3));
  BodyDef arm = sensor_def(box(reals(2, 0.01, 0.01)), 0, 0, 0, BodyType::kinematic);
  arm.spin = reals(0, 90, 0);  // a quarter of a turn a tick
  const BodyId blade = trap.lab.add(arm);
  BodyDef thin = sensor_def(box(reals(0.005, 1, 1)), -3, 5, 0, BodyType::kinematic);
  thin.velocity = reals(500, 0, 0);
  const BodyId wave = trap.lab.add(thin);
  BodyDef post = ball_def(0.0625, 1, 0, -1);
  post.type = BodyType::kinematic;
  const BodyId low = trap.lab.add(post);
  std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_TRUE(is_event(events[0], k_enter, blade, low));
  EXPECT_TRUE(is_event(events[1], k_leave, blade, low));
  EXPECT_OK(set_pose(trap.lab.world, wave, position(-3, 0, -1), {0.0, 0.0, 0.0, 1.0}));
  events = trap.run();
  uint32_t waves = 0;
  for (const SensorEvent& event : events) waves += event.sensor == wave ? 1u : 0u;
  EXPECT_EQ(waves, 2u);
}

DETENT_TEST(sensor, a_half_space_senses_whom_it_holds_however_far_away) {
  Trap trap(room_for(3));
  BodyDef def = sensor_def(half_space(), 0, -2, 0);
  const BodyId pit = trap.lab.add(def);
  const double far = sizeof(Coord) == 4 ? 30000 : 300000;
  const BodyId high = trap.lab.add(ball_def(0.25, far, 0, far));
  const BodyId low = trap.lab.add(ball_def(0.25, far, -1.5, -far, reals(0, -60, 0)));
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, pit, low));
  EXPECT_FALSE(trap.within(pit)[0] == high);
  EXPECT_EQ(trap.report.sensed_undecided, 0u);
}

DETENT_TEST(sensor, queries_do_not_meet_it) {
  Trap trap(room_for(2));
  trap.lab.add(sensor_def(box(reals(0.5, 0.5, 0.5))));
  const BodyId ball = trap.lab.add(ball_def(0.25, 3, 0, 0));
  QueryHit hit;
  QueryReport report;
  EXPECT_OK(query_ray(trap.lab.world, {position(-3, 0, 0), reals(9, 0, 0)}, {&hit, 1}, report));
  EXPECT_EQ(report.hits, 1u);
  EXPECT_EQ(hit.body, ball);
}

DETENT_TEST(sensor, what_there_is_no_room_for_is_named_counted_and_found_once_there_is_room) {
  Trap trap(room_for(8, 3));
  CapacityEvent lost[8];
  trap.lab.world.capacity_events = {lost, 8};
  const BodyId gate = trap.lab.add(sensor_def(box(reals(10, 1, 1))));
  std::vector<BodyId> balls;
  for (int i = 0; i < 5; ++i) {
    BodyDef def = ball_def(0.25, i, 0, 0);
    def.type = BodyType::kinematic;  // none of them moves: they are asked about because some were lost
    balls.push_back(trap.lab.add(def));
  }
  EXPECT_EQ(trap.run().size(), 3u);
  EXPECT_EQ(trap.report.sensed_dropped, 2u);
  EXPECT_FALSE(trap.report.complete());
  ASSERT_EQ(trap.report.capacity_events, 2u);
  EXPECT_EQ(lost[0].type, CapacityEventType::sensed);
  EXPECT_EQ(lost[0].a, gate);
  EXPECT_EQ(lost[0].b, balls[3]);
  EXPECT_EQ(lost[1].b, balls[4]);
  EXPECT_TRUE(trap.run().empty());
  EXPECT_EQ(trap.report.sensed_dropped, 0u) << "nothing moves, so the step has nothing to do";
  EXPECT_OK(destroy_body(trap.lab.world, balls[0]));
  EXPECT_EQ(get_info(trap.lab.world).sensed, 2u);
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, gate, balls[3]));
  EXPECT_EQ(trap.report.sensed_dropped, 1u);
}

DETENT_TEST(sensor, events_beyond_the_buffer_are_dropped_and_counted_and_alter_nothing) {
  std::vector<uint64_t> digests;
  for (const uint32_t room : {0u, 2u, 8u}) {
    Trap trap(room_for(6), weightless(), false, room);
    trap.lab.add(sensor_def(box(reals(10, 1, 1))));
    for (int i = 0; i < 5; ++i) trap.lab.add(ball_def(0.25, i, 0, 0));
    const std::vector<SensorEvent> events = trap.run();
    EXPECT_EQ(events.size(), room < 5 ? room : 5);
    EXPECT_EQ(trap.report.sensor_events_dropped, room == 2 ? 3u : 0u);
    digests.push_back(digest(trap.lab.world));
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

DETENT_TEST(sensor, a_world_without_room_or_code_for_them_refuses_them) {
  Lab small({2, 4, 0});
  BodyId id;
  EXPECT_EQ(create_body(small.world, sensor_def(sphere(real(1))), id), Status::pool_full);
  id = small.add(ball_def(0.25, 0, 0, 0));
  EXPECT_EQ(set_sensor(small.world, id, true), Status::pool_full);
  EXPECT_OK(set_sensor(small.world, id, false));

  WorldDef def;
  def.capacity = room_for(2);
  std::vector<uint64_t> block(world_bytes(def.capacity) / 8);
  World lean;
  ASSERT_OK(create_world(bytes_of(block), byte_count(block), def, {}, lean,
                         feature_table<without(Features::all, Features::sensors)>));
  EXPECT_EQ(create_body(lean, sensor_def(sphere(real(1))), id), Status::feature_missing);
  EXPECT_OK(create_body(lean, ball_def(0.25, 0, 0, 0), id));
  EXPECT_EQ(set_sensor(lean, id, true), Status::feature_missing);
  uint32_t count = 7;
  EXPECT_EQ(get_sensed(lean, id, nullptr, 0, count), Status::bad_argument);
  EXPECT_EQ(get_sensed(lean, {}, nullptr, 0, count), Status::bad_id);
  EXPECT_EQ(count, 7u);
}

/// Gates over a ground, and bodies of all kinds that fall and fly through them.
struct Fair {
  Lab lab;
  std::vector<BodyId> solids;

  Fair(bool with_sensors, uint32_t seed) : lab({40, 160, 0, true, 0, 64}, {}, true) {
    std::mt19937 random(seed);
    const auto draw = [&](double low, double high) { return low + (high - low) * (static_cast<double>(random()) * 0x1p-32); };
    solids.push_back(lab.add_ground());
    for (int i = 0; i < 24; ++i) {
      const double size = draw(0.1, 0.3), x = draw(-3, 3), y = draw(0.5, 5), z = draw(-3, 3);
      BodyDef def = ball_def(size, x, y, z);
      if (i % 3 == 1) def.shape = box(reals(size, size / 2, size));
      if (i % 3 == 2) def.shape = capsule(real(size / 2), real(size));
      const double vx = draw(-40, 40), vy = draw(-20, 20), vz = draw(-40, 40), spin = draw(-20, 20);
      def.velocity = i % 4 == 0 ? reals(10 * vx, vy, 10 * vz) : reals(vx / 20, vy / 20, vz / 20);
      def.spin = reals(spin, spin / 2, -spin);
      def.material.restitution = real(0.5);
      def.linear_damping = real(0.25);
      solids.push_back(lab.add(def));
    }
    if (!with_sensors) return;
    for (int i = 0; i < 6; ++i) {
      const double x = draw(-3, 3), y = draw(0, 2), z = draw(-3, 3), thin = draw(0.005, 0.5), wide = draw(1, 3);
      const BodyType types[] = {BodyType::fixed, BodyType::kinematic, BodyType::dynamic};
      BodyDef def = sensor_def(box(reals(thin, wide, 2)), x, y, z, types[i % 3]);
      if (i % 3 == 1) def.spin = reals(0, 3, 1);
      if (i % 3 == 1) def.velocity = reals(-x, 0.25, -z);
      if (i == 2) def.gravity_scale = real(0);
      lab.add(def);
    }
  }
};

DETENT_TEST(sensor, no_other_body_is_moved_by_one_by_a_bit) {
  Fair with(true, 7), without_sensors(false, 7);
  for (int tick = 0; tick < 240; ++tick) {
    with.lab.run(1);
    without_sensors.lab.run(1);
    for (const BodyId id : with.solids) {
      Pose a, b;
      Vec3<Real> velocity_a, velocity_b, spin_a, spin_b;
      ASSERT_OK(get_pose(with.lab.world, id, a));
      ASSERT_OK(get_pose(without_sensors.lab.world, id, b));
      ASSERT_OK(get_velocity(with.lab.world, id, velocity_a, spin_a));
      ASSERT_OK(get_velocity(without_sensors.lab.world, id, velocity_b, spin_b));
      ASSERT_TRUE(a.position == b.position && a.rotation == b.rotation && velocity_a == velocity_b && spin_a == spin_b)
          << "tick " << tick << " slot " << id.slot;
      bool awake_a = false, awake_b = false;
      ASSERT_OK(is_awake(with.lab.world, id, awake_a));
      ASSERT_OK(is_awake(without_sensors.lab.world, id, awake_b));
      ASSERT_EQ(awake_a, awake_b);
    }
  }
}

DETENT_TEST(sensor, a_world_put_back_in_mid_overlap_goes_on_with_the_same_events) {
  Fair fair(true, 11);
  std::vector<SensorEvent> events(64), again_events(64);
  fair.lab.world.sensor_events = {events.data(), 64};
  Lab other(get_info(fair.lab.world).capacity, {}, true);
  other.world.sensor_events = {again_events.data(), 64};
  uint32_t told = 0;
  for (int tick = 0; tick < 300; ++tick) {
    std::vector<uint64_t> bytes = fair.lab.snapshot();
    ASSERT_OK(tick % 2 == 0 ? load(other.world, bytes_of(bytes), byte_count(bytes))
                            : restore(other.world, bytes_of(bytes), byte_count(bytes)));
    const StepReport report = fair.lab.run(1), again = other.run(1);
    ASSERT_EQ(digest(fair.lab.world), digest(other.world)) << "tick " << tick;
    ASSERT_EQ(report.sensor_events, again.sensor_events);
    told += report.sensor_events;
    for (uint32_t i = 0; i < report.sensor_events; ++i)
      EXPECT_TRUE(is_event(events[i], again_events[i].type, again_events[i].sensor, again_events[i].body));
  }
  EXPECT_GT(told, 40u);
}

DETENT_TEST(sensor, no_bit_of_who_is_within_can_be_flipped_into_a_crash) {
  Fair fair(true, 11);
  fair.lab.run(40);
  ASSERT_GE(get_info(fair.lab.world).sensed, 3u);
  const std::vector<uint64_t> good = fair.lab.snapshot();
  Lab other(get_info(fair.lab.world).capacity, {}, true);
  bool fits = false;
  const Layout layout = layout_of(get_info(fair.lab.world).capacity, fits);
  uint32_t refused = 0, bits = 8 * sizeof(SensedState) * 6;
  for (uint32_t bit = 0; bit < bits; ++bit) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[layout.sensed + bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    const Status status = load(other.world, bytes_of(bytes), byte_count(bytes));
    refused += status == Status::ok ? 0u : 1u;
    if (status == Status::ok) other.run(2);
  }
  EXPECT_GT(refused, bits / 2);
}

/// Takes a recording in memory.
struct Tape {
  std::vector<uint8_t> bytes;
  size_t at = 0;
  static Status write(void* tape, const uint8_t* from, uint32_t count) {
    static_cast<Tape*>(tape)->bytes.insert(static_cast<Tape*>(tape)->bytes.end(), from, from + count);
    return Status::ok;
  }
  static Status read(void* context, uint8_t* to, uint32_t count, uint32_t& got) {
    Tape& tape = *static_cast<Tape*>(context);
    for (got = 0; got < count && tape.at < tape.bytes.size(); ++got) to[got] = tape.bytes[tape.at++];
    return Status::ok;
  }
};

DETENT_TEST(sensor, a_replay_makes_and_unmakes_the_same_sensors) {
  Tape tape;
  uint8_t buffer[k_recording_buffer_bytes];
  Lab lab(room_for(4));
  Recorder recorder(lab.world, {Tape::write, &tape}, buffer, sizeof buffer);
  ASSERT_OK(recorder.begin());
  BodyId gate, ball;
  ASSERT_OK(recorder.create_body(sensor_def(box(reals(1, 1, 1))), gate));
  ASSERT_OK(recorder.create_body(ball_def(0.25, 0, 0.5, 0), ball));
  for (int tick = 0; tick < 5; ++tick) recorder.step();
  EXPECT_EQ(get_info(lab.world).sensed, 1u);
  ASSERT_OK(recorder.set_sensor(gate, false));
  ASSERT_OK(recorder.set_sensor(ball, true));
  for (int tick = 0; tick < 5; ++tick) recorder.step();
  ASSERT_OK(recorder.end());
  Player player({Tape::read, &tape}, buffer, sizeof buffer);
  ASSERT_OK(player.open());
  EXPECT_EQ(player.info().capacity.sensed, 16u);
  Lab other(player.info().capacity);
  ASSERT_OK(player.start(other.world));
  TickResult result;
  while (!result.finished) ASSERT_OK(player.next_tick(other.world, result));
  EXPECT_EQ(digest(other.world), digest(lab.world));
}

/// How deep two bodies overlap at least when their rounded poses do, for certain.
bool overlap_by(const BodyTraits& a, const BodyPose& pose_a, const BodyTraits& b, const BodyPose& pose_b, double depth) {
  Convex convex_a, convex_b;
  EXPECT_TRUE(body_convex(a, {}, convex_a) && body_convex(b, {}, convex_b));
  // The balls made smaller: only shapes that have one are asked like that.
  convex_a.radius -= static_cast<int32_t>(ldexp(depth, 30 - convex_a.radius_exponent));
  if (convex_a.radius < 0) return false;
  bool farther = true;
  EXPECT_OK(farther_than(convex_a, {pose_a.position, pose_a.rotation}, convex_b, {pose_b.position, pose_b.rotation},
                         Real(0.0), farther));
  return !farther;
}

DETENT_TEST(sensor, no_throw_whose_way_overlaps_goes_unnoticed) {
  std::mt19937 random(5);
  const auto draw = [&](double low, double high) { return low + (high - low) * (static_cast<double>(random()) * 0x1p-32); };
  const int rounds = getenv("DETENT_EMULATED") == nullptr ? 240 : 60;
  int passes = 0, grazes = 0;
  for (int round = 0; round < rounds; ++round) {
    Trap trap(room_for(4));
    BodyDef gate = sensor_def(rounded(box(reals(0.02, 0.4, 0.4)), real(0.01)), 0, 0, 0,
                              round % 2 == 0 ? BodyType::fixed : BodyType::kinematic);
    if (round % 2 != 0) {
      const double spin = draw(-60, 60), vy = draw(-30, 30);
      gate.spin = reals(spin, spin / 3, -spin / 2);
      gate.velocity = reals(0, vy, 0);
    }
    const BodyId sensor = trap.lab.add(gate);
    // A plate that deals the bodies back, so that the way has a bend.
    BodyDef wall;
    wall.type = BodyType::fixed;
    wall.shape = box(reals(0.05, 3, 3));
    wall.position = position(1.2, 0, 0);
    trap.lab.add(wall);
    const double y = draw(-0.8, 0.8), z = draw(-0.8, 0.8), vx = draw(20, 300), vy = draw(-40, 40), vz = draw(-40, 40);
    const double turn = draw(-80, 80);
    BodyDef def = ball_def(0.05, -1, y, z, reals(vx, vy, vz));
    if (round % 3 != 0) def.shape = capsule(real(0.03), real(0.2));
    def.spin = reals(turn, -turn / 2, turn / 3);
    def.material.restitution = real(1);
    const BodyId body = trap.lab.add(def);
    SweepSegment segments[64];
    for (int tick = 0; tick < 3; ++tick) {
      ImpactProbe probe;
      probe.segments = {segments, 64};
      const bool was = !trap.within(sensor).empty();
      const StepReport report = step_probed(trap.lab.world, probe);
      const StateView<const uint8_t> state = view_of(static_cast<const World&>(trap.lab.world));
      const uint32_t slots[2] = {sensor.slot - 1, body.slot - 1};
      const auto pose_then = [&](uint32_t slot, Fraction time) {
        const SweepSegment* last = nullptr;
        for (uint32_t i = 0; i < probe.segment_count; ++i) {
          if (segments[i].body == slot && segments[i].from <= time) last = &segments[i];
        }
        if (last == nullptr) return state.poses[slot];
        BodySweep rest{};
        const double whole = fraction_to_host(k_whole_step - last->from);
        // The segment is what is left of the tick: its part until `time`.
        const double part = whole == 0 ? 0 : fraction_to_host(time - last->from) / whole;
        rest.displacement = last->displacement;
        rest.turn = last->turn;
        BodyPose pose = last->start;
        advance_along({rest.displacement, rest.turn}, Fraction::from_raw(static_cast<int64_t>(ldexp(part, 62))), pose);
        return pose;
      };
      bool overlaps = was;
      for (int i = 0; i <= 1000 && !overlaps; ++i) {
        const Fraction time = Fraction::from_raw((int64_t{1} << 62) / 1000 * i);
        overlaps = overlap_by(state.traits[slots[1]], pose_then(slots[1], time), state.traits[slots[0]],
                              pose_then(slots[0], time), sizeof(Coord) == 4 ? 1e-4 : 2e-6);
      }
      const bool noticed = was || report.sensor_events != 0;
      if (overlaps) {
        EXPECT_TRUE(noticed) << "round " << round << " tick " << tick;
      }
      passes += overlaps && !was ? 1 : 0;
      grazes += noticed && !overlaps ? 1 : 0;
      EXPECT_EQ(report.sensed_undecided, 0u);
    }
  }
  EXPECT_GT(passes, rounds / 4);
  EXPECT_LE(grazes, rounds / 20) << "what only comes near is not told";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
