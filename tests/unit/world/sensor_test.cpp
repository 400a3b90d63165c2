#include <detent/body.h>
#include <detent/query.h>
#include <detent/world.h>

#include "tests/unit/shape/terrains.h"
#include "tests/unit/world/sensor_lab.h"

/// Bodies that are within a sensor at the end of a step, and bodies that passed through it.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

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
    EXPECT_EQ(trap.report.ccd.impacts, 0u);
    EXPECT_EQ(trap.report.lost.sensed_undecided, 0u);
    EXPECT_NEAR(trap.lab.motion(bullet).linear_velocity[0], 500, 1e-3);
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
  EXPECT_EQ(trap.report.ccd.impacts, 1u);
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
  EXPECT_EQ(trap.report.ccd.impacts, 1u);
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
  EXPECT_EQ(trap.report.ccd.impacts, 1u);
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
  // A sensor that is created at a sleeping body senses it and does not wake it.
  const BodyId other = trap.lab.add(sensor_def(sphere(real(0.5)), 0.4, 0.3, 0.1));
  events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, other, crate));
  EXPECT_OK(is_awake(trap.lab.world, crate, awake));
  EXPECT_FALSE(awake);
  // The same holds for a sensor that moves through it, although a solid body would wake it.
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
  // A sensor that is moved to the position of the ball raises an enter event only.
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
  EXPECT_EQ(trap.report.contacts.count, 1u) << "it is solid now";
  EXPECT_OK(set_sensor(trap.lab.world, second, true));
  bool sensor = false;
  EXPECT_OK(get_sensor(trap.lab.world, second, sensor));
  EXPECT_TRUE(sensor);
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u) << "a dynamic sensor senses what is fixed";
  EXPECT_TRUE(is_event(events[0], k_enter, second, gate));
  EXPECT_EQ(trap.report.contacts.count, 0u);
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
  trap.lab.world.hooks.filter_rules = {rules, 1};
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
  arm.angular_velocity = reals(0, 90, 0);  // a quarter of a turn a tick
  const BodyId blade = trap.lab.add(arm);
  BodyDef thin = sensor_def(box(reals(0.005, 1, 1)), -3, 5, 0, BodyType::kinematic);
  thin.linear_velocity = reals(500, 0, 0);
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
  EXPECT_EQ(trap.report.lost.sensed_undecided, 0u);
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
  trap.lab.world.hooks.capacity_events = {lost, 8};
  const BodyId gate = trap.lab.add(sensor_def(box(reals(10, 1, 1))));
  std::vector<BodyId> balls;
  for (int i = 0; i < 5; ++i) {
    BodyDef def = ball_def(0.25, i, 0, 0);
    def.type = BodyType::kinematic;  // none of them moves: they are asked about because some were lost
    balls.push_back(trap.lab.add(def));
  }
  EXPECT_EQ(trap.run().size(), 3u);
  EXPECT_EQ(trap.report.lost.sensed, 2u);
  EXPECT_FALSE(trap.report.complete());
  ASSERT_EQ(trap.report.events.capacity, 2u);
  EXPECT_EQ(lost[0].type, CapacityEventType::sensed);
  EXPECT_EQ(lost[0].a, gate);
  EXPECT_EQ(lost[0].b, balls[3]);
  EXPECT_EQ(lost[1].b, balls[4]);
  EXPECT_TRUE(trap.run().empty());
  EXPECT_EQ(trap.report.lost.sensed, 0u) << "nothing moves, so the step has nothing to do";
  EXPECT_OK(destroy_body(trap.lab.world, balls[0]));
  EXPECT_EQ(get_info(trap.lab.world).sensed, 2u);
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(is_event(events[0], k_enter, gate, balls[3]));
  EXPECT_EQ(trap.report.lost.sensed, 1u);
}

DETENT_TEST(sensor, a_body_that_passes_through_is_noticed_whichever_others_stay_within) {
  for (const bool reflected : {false, true}) {
    for (uint32_t passing = 0; passing < 3; ++passing) {
      Trap trap(room_for(6));
      const BodyId gate = trap.lab.add(sensor_def(box(reals(0.02, 0.25, 5))));
      BodyId ids[3];
      for (uint32_t i = 0; i < 3; ++i) {
        BodyDef def = ball_def(0.05, 0, 0, i - 1.0);
        if (i == passing) def.position = position(-9, 0, i - 1.0);
        ids[i] = trap.lab.add(def);
      }
      if (reflected) {
        BodyDef wall;
        wall.type = BodyType::fixed;
        wall.shape = box(reals(0.05, 5, 5));
        wall.position = position(1, 0, 0);
        wall.material.restitution = real(1);
        trap.lab.add(wall);
      }
      EXPECT_EQ(trap.run().size(), 2u);
      const BodyId id = ids[passing];
      EXPECT_OK(set_pose(trap.lab.world, id, position(-1, -0.5, passing - 1.0), {0.0, 0.0, 0.0, 1.0}));
      EXPECT_OK(set_velocity(trap.lab.world, id, reals(240, 120, 0), {}));
      const std::vector<SensorEvent> events = trap.run();
      EXPECT_EQ(trap.report.ccd.impacts, reflected ? 1u : 0u);
      ASSERT_EQ(events.size(), 2u) << reflected << " " << passing;
      EXPECT_TRUE(is_event(events[0], k_enter, gate, id));
      EXPECT_TRUE(is_event(events[1], k_leave, gate, id));
      EXPECT_EQ(trap.within(gate).size(), 2u);
    }
  }
}

