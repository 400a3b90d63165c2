#include "tests/tool/shrink/match.h"

/// What `detent shrink` leaves of matches of which two or three bodies matter.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr const char* k_none = "shows no ";

DETENT_TEST(shrink, lost_pairs_leave_the_bodies_that_meet) {
  Match match({64, 1, 0, true, 0, 0});  // room for two pairs
  match.add_bystanders(20);
  match.begin();
  match.step(5);
  const BodyId by = match.add({90.0, 0.0, 0.0});
  match.add({0.0, 0.0, 0.0});
  match.add({0.0, 0.25, 0.0});
  EXPECT_OK(match.recorder->set_user_data(by, 3));
  match.add({0.0, 0.5, 0.0});
  match.step(20);
  const ShrinkResult result = shrink_of(match.end(), FaultKind::lost);
  expect_sound(result, FaultKind::lost);
  EXPECT_EQ(result.shrunk.fault, "lost.pairs is 1");
  EXPECT_EQ(result.shrunk.tick, 6u);
  EXPECT_EQ(result.shrunk.tick_before, 6u);
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{1, 3, 0, 3}));
  EXPECT_EQ(result.shrunk.before.bodies, 24u);
  EXPECT_EQ(result.shrunk.before.calls, 5u);
  EXPECT_LE(result.shrunk.replays, 40u);
}

DETENT_TEST(shrink, what_is_lost_stays_the_same_counter) {
  Match match({64, 1, 0, true, 0, 0});  // room for two pairs and one contact
  match.add_bystanders(20);
  match.begin();
  EXPECT_OK(match.recorder->set_gravity({0.0, -100.0, 0.0}));
  match.step(5);
  for (const Coord z : {Coord(0.0), Coord(20.0)}) {
    match.add({0.0, 0.0, z});
    match.add({0.0, 0.75, z});
  }
  // Its speed is clamped from the same tick on.
  const BodyId fast = match.add({-90.0, 0.0, 0.0});
  EXPECT_OK(match.recorder->set_velocity(fast, {0.0, -16383.5, 0.0}, {0.0, 0.0, 0.0}));
  match.step(10);
  const std::string path = match.end();
  const ShrinkResult result = shrink_of(path, FaultKind::lost);
  expect_sound(result, FaultKind::lost);
  EXPECT_EQ(result.shrunk.fault, "lost.contacts is 1");
  EXPECT_EQ(result.shrunk.tick, 6u);
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{1, 4, 0, 4}));
  const ShrinkResult late = shrink_of(path, FaultKind::lost, {.reading = {.path = "", .from = 8}});
  EXPECT_EQ(late.shrunk.tick, 9u);
}

DETENT_TEST(shrink, a_deep_overlap_leaves_two_bodies_and_the_call_that_made_it) {
  Match match;
  match.add_bystanders(10);
  const BodyId a = match.add({0.0, 0.0, 0.0}), b = match.add({5.0, 0.0, 0.0});
  match.add_bystanders(10);
  match.begin();
  match.step(30);
  match.move(a, {0.0, 1.0, 0.0});
  match.step(2);
  match.move(b, {0.0, 1.125, 0.0});
  match.step(30);
  const std::string path = match.end();
  const ShrinkResult result = shrink_of(path, FaultKind::penetrates);
  expect_sound(result, FaultKind::penetrates);
  EXPECT_EQ(result.shrunk.tick, 33u);
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{1, 2, 0, 1}));
  EXPECT_EQ(result.shrunk.fault.substr(0, 29), "body 11 and body 12 overlap b");
  // The capacity fits: what is left takes few bytes.
  EXPECT_LT(result.shrunk.after.bytes, result.shrunk.before.bytes / 2);
  const ShrinkResult deep = shrink_of(path, FaultKind::penetrates, {.bound = 2});
  EXPECT_EQ(deep.outcome.problem, "shows no overlap of more than 2 of a body's thickness up to tick 62");
  EXPECT_EQ(deep.outcome.verdict, Verdict::bad);
}

