#include "tests/unit/ccd/impact_shots.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef ball(double radius, double x, double speed, double restitution) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.position = position(x, 0, 0);
  def.linear_velocity = reals(speed, 0, 0);
  def.material.restitution = real(restitution);
  return def;
}

BodyDef wall(double x) {
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = box(reals(0.005, 5, 5));
  def.position = position(x, 0, 0);
  return def;
}

DETENT_TEST(impact_stage, without_it_a_ball_passes_through_a_wall) {
  for (const bool continuous : {false, true}) {
    WorldDef def = weightless();
    def.continuous = continuous;
    Lab lab({2, 4, 0}, def);
    lab.add(wall(0));
    const BodyId shot = lab.add(ball(0.05, -4, 500, 0));
    lab.run(3);
    EXPECT_EQ(lab.motion(shot).position[0] > 0, !continuous);
  }
}

DETENT_TEST(impact_stage, a_body_at_rest_that_is_struck_meets_what_it_flies_into) {
  Lab lab({3, 8, 0}, weightless());
  lab.add(wall(0));
  const BodyId resting = lab.add(ball(0.1, -0.3, 0, 0)), shot = lab.add(ball(0.2, -4, 500, 0));
  for (int tick = 0; tick < 10; ++tick) {
    const StepReport report = lab.run(1);
    EXPECT_EQ(real_to_host(report.ccd.lost_time), 0);
    EXPECT_LT(lab.motion(resting).position[0], -0.1);
    EXPECT_LT(lab.motion(shot).position[0], lab.motion(resting).position[0]);
  }
}

/// A box that falls onto another is in contact in the tick in which they touch; the solver stops it. Only a rebound is
/// an impact.
DETENT_TEST(impact_stage, a_pair_that_its_contacts_keep_apart_is_not_searched) {
  for (const double restitution : {0.0, 1.0}) {
    Lab lab({2, 8, 0});
    BodyDef below, above;
    below.type = BodyType::fixed;
    below.shape = above.shape = box(reals(0.5, 0.5, 0.5));
    above.position = position(0.1, 1.2, 0.1);
    above.material.restitution = real(restitution);
    lab.add(below);
    const BodyId falling = lab.add(above);
    uint32_t tests = 0, kept_apart = 0;
    for (int tick = 0; tick < 60; ++tick) {
      const StepReport report = lab.run(1);
      tests += report.ccd.tests;
      kept_apart += report.ccd.kept_apart;
      EXPECT_GT(lab.motion(falling).position[1], 1 - 1.0 / 512);
    }
    EXPECT_EQ(tests, 0u);
    EXPECT_GT(kept_apart, 0u);
  }
}

/// A scene at another scale, with gravity in proportion, takes the same course, and so the same searches. In fixed
/// point the roundings differ, and the courses of some drops part: all drops are compared in sum, the others one by
/// one.
/// Two boxes touch along an edge, without a contact. One of them slides along the edge, or rotates off it.
DETENT_TEST(impact_stage, a_pair_that_touches_is_tested_again_only_if_it_can_come_back) {
  uint32_t tests[2];
  for (const bool rotates : {false, true}) {
    Lab lab({2, 8, 0}, weightless());
    BodyDef def;
    def.shape = box(reals(0.5, 0.5, 0.5));
    lab.add(def);
    def.position = position(1, 1, 0);
    def.linear_velocity = reals(0, 0, 0.01);
    if (rotates) def.angular_velocity = reals(0, 0, 10);
    lab.add(def);
    tests[rotates] = lab.run(1).ccd.tests;
  }
  EXPECT_EQ(tests[0], 3u);  // with the whole shapes, the smallest cores and the largest ones
  EXPECT_GT(tests[1], 3u);
}