DETENT_TEST(sensor, a_body_that_passes_through_without_room_is_counted) {
  // The wall reflects each ball, so the first part of its sweep, up to the wall, passes through the gate. There is
  // capacity for one pair.
  Trap trap(room_for(6, 1));
  CapacityEvent lost[8];
  trap.lab.world.hooks.capacity_events = {lost, 8};
  const BodyId gate = trap.lab.add(sensor_def(box(reals(0.02, 0.25, 5))));
  BodyDef wall;
  wall.type = BodyType::fixed;
  wall.shape = box(reals(0.05, 5, 5));
  wall.position = position(1, 0, 0);
  trap.lab.add(wall);
  std::vector<BodyId> balls;
  for (int i = 0; i < 3; ++i) {
    BodyDef def = ball_def(0.05, -1, -0.5, i - 1, reals(240, 120, 0));
    def.material.restitution = real(1);
    balls.push_back(trap.lab.add(def));
  }
  const std::vector<SensorEvent> events = trap.run();
  EXPECT_EQ(trap.report.ccd.impacts, 3u);
  EXPECT_EQ(trap.report.lost.sensed_undecided, 0u);
  ASSERT_EQ(events.size(), 2u) << "it enters and leaves";
  EXPECT_TRUE(is_event(events[0], k_enter, gate, balls[0]));
  EXPECT_TRUE(is_event(events[1], k_leave, gate, balls[0]));
  EXPECT_EQ(trap.report.lost.sensed, 2u);
  EXPECT_EQ(trap.report.events.capacity, 2u);
}

DETENT_TEST(sensor, events_beyond_the_buffer_are_dropped_and_counted_and_alter_nothing) {
  std::vector<uint64_t> digests;
  for (const uint32_t room : {0u, 2u, 8u}) {
    Trap trap(room_for(6), weightless(), false, room);
    trap.lab.add(sensor_def(box(reals(10, 1, 1))));
    for (int i = 0; i < 5; ++i) trap.lab.add(ball_def(0.25, i, 0, 0));
    const std::vector<SensorEvent> events = trap.run();
    EXPECT_EQ(events.size(), room < 5 ? room : 5);
    EXPECT_EQ(trap.report.events.sensor_dropped, room == 2 ? 3u : 0u);
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
  ASSERT_OK(create_world(bytes_of(block), byte_count(block), def, {},
                         feature_table<without(Features::all, Features::sensors)>, lean));
  EXPECT_EQ(create_body(lean, sensor_def(sphere(real(1))), id), Status::feature_missing);
  EXPECT_OK(create_body(lean, ball_def(0.25, 0, 0, 0), id));
  EXPECT_EQ(set_sensor(lean, id, true), Status::feature_missing);
  uint32_t count = 7;
  EXPECT_EQ(get_sensed(lean, id, nullptr, 0, count), Status::bad_argument);
  EXPECT_EQ(get_sensed(lean, {}, nullptr, 0, count), Status::bad_id);
  EXPECT_EQ(count, 7u);
}

DETENT_TEST(sensor, one_that_falls_through_a_mesh_senses_it_as_long_as_it_touches_and_on_its_way) {
  const detent_terrains::Bytes bytes = detent_terrains::cooked(detent_terrains::plane(8, 0.5));
  const Asset asset = {bytes.data(), bytes.count()};
  Capacity capacity = room_for(4);
  capacity.assets = 1;
  Trap trap(capacity);
  trap.lab.world.hooks.assets = {&asset, 1};
  ASSERT_OK(bind_asset(trap.lab.world, 0));
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = terrain(0);
  const BodyId ground = trap.lab.add(def);
  BodyDef probe = sensor_def(sphere(real(0.25)), 0.1, 1, 0.2, BodyType::dynamic);
  probe.linear_velocity = reals(0, -3, 0);
  const BodyId slow = trap.lab.add(probe);
  int enters = 0, leaves = 0;
  for (int tick = 0; tick < 60; ++tick) {
    const double before = trap.lab.motion(slow).position[1];
    for (const SensorEvent& event : trap.run()) {
      EXPECT_TRUE(is_event(event, event.type, slow, ground));
      const bool enter = event.type == k_enter;
      const double edge = enter ? 0.25 : -0.25;
      EXPECT_GE(before, edge - 1e-3);
      EXPECT_LE(trap.lab.motion(slow).position[1], edge + 1e-3);
      enters += enter ? 1 : 0;
      leaves += enter ? 0 : 1;
    }
  }
  EXPECT_EQ(enters, 1);
  EXPECT_EQ(leaves, 1);
  probe.linear_velocity = reals(0, -500, 0);
  const BodyId fast = trap.lab.add(probe);
  const std::vector<SensorEvent> events = trap.run();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_TRUE(is_event(events[0], k_enter, fast, ground));
  EXPECT_TRUE(is_event(events[1], k_leave, fast, ground));
  EXPECT_EQ(trap.report.lost.sensed_undecided, 0u);
  EXPECT_EQ(trap.report.contacts.count, 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