DETENT_TEST(shrink, ticks_that_are_to_be_kept_stay_if_a_candidate_shows_the_fault_earlier) {
  Match match;
  const BodyId a = match.add({0.0, 0.0, 0.0}), b = match.add({5.0, 0.0, 0.0});
  match.begin();
  match.step(20);
  match.move(a, {0.0, 50.0, 0.0});
  match.step(1);
  match.move(b, {0.125, 0.0, 0.0});  // without the call before, it overlaps now
  match.step(1);
  match.move(a, {0.25, 0.0, 0.0});
  match.step(5);
  const std::string path = match.end();
  const ShrinkResult result = shrink_of(path, FaultKind::penetrates, {.lead_ticks = 2});
  expect_sound(result, FaultKind::penetrates, {.lead_ticks = 2});
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{3, 2, 0, 3}));
  EXPECT_EQ(shrink_of(path, FaultKind::penetrates).sizes(), (std::vector<uint64_t>{1, 2, 0, 1}));
}

DETENT_TEST(shrink, only_faults_of_the_body_and_after_the_tick_that_are_named_count) {
  Match match;
  BodyId bodies[6];
  for (int i = 0; i < 6; ++i) {
    Coord x = 0.0;
    EXPECT_OK(coord_from_host(5.0 * i, x));
    bodies[i] = match.add({x, 0.0, 0.0});
  }
  match.begin();
  match.step(4);
  match.move(bodies[0], {5.125, 0.0, 0.0});
  match.step(4);
  match.move(bodies[2], {15.125, 0.0, 0.0});
  match.step(4);
  match.move(bodies[4], {25.125, 0.0, 0.0});
  match.step(4);
  const std::string path = match.end();
  EXPECT_EQ(shrink_of(path, FaultKind::penetrates).shrunk.tick, 5u);
  const ShrinkRequest of_body = {.body = bodies[2].slot}, late = {.reading = {.path = "", .from = 10}};
  EXPECT_EQ(shrink_of(path, FaultKind::penetrates, of_body).shrunk.tick, 9u);
  // In what is written the bodies have other ids than in the recording, but not here: they are in its seed.
  expect_sound(shrink_of(path, FaultKind::penetrates, of_body), FaultKind::penetrates, of_body);
  EXPECT_EQ(shrink_of(path, FaultKind::penetrates, late).shrunk.tick, 11u);  // the second pair still overlaps
}

DETENT_TEST(shrink, an_open_joint_leaves_its_bodies) {
  Match match;
  match.add_bystanders(5);
  std::vector<BodyId> chain;
  for (int i = 0; i < 8; ++i) {
    Coord x = 0.0;
    EXPECT_OK(coord_from_host(2.0 * i, x));
    chain.push_back(match.add({x, 0.0, 0.0}));
  }
  for (size_t i = 1; i < chain.size(); ++i) {
    Coord x = 0.0;
    EXPECT_OK(coord_from_host(2.0 * static_cast<double>(i) - 1, x));
    match.join(chain[i - 1], chain[i], {x, 0.0, 0.0});
  }
  match.join(chain[7], chain[6], {13.0, 0.0, 0.0}, JointType::filter);
  match.begin();
  match.step(10);
  match.move(chain[7], {14.0, 3.0, 0.0});
  match.step(10);
  const std::string path = match.end();
  const ShrinkResult result = shrink_of(path, FaultKind::opens);
  expect_sound(result, FaultKind::opens);
  EXPECT_FALSE(shrink_of(path, FaultKind::opens, {.reading = {.path = "", .from = 20}}).good());
  EXPECT_EQ(result.shrunk.before.joints, 8u);
  EXPECT_EQ(result.shrunk.tick, 11u);
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{1, 2, 1, 1}));
  EXPECT_NE(result.shrunk.fault.find("of body 12 and body 13 is open by"), std::string::npos) << result.shrunk.fault;
}