DETENT_TEST(impact_stage, bodies_of_all_sizes_are_kept_apart_alike) {
  const auto searches = [](double scale, double height) {
    WorldDef world;
    world.gravity = reals(0, -9.81 * scale, 0);
    Lab lab({2, 8, 0}, world);
    BodyDef below, above;
    below.type = BodyType::fixed;
    below.shape = above.shape = box(reals(0.5 * scale, 0.5 * scale, 0.5 * scale));
    above.position = position(0.1 * scale, height * scale, 0.1 * scale);
    above.rotation = rotation_near(detent_oracle::rotation_by({0, 0, 0.3}));
    lab.add(below);
    lab.add(above);
    uint32_t tests = 0, kept_apart = 0;
    for (int tick = 0; tick < 60; ++tick) {
      const StepReport report = lab.run(1);
      tests += report.ccd.tests;
      kept_apart += report.ccd.kept_apart;
    }
    return std::pair(tests, kept_apart);
  };
  constexpr int k_equal_below = DETENT_FIXED ? 36 : 41;  // from there on, the courses part at the first impact
  constexpr double k_scales[3] = {1, 16, 1.0 / 16};
  uint32_t tests[3] = {}, kept_apart[3] = {};
  for (int height = 24; height <= 51; ++height) {  // twentieths
    std::pair<uint32_t, uint32_t> of[3];
    for (int i = 0; i < 3; ++i) {
      of[i] = searches(k_scales[i], height / 20.0);
      if (height < k_equal_below) {
        EXPECT_EQ(of[i], of[0]) << height << ", scale " << k_scales[i];
      }
      tests[i] += of[i].first;
      kept_apart[i] += of[i].second;
    }
  }
  EXPECT_GT(kept_apart[0], 28u);
  for (int i = 1; i < 3; ++i) {
    EXPECT_NEAR(kept_apart[i], kept_apart[0], 0.1 * kept_apart[0]) << "scale " << k_scales[i];
    EXPECT_NEAR(tests[i], tests[0], 0.5 * tests[0]) << "scale " << k_scales[i];
  }
}

/// After an impact, the other contacts of both bodies are judged by their motion since the start of the tick.
DETENT_TEST(impact_stage, a_resting_body_that_is_struck_is_not_searched_against_what_it_rests_on) {
  Lab lab({3, 8, 0});
  BodyDef below, above;
  below.type = BodyType::fixed;
  below.shape = box(reals(5, 0.5, 5));
  above.shape = box(reals(0.5, 0.5, 0.5));
  above.position = position(0, 1, 0);
  lab.add(below);
  lab.add(above);
  lab.run(30);
  BodyDef shot = ball(0.1, -1.1, 60, 0);
  shot.position = position(-1.1, 1, 0);
  lab.add(shot);
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.ccd.impacts, 1u);
  EXPECT_EQ(report.ccd.kept_apart + report.ccd.skipped, 2u) << "before the impact and after it";
}

DETENT_TEST(impact_stage, three_balls_in_a_row_pass_a_blow_on_in_one_tick) {
  Lab lab({4, 8, 0}, weightless());
  std::vector<BodyId> balls;
  for (int i = 0; i < 4; ++i) balls.push_back(lab.add(ball(0.1, i, i == 0 ? 600 : 0, 1)));
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.ccd.impacts, 3u);
  EXPECT_TRUE(report.complete());
  const double error = sizeof(Real) == 4 ? 1e-3 : 1e-5;
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(lab.motion(balls[static_cast<size_t>(i)]).linear_velocity[0], i == 3 ? 600 : 0, error);
  EXPECT_NEAR(lab.motion(balls[0]).position[0], 0.8, 1e-3);
  EXPECT_NEAR(lab.motion(balls[3]).position[0], 0.6 + 10, 1e-3) << "each gap of 0.8 m is crossed once, by one of them";
}