DETENT_TEST(shrink, a_joint_without_a_fault_is_not_open) {
  for (const JointType type : {JointType::slider, JointType::distance, JointType::parallel, JointType::filter}) {
    Match match;
    const BodyId a = match.add({0.0, 0.0, 0.0}), b = match.add({2.0, 0.0, 0.0});
    match.join(a, b, {1.0, 0.0, 0.0}, type);
    match.begin();
    EXPECT_OK(match.recorder->set_velocity(b, {3.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));  // along the slider's axis
    match.step(30);
    const std::string problem = shrink_of(match.end(), FaultKind::opens).outcome.problem;
    EXPECT_EQ(problem.substr(0, strlen(k_none)), k_none) << static_cast<uint32_t>(type) << problem;
  }
}

/// A ball that flies at a thin wall.
std::string shot(bool continuous, const Filter& filter = {}) {
  Match match({64, 256, 0, true, 16, 0}, continuous);
  match.add_bystanders(7);
  match.add_box({0.0, -20.0, 0.0}, {50.0, 1.0, 50.0});
  match.add_box({10.0, 0.0, 0.0}, {0.0625, 3.0, 3.0});
  const BodyId ball = match.add({0.0, 0.0, 0.0});
  match.add_bystanders(7);
  EXPECT_OK(match.recorder->set_filter(ball, filter));
  match.begin();
  match.step(3);
  EXPECT_OK(match.recorder->set_velocity(ball, {250.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
  match.step(20);
  return match.end();
}

DETENT_TEST(shrink, a_shot_through_a_wall_leaves_the_ball_and_the_wall) {
  const std::string path = shot(false);
  const ShrinkResult result = shrink_of(path, FaultKind::tunnels);
  expect_sound(result, FaultKind::tunnels);
  EXPECT_EQ(result.shrunk.tick, 6u);
  EXPECT_EQ(result.sizes(), (std::vector<uint64_t>{1, 2, 0, 0}));
  EXPECT_EQ(result.shrunk.fault, "the centre of body 10 passes the surface of body 9, which is fixed");
  EXPECT_FALSE(shrink_of(path, FaultKind::tunnels, {.body = 9}).good());
  EXPECT_FALSE(shrink_of(path, FaultKind::tunnels, {.reading = {.path = "", .from = 6}}).good());
  // With two ticks before it, the call that set its speed is needed.
  const ShrinkResult with_lead = shrink_of(path, FaultKind::tunnels, {.lead_ticks = 3});
  EXPECT_EQ(with_lead.sizes(), (std::vector<uint64_t>{4, 2, 0, 1}));
}

DETENT_TEST(shrink, a_ball_that_stops_or_that_may_pass_does_not_tunnel) {
  const std::string problem = shrink_of(shot(true), FaultKind::tunnels).outcome.problem;
  EXPECT_EQ(problem, "shows no body whose centre passes the surface of a fixed body up to tick 23");
  EXPECT_EQ(shrink_of(shot(true), FaultKind::status).outcome.problem, "shows no call that is refused up to tick 23");
  EXPECT_EQ(shrink_of(shot(false, {.mask = 0}), FaultKind::tunnels).outcome.problem, problem);
  EXPECT_EQ(shrink_of(shot(false, {.category = 2, .mask = 2}), FaultKind::tunnels).outcome.problem, problem);
}

DETENT_TEST(shrink, only_the_surface_of_a_fixed_body_from_the_outside_counts) {
  Match match({64, 256, 0, true, 16, 0}, false);
  match.add_box({0.0, 0.0, 0.0}, {5.0, 5.0, 5.0});
  const BodyId inside = match.add({0.0, 0.0, 0.0}), through = match.add({20.0, 0.0, 0.0});
  match.add({30.0, 0.0, 0.0}, BodyType::dynamic, box({0.125, 3.0, 3.0}));
  match.add({40.0, 0.0, 0.0}, BodyType::kinematic, box({0.125, 3.0, 3.0}));
  match.begin();
  EXPECT_OK(match.recorder->set_velocity(inside, {0.0, 6.0, 0.0}, {0.0, 0.0, 0.0}));
  EXPECT_OK(match.recorder->set_velocity(through, {250.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
  match.step(20);
  // A call takes it into the box.
  match.move(through, {4.0, 0.0, 0.0});
  match.step(1);
  const std::string problem = shrink_of(match.end(), FaultKind::tunnels).outcome.problem;
  EXPECT_EQ(problem, "shows no body whose centre passes the surface of a fixed body up to tick 21");
}

/// A kinematic box presses a ball into a fixed box: it takes a second.
std::string press() {
  Match match({64, 256, 0, true, 16, 0}, false);
  match.add_bystanders(4);
  match.add_box({2.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  match.add({0.5, 0.0, 0.0});
  const BodyId pusher = match.add({-1.0, 0.0, 0.0}, BodyType::kinematic, box({1.0, 1.0, 1.0}));
  match.begin();
  match.step(10);
  EXPECT_OK(match.recorder->set_velocity(pusher, {1.5, 0.0, 0.0}, {0.0, 0.0, 0.0}));
  match.step(90);
  return match.end();
}

DETENT_TEST(shrink, the_start_does_not_show_the_beginning_of_the_fault) {
  const std::string path = press();
  for (const FaultKind kind : {FaultKind::penetrates, FaultKind::tunnels}) {
    const ShrinkResult result = shrink_of(path, kind);
    expect_sound(result, kind);
    EXPECT_EQ(result.shrunk.after.bodies, 3u);
    EXPECT_GE(result.shrunk.after.ticks, 5u);
    EXPECT_LT(result.shrunk.after.ticks, result.shrunk.before.ticks);
  }
}

DETENT_TEST(shrink, a_limit_of_replays_leaves_what_shows_the_fault) {
  const std::string path = shot(false);
  for (uint32_t limit = 1; limit < 12; ++limit) {
    const ShrinkResult result = shrink_of(path, FaultKind::tunnels, {.replays_max = limit});
    ASSERT_TRUE(result.good()) << limit;
    EXPECT_LE(result.shrunk.replays, limit);
    EXPECT_TRUE(result.shrunk.limit_reached);
    EXPECT_EQ(verify({result.path}, k_no_progress).problem, "");
  }
}

DETENT_TEST(shrink, a_damaged_recording_is_shrunk_as_far_as_it_is_whole) {
  const std::string path = shot(false);
  const std::vector<uint8_t> whole = bytes_of_file(path);
  const std::string cut = Match::path_of("cut.rec");
  const auto write_cut = [&](size_t count, size_t flipped) {
    std::vector<uint8_t> bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(count));
    if (flipped < count) bytes[flipped] ^= 0x10;
    std::ofstream(cut, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(count));
  };
  size_t good = 0;
  for (size_t count = 0; count < whole.size(); count += count < 200 ? 7 : 997) {
    write_cut(count, SIZE_MAX);
    for (const FaultKind kind : {FaultKind::tunnels, FaultKind::differs}) {
      const ShrinkResult result = shrink_of(cut, kind);
      EXPECT_NE(result.good(), !result.outcome.problem.empty()) << count;
    }
  }
  for (size_t back = 1; back < 60; back += 3) {  // within the end
    write_cut(whole.size() - back, SIZE_MAX);
    const ShrinkResult result = shrink_of(cut, FaultKind::tunnels);
    if (!result.good()) {
      EXPECT_NE(result.outcome.problem.find("truncated at byte"), std::string::npos) << result.outcome.problem;
      EXPECT_NE(result.outcome.problem.find("shows no body"), std::string::npos) << result.outcome.problem;
    }
    if (result.good()) ++good;
  }
  EXPECT_GT(good, 0u);
  for (size_t at = 0; at < whole.size(); at += at < 200 ? 5 : 1009) {
    write_cut(whole.size(), at);
    const ShrinkResult result = shrink_of(cut, FaultKind::tunnels);
    EXPECT_NE(result.good(), !result.outcome.problem.empty()) << at;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