/// A heavy ball strikes a light one in front of a wall at 20 m/s. An impulse that passes once between the heavy ball
/// and the wall stops only the light ball's share of the momentum.
DETENT_TEST(impact_stage, a_light_ball_before_a_wall_stops_a_heavy_one) {
  for (const double ratio : {4.0, 30.0, 200.0, 20000.0}) {
    Lab lab({3, 8, 0}, weightless());
    lab.add(wall(0));
    BodyDef heavy = ball(0.1, -0.506, 20, 0);
    heavy.density = scaled(1000 * ratio);
    const BodyId light = lab.add(ball(0.1, -0.106, 0, 0)), striker = lab.add(heavy);
    EXPECT_TRUE(lab.run(1).complete()) << ratio;
    EXPECT_LT(fabs(lab.motion(striker).linear_velocity[0]), 0.03) << ratio;
    EXPECT_LT(lab.motion(striker).position[0], -0.3) << ratio;
    EXPECT_LT(lab.motion(light).position[0], -0.1) << ratio;
  }
}

DETENT_TEST(impact_stage, a_kinematic_plate_drives_a_ball_and_is_not_stopped) {
  Lab lab({2, 4, 0}, weightless());
  BodyDef plate = wall(-3);
  plate.type = BodyType::kinematic;
  plate.linear_velocity = reals(200, 0, 0);
  const BodyId driver = lab.add(plate), driven = lab.add(ball(0.05, 0, 0, 0));
  for (int tick = 1; tick <= 20; ++tick) {
    EXPECT_EQ(lab.run(1).ccd.bodies_stopped, 0u);
    EXPECT_NEAR(lab.motion(driver).position[0], -3 + tick * 200 / 60.0, 1e-3);
    EXPECT_GT(lab.motion(driven).position[0], lab.motion(driver).position[0] + 0.04);
  }
  EXPECT_NEAR(lab.motion(driven).linear_velocity[0], 200, 1e-2);
}

DETENT_TEST(impact_stage, a_angular_velocity_that_a_blow_takes_out_of_its_range_is_held_and_counted) {
  Lab lab({2, 16, 0}, weightless());
  BodyDef post;
  post.type = BodyType::fixed;
  post.shape = box(reals(0.05, 0.05, 0.5));
  post.position = position(0, 0.5, 0.05);
  lab.add(post);
  BodyDef rod;
  rod.shape = capsule(real(0.01), real(1));
  rod.position = position(-16000 / 120.0 - 0.2, 0, 0);
  rod.linear_velocity = reals(16000, 0, 0);
  rod.material.restitution = real(1);
  lab.add(rod);
  const StepReport report = lab.run(1);
  EXPECT_GT(report.ccd.impacts, 0u);
  EXPECT_GT(report.saturations, 0u);
}

/// The expected sum was measured. It is the same in every configuration, and is less if one of the counts is left out:
/// clamps of the angular velocity after an impact, of the changed sweep, or of the motion that the state keeps.
DETENT_TEST(impact_stage, every_clamp_of_rods_that_strike_a_post_is_counted) {
  uint32_t clamped = 0;
  for (const double tick : {0.25, 1 / 60.0}) {
    for (const double speed : {50.0, 1000.0, 16000.0}) {
      for (const double half : {0.1, 1.0}) {
        for (const double angular_velocity : {0.0, 1000.0, 16000.0}) {
          WorldDef def = weightless();
          def.tick = real(tick);
          Lab lab({2, 16, 0}, def);
          BodyDef post;
          post.type = BodyType::fixed;
          post.shape = box(reals(0.05, 0.05, 0.5));
          post.position = position(0, half / 2, 0.05);
          lab.add(post);
          BodyDef rod;
          rod.shape = capsule(real(0.03), real(half));
          rod.position = position(-speed * tick / 2 - 0.2, 0, 0);
          rod.linear_velocity = reals(speed, 0, 0);
          rod.angular_velocity = reals(0, 0, angular_velocity);
          rod.material.restitution = real(1);
          BodyId id;
          if (create_body(lab.world, rod, id) != Status::ok) continue;  // its ends would be too fast
          for (int i = 0; i < 3; ++i) clamped += lab.run(1).saturations;
        }
      }
    }
  }
#if defined(DETENT_F32)
  EXPECT_EQ(clamped, 8u);
#else
  EXPECT_EQ(clamped, 6u);
#endif
}

DETENT_TEST(impact_stage, a_ball_that_drops_rebounds_to_where_gravity_takes_it) {
  Lab lab({2, 4, 0});
  lab.add_ground();
  BodyDef def = ball(0.5, 0, 0, 1);
  def.position = position(0, 5.5, 0);
  const BodyId id = lab.add(def);
  double apex = 0;
  int rising = 0;
  for (int tick = 0; tick < 1200; ++tick) {
    const double before = lab.motion(id).linear_velocity[1];
    lab.run(1);
    apex = std::max(apex, lab.motion(id).position[1]);
    if (before > 0 && lab.motion(id).linear_velocity[1] <= 0) ++rising;
  }
  EXPECT_GE(rising, 9);
  EXPECT_LT(apex, 5.5 * 1.05);
}

/// A crowd of bodies, some of them fast, that falls into a pit of thin walls.
Lab make_crowd(uint64_t seed, uint32_t contacts) {
  Samples samples = {seed};
  Lab lab({66, contacts, 0});
  BodyDef floor;
  floor.type = BodyType::fixed;
  floor.shape = box(reals(4, 0.01, 4));
  lab.add(floor);
  for (int side = 0; side < 4; ++side) {
    BodyDef plate = floor;
    plate.shape = box(side < 2 ? reals(0.01, 4, 2) : reals(2, 4, 0.01));
    plate.position = position(side == 0 ? -2 : side == 1 ? 2 : 0, 4, side == 2 ? -2 : side == 3 ? 2 : 0);
    lab.add(plate);
  }
  for (int i = 0; i < 60; ++i) {
    BodyDef def;
    const double size = uniform(samples, 0.1, 0.2);
    if (i % 3 == 0) def.shape = box(reals_near({{size, size * uniform(samples, 0.2, 1), size}}));
    if (i % 3 == 1) def.shape = sphere(real_near(size));
    if (i % 3 == 2) def.shape = capsule(real_near(size * 0.5), real_near(size));
    def.position = position_near({{(i % 3 - 1) * 0.9, 0.6 + 0.6 * (i / 9), (i / 3 % 3 - 1) * 0.9}});
    def.rotation = rotation_near(any_rotation(samples));
    if (i % 4 == 0) def.linear_velocity = reals_near(any_direction(samples) * uniform(samples, 10, 80));
    if (i % 5 == 0) def.angular_velocity = reals_near(any_direction(samples) * 30);
    def.material.restitution = real_near(i % 2 * 0.5);
    lab.add(def);
  }
  return lab;
}

/// The filters are compared up to a tick that spends the budget of work: it counts tests, so it is then not spent at
/// the same pair.
DETENT_TEST(impact_stage, leaving_out_pairs_that_cannot_meet_changes_no_bit) {
  uint32_t spent = 0;
  const uint64_t seeds = detent_oracle::rounds(2);
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    Lab quick = make_crowd(seed, 400), thorough = make_crowd(seed, 400);
    StepProbe filtered, all;
    all.filters = false;
    uint32_t skipped = 0, impacts = 0;
    for (int tick = 0; tick < 150; ++tick) {
      const StepReport report = step_probed(quick.world, filtered), other = step_probed(thorough.world, all);
      if (filtered.use.is_spent() || all.use.is_spent()) {
        ++spent;
        break;
      }
      skipped += report.ccd.skipped;
      impacts += report.ccd.impacts;
      EXPECT_EQ(report.ccd.impacts, other.ccd.impacts);
      EXPECT_EQ(other.ccd.skipped, 0u);
      ASSERT_EQ(digest(quick.world), digest(thorough.world)) << "seed " << seed << ", tick " << tick;
      if (tick == 149) {
        EXPECT_GT(skipped, 500u);
        EXPECT_GT(impacts, 100u);
      }
    }
  }
  EXPECT_LE(spent, seeds / 20);
}

Solid solid_at(Lab& lab, uint32_t slot, const SegmentPose& at) {
  OracleBody body;
  body.properties = view_of(lab.world).properties[slot];
  Solid result = solid_of(body, Position{});
  result.centre = at.position;
  for (int i = 0; i < 3; ++i) result.axis[i] = detent_oracle::axis_of(at.rotation, i);
  return result;
}

/// The signed gap. For a box and a round body the order does not matter.
double gap_of(const Solid& a, const Solid& b) {
  return (a.kind <= b.kind ? separation_of(a, b) : separation_of(b, a)).value;
}

DETENT_TEST(impact_stage, the_committed_sweeps_make_no_deep_overlap_and_none_escapes) {
  for (uint64_t seed = 1; seed <= detent_oracle::rounds(1); ++seed) {
    Lab lab = make_crowd(seed, 400);
    Trace trace;
    std::vector<bool> left(66);
    double deepest = 0, deepest_apart = 0;  // over the smaller extent; of pairs that were apart when the tick began
    uint32_t tests = 0, impacts = 0, stopped = 0;
    const int ticks = detent_oracle::rounds(120) < 120 ? 40 : 120;
    for (int tick = 0; tick < ticks; ++tick) {
      const auto state = view_of(lab.world);
      std::vector<SegmentPose> start;
      for (uint32_t i = 0; i < state.world.slots_used; ++i) {
        start.push_back({difference(state.poses[i].position, Position{}), host(state.poses[i].rotation)});
      }
      const StepReport report = trace.step(lab.world);
      tests += report.ccd.tests;
      impacts += report.ccd.impacts;
      stopped += report.ccd.bodies_stopped;
      for (uint32_t a = 0; a < start.size(); ++a) {
        for (uint32_t b = std::max(a + 1, 5u); b < start.size(); ++b) {
          const double far = length(start[a].position - start[b].position);
          if (a >= 5 && far > 2.5) continue;
          const double before = gap_of(solid_at(lab, a, start[a]), solid_at(lab, b, start[b]));
          const double extent = std::min(real_to_host(shape_extent(state.properties[a])),
                                         real_to_host(shape_extent(state.properties[b])));
          for (int part = 1; part <= 8; ++part) {
            const double gap = gap_of(solid_at(lab, a, trace.at(a, part / 8.0, start[a])),
                                      solid_at(lab, b, trace.at(b, part / 8.0, start[b])));
            const double depth = (std::min(before, 0.0) - gap) / extent;
            deepest = std::max(deepest, depth);
            if (before > extent / 64) deepest_apart = std::max(deepest_apart, depth);
          }
        }
      }
      for (uint32_t i = 5; i < start.size(); ++i) {
        const Motion motion = lab.motion({i + 1, state.properties[i].generation});
        if (motion.position[1] > 7) left[i] = true;  // over the walls
        if (left[i]) continue;
        EXPECT_GT(motion.position[1], 0);
        EXPECT_LT(std::max(fabs(motion.position[0]), fabs(motion.position[2])), 2);
      }
    }
    ::testing::Test::RecordProperty("deepest", std::to_string(deepest));
    ::testing::Test::RecordProperty("deepest_apart", std::to_string(deepest_apart));
    EXPECT_GT(impacts, 100u);
    EXPECT_GT(tests, impacts);
    EXPECT_LT(deepest, 0.4) << "of the smaller extent: two insets of an eighth, and some rungs";
    EXPECT_LT(deepest_apart, 0.05);
    EXPECT_LE(stopped, 2u) << "of 7200: one crushed among others meets more often than its budget allows";
  }
}

/// Sheets of 0.2 mm, 2 mm apart, fall on the ground. Each one passes on the impacts of the sheets below, many times.
DETENT_TEST(impact_stage, the_work_of_a_tick_goes_with_what_there_is_to_look_at) {
  Lab lab({25, 400, 0});
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  lab.add(ground);
  std::vector<BodyId> sheets;
  for (int i = 0; i < 24; ++i) {
    BodyDef def;
    def.shape = box(reals(0.5, 0.0001, 0.5));
    def.position = position(0, 0.0011 + 0.0022 * i, 0);
    sheets.push_back(lab.add(def));
  }
  uint32_t tests_max = 0;
  for (int tick = 0; tick < 120; ++tick) {
    tests_max = std::max(tests_max, lab.run(1).ccd.tests);
    for (const BodyId id : sheets) ASSERT_GT(lab.motion(id).position[1], -0.0002) << "tick " << tick;
  }
  ::testing::Test::RecordProperty("tests_max", std::to_string(tests_max));
  EXPECT_LT(tests_max, 15000u) << "24 sheets, 276 pairs";
}

/// The other shrink depths are not tested if the bodies overlap even at the largest one.
DETENT_TEST(impact_stage, what_lies_in_one_place_costs_two_tests_a_pair) {
  Lab lab({40, 100, 0}, weightless());  // beyond the pairs that there is room for all are tested
  for (int i = 0; i < 40; ++i) {
    BodyDef def;
    def.shape = sphere(real(0.25));
    def.linear_velocity = reals(0.01 * i, 0, 0);
    lab.add(def);
  }
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.contacts.pairs, 780u);
  EXPECT_LE(report.ccd.tests, 2 * 780u);
}

DETENT_TEST(impact_stage, momentum_is_kept_whatever_meets) {
  Samples samples = {77};
  Lab lab({27, 400, 0}, weightless());
  double size = 0;
  for (int i = 0; i < 27; ++i) {
    const Vector at = {{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0}};
    BodyDef def;
    if (i % 2 == 0) def.shape = box(reals_near({{0.2, 0.1, 0.3}}));
    if (i % 2 == 1) def.shape = sphere(real_near(0.2));
    def.position = position_near(at * 2);
    def.linear_velocity = reals_near(at * -100 + any_direction(samples) * 30);
    def.angular_velocity = reals_near(any_direction(samples) * 10);
    def.material.restitution = real(0.7);
    lab.add(def);
  }
  const auto sum = [&] {
    Vector linear = {{0, 0, 0}};
    const auto state = view_of(lab.world);
    for (uint32_t i = 0; i < state.world.slots_used; ++i) {
      const Vector part = host(state.motions[i].linear_velocity) * scaled_to_host(state.properties[i].mass);
      linear = linear + part;
      size += length(part);
    }
    return linear;
  };
  const Vector start = sum();
  const double whole = size;
  uint32_t impacts = 0;
  for (int tick = 0; tick < 30; ++tick) {
    const StepReport report = lab.run(1);
    impacts += report.ccd.impacts;
    EXPECT_EQ(report.saturations, 0u);
  }
  EXPECT_GT(impacts, 20u);
  EXPECT_LT(length(sum() - start) / whole, 1e-6);
}

DETENT_TEST(impact_stage, impacts_without_room_stop_their_bodies_and_are_counted) {
  Lab lab({9, 1, 0}, weightless());
  lab.add(wall(0));
  std::vector<BodyId> balls;
  for (int i = 0; i < 8; ++i) {
    BodyDef def = ball(0.05, -1 - i * 0.3, 500, 0);
    def.position = position(-1 - i * 0.3, i * 0.5 - 2, 0);
    balls.push_back(lab.add(def));
  }
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.ccd.impacts, 1u);
  EXPECT_EQ(report.lost.impacts, 7u);
  EXPECT_EQ(report.ccd.bodies_stopped, 7u);
  EXPECT_NEAR(real_to_host(report.ccd.lost_time), 7, 1e-6);
  EXPECT_FALSE(report.complete());
  for (int tick = 0; tick < 60; ++tick) lab.run(1);
  for (const BodyId id : balls) EXPECT_LT(lab.motion(id).position[0], 0) << "none passes";
}

DETENT_TEST(impact_stage, nothing_passes_through_a_wall_for_want_of_room_for_pairs) {
  uint32_t pairs_dropped = 0, stopped = 0;
  for (const uint32_t contacts : {0u, 1u, 2u, 5u, 100u}) {
    for (const bool target_sleeps : {false, true}) {
      Lab lab({20, contacts, 0}, weightless(), true);
      lab.add(wall(0));
      // A heap of bodies inside each other fills the buffers.
      for (int i = 0; i < 8; ++i) lab.add_box(0.5, -20 + i * 0.05, 20, 0);
      std::vector<BodyId> shots;
      for (int i = 0; i < 4; ++i) {
        BodyDef def = ball(0.05, -4, 500, 0.5);
        def.position = position(-4, i - 1.5, 0);
        shots.push_back(lab.add(def));
      }
      const BodyId target = lab.add(ball(0.05, -0.5, 0, 0));
      ASSERT_OK(set_pose(lab.world, target, position(-0.5, 0.5, 0), {0.0, 0.0, 0.0, 1.0}));
      if (target_sleeps) {
        ASSERT_OK(sleep_body(lab.world, target));
      }
      shots.push_back(target);
      for (int tick = 0; tick < 30; ++tick) {
        const StepReport report = lab.run(1);
        pairs_dropped += report.lost.pairs;
        stopped += report.ccd.bodies_stopped;
        EXPECT_EQ(report.complete(), report.lost.pairs == 0 && report.lost.contacts == 0 &&
                                         report.contacts.capped == 0 && report.ccd.bodies_stopped == 0);
        EXPECT_LE(report.lost.impacts == 0 ? 0u : 1u, report.ccd.bodies_stopped);
        ASSERT_LT(lab.motion(shots[2]).position[0], lab.motion(target).position[0]);
        for (const BodyId id : shots)
          ASSERT_LT(lab.motion(id).position[0], 0) << contacts << " contacts, tick " << tick;
      }
    }
  }
  EXPECT_GT(pairs_dropped, 0u);
  EXPECT_GT(stopped, 0u);
}

DETENT_TEST(impact_stage, a_sleeper_that_is_struck_strikes_a_near_sleeper_however_slowly) {
  Lab lab({3, 8, 0}, weightless(), true);
  lab.add_box(0.5, 0, 0, 0);
  const BodyId second = lab.add_box(0.5, 1.002, 0, 0);
  EXPECT_EQ(lab.run(200).awake, 0u);
  lab.add(ball(0.1, -1.1, 60, 0));
  EXPECT_GE(lab.run(1).ccd.impacts, 2u);
  EXPECT_GT(lab.motion(second).linear_velocity[0], 0) << "the gap is less than the contact margin of the pair";
}

/// A body that gravity moves farther than its contacts were searched for, in its first tick.
DETENT_TEST(impact_stage, a_pair_without_contact_is_searched_whatever_the_contact_margin) {
  for (const double margin : {1.0 / 16, 1.0 / 64, 1.0 / 1024}) {
    WorldDef world;
    world.gravity = reals(0, -40, 0);
    world.contact_margin = real(margin);
    world.contact_recycle_distance = real(0);
    Lab lab({2, 8, 0}, world);
    BodyDef below;
    below.type = BodyType::fixed;
    below.shape = box(reals(0.5, 0.5, 0.5));
    lab.add(below);
    const BodyId falling = lab.add_box(0.5, 0, 1.002, 0);
    lab.run(1);
    EXPECT_GT(lab.motion(falling).position[1], 1 - 1.0 / 2048) << margin;
  }
}

/// Axes of faces and edges separate these boxes by less than the contact margin, but no points of their faces are as
/// near. Two vertices are, 7.4 mm apart, and meet in the tick.
DETENT_TEST(impact_stage, boxes_that_are_nearest_at_their_vertices_are_searched) {
  Lab lab({2, 8, 0}, weightless());
  BodyDef still;
  still.type = BodyType::fixed;
  still.shape = box(reals(0.110905, 0.0798147, 0.110905));
  still.position = position(-0.871414, 0.089823, 0.879126);
  still.rotation = rotation_near(detent_oracle::rotation_by({-0.00026, 0.66689, -0.00018}));
  lab.add(still);
  BodyDef moving;
  moving.shape = box(reals(0.115036, 0.028027, 0.115036));
  moving.position = position(-0.85677, 0.111375, 0.565964);
  moving.rotation = rotation_near(detent_oracle::rotation_by({-0.30551, 0.73501, -0.74725}));
  moving.linear_velocity = reals(-60 * 0.0056, -60 * 0.0043, 60 * 0.0055);
  lab.add(moving);
  EXPECT_EQ(lab.run(1).ccd.impacts, 1u);
}

DETENT_TEST(impact_stage, of_what_sleeps_only_what_is_struck_is_looked_at_and_it_strikes_others_in_turn) {
  // A row of sleeping bodies, each of which is reached only by the motion of the one before. The impact passes through
  // all of them in one tick.
  Lab lab({7, 40, 0}, weightless(), true);
  std::vector<BodyId> balls;
  for (int i = 0; i < 6; ++i) balls.push_back(lab.add(ball(0.1, i, 0, 1)));
  for (const BodyId id : balls) ASSERT_OK(sleep_body(lab.world, id));
  lab.run(2);
  balls.push_back(lab.add(ball(0.1, -1, 900, 1)));
  const StepReport report = lab.run(1);
  EXPECT_EQ(report.ccd.impacts, 6u);
  EXPECT_EQ(report.woke, 6u);
  EXPECT_TRUE(report.complete());
  EXPECT_NEAR(lab.motion(balls[5]).linear_velocity[0], 900, 1e-2);
  EXPECT_EQ(lab.run(1).awake, 7u);
}

DETENT_TEST(impact_stage, a_sleeper_that_is_struck_without_room_is_still_there_in_the_next_tick) {
  Lab lab({2, 0, 0}, weightless(), true);
  const BodyId target = lab.add(ball(0.1, 0, 0, 1)), shot = lab.add(ball(0.1, -1, 900, 1));
  ASSERT_OK(sleep_body(lab.world, target));
  for (int tick = 0; tick < 3; ++tick) {
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.ccd.bodies_stopped, 2u);
    EXPECT_EQ(report.lost.impacts, 1u);
    EXPECT_FALSE(report.complete());
    EXPECT_LT(lab.motion(shot).position[0], -0.2);
    EXPECT_EQ(lab.motion(target).position[0], 0);
  }
}

DETENT_TEST(impact_stage, a_stack_that_is_struck_in_its_sleep_goes_on_with_its_contacts) {
  Lab lab({6, 20, 0}, {}, true);
  lab.add_ground();
  for (int i = 0; i < 4; ++i) lab.add_box(0.5, 0, 0.5 + i, 0);
  lab.run(240);
  BodyDef shot = ball(0.1, -8, 300, 0);
  shot.position = position(-8, 3.5, 0);
  lab.add(shot);
  uint32_t woke = 0;
  for (int tick = 0; tick < 60; ++tick) {
    // No contact is stored twice: load() checks that.
    std::vector<uint64_t> snapshot = lab.snapshot();
    Lab other({6, 20, 0});
    ASSERT_OK(load(other.world, bytes_of(snapshot), byte_count(snapshot)));
    const StepReport report = lab.run(1);
    if (woke == 4 && tick < 8) {
      EXPECT_GE(report.contacts.count, 3u);
    }
    woke += report.woke;
    other.run(1);
    ASSERT_EQ(digest(lab.world), digest(other.world)) << "tick " << tick;
  }
  EXPECT_EQ(woke, 4u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
