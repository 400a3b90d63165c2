#include "match.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_TEST(recorder, a_recorded_scene_replays_with_every_digest_equal) {
  uint32_t count = 0;
  const Scene* all = scenes(count);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t ticks = all[i].ticks < 60 ? all[i].ticks : 60;
    const Replay outcome = replay(record_scene(all[i], ticks));
    EXPECT_TRUE(outcome.finished) << all[i].name << ": " << outcome.error.field;
    EXPECT_EQ(outcome.ticks, ticks) << all[i].name;
    EXPECT_EQ(outcome.compared, ticks) << all[i].name;
  }
}

DETENT_TEST(recorder, the_same_match_gives_the_same_bytes) {
  const Scene& scene = *find_scene("traffic");
  EXPECT_EQ(record_scene(scene, 50), record_scene(scene, 50));
}

DETENT_TEST(recorder, without_a_sink_the_world_goes_the_same_way) {
  const Scene& scene = *find_scene("traffic");
  Recording recorded(scene.world());
  Recording plain(scene.world(), false);
  Recorder bare(plain.owned.world, {}, nullptr, 0);
  for (Recorder* recorder : {&recorded.recorder, &bare}) {
    scene.build(*recorder);
    EXPECT_EQ(recorder->begin(), Status::ok);
    play_scene(*recorder, scene, 90);
    EXPECT_EQ(recorder->end(), Status::ok);
  }
  EXPECT_EQ(digest(recorded.owned.world), digest(plain.owned.world));
  EXPECT_FALSE(recorded.memory.bytes.empty());
}

DETENT_TEST(recorder, a_call_that_fails_is_not_logged) {
  const auto match = [](bool with_failures) {
    Recording recording(OwnedWorld::def_of({2, 1, 0}));
    Recorder& recorder = recording.recorder;
    EXPECT_EQ(recorder.begin(), Status::ok);
    BodyId id;
    EXPECT_EQ(recorder.create_body({}, id), Status::ok);
    if (with_failures) {
      EXPECT_EQ(recorder.destroy_body({}), Status::bad_id);
      EXPECT_EQ(recorder.set_user_data({1, 99}, 1), Status::bad_id);
      EXPECT_EQ(recorder.bind_asset(0), Status::out_of_range);
      BodyDef def;
      def.type = static_cast<BodyType>(9);
      BodyId untouched = {5, 6};
      EXPECT_EQ(recorder.create_body(def, untouched), Status::bad_argument);
      EXPECT_TRUE((untouched == BodyId{5, 6}));
    }
    recorder.step();
    EXPECT_EQ(recorder.end(), Status::ok);
    return recording.memory.bytes;
  };
  EXPECT_EQ(match(true), match(false));
}

DETENT_TEST(recorder, a_failing_sink_is_reported_and_disturbs_nothing) {
  const Scene& scene = *find_scene("tiny");
  constexpr uint32_t k_ticks = 40;
  Recording whole(scene.world());
  scene.build(whole.recorder);
  EXPECT_EQ(whole.recorder.begin(), Status::ok);
  play_scene(whole.recorder, scene, k_ticks);
  EXPECT_EQ(whole.recorder.end(), Status::ok);
  for (uint32_t writes_max = 0; writes_max < whole.memory.writes; ++writes_max) {
    Recording broken(scene.world());
    broken.memory.writes_max = writes_max;
    scene.build(broken.recorder);
    const Status begun = broken.recorder.begin();
    EXPECT_EQ(begun, broken.recorder.status());
    play_scene(broken.recorder, scene, k_ticks);
    EXPECT_EQ(broken.recorder.end(), Status::sink_failed);
    EXPECT_EQ(broken.recorder.status(), Status::sink_failed);
    EXPECT_EQ(broken.recorder.flush(), Status::sink_failed);
    EXPECT_EQ(broken.memory.writes, writes_max + 1) << "nothing is written after a failure";
    EXPECT_EQ(digest(broken.owned.world), digest(whole.owned.world));
    EXPECT_TRUE(std::equal(broken.memory.bytes.begin(), broken.memory.bytes.end(), whole.memory.bytes.begin()));
  }
}

DETENT_TEST(recorder, a_sink_is_given_at_most_a_chunk_at_a_time_and_a_chunk_a_flush) {
  struct Sizes {
    std::vector<uint32_t> writes;
    static Status write(void* context, const uint8_t*, uint32_t count) {
      static_cast<Sizes*>(context)->writes.push_back(count);
      return Status::ok;
    }
  } sizes;
  OwnedWorld owned(find_scene("traffic")->world());
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(owned.world, {Sizes::write, &sizes}, buffer, sizeof buffer);
  find_scene("traffic")->build(recorder);
  EXPECT_EQ(recorder.begin({1, 20}), Status::ok);
  play_scene(recorder, *find_scene("traffic"), 100);
  EXPECT_EQ(recorder.flush(), Status::ok);
  for (const uint32_t count : sizes.writes) EXPECT_LE(count, 532u);
  sizes.writes.clear();
  recorder.step();
  EXPECT_TRUE(sizes.writes.empty());
  EXPECT_EQ(recorder.flush(), Status::ok);
  EXPECT_EQ(sizes.writes, std::vector<uint32_t>{29}) << "a tag, a digest, and the chunk's frame";
}

DETENT_TEST(recorder, a_small_buffer_and_a_second_begin_are_refused) {
  OwnedWorld owned(Capacity{1, 0, 0});
  MemorySink memory;
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder small(owned.world, memory.sink(), buffer, k_recording_buffer_bytes - 1);
  EXPECT_EQ(small.begin(), Status::buffer_too_small);
  EXPECT_EQ(small.end(), Status::buffer_too_small);
  EXPECT_TRUE(memory.bytes.empty());

  Recorder recorder(owned.world, memory.sink(), buffer, sizeof buffer);
  EXPECT_EQ(recorder.begin(), Status::ok);
  EXPECT_EQ(recorder.begin(), Status::bad_argument);
  EXPECT_EQ(recorder.status(), Status::ok);
  EXPECT_EQ(recorder.end(), Status::ok);
  EXPECT_EQ(recorder.begin(), Status::bad_argument);
}

DETENT_TEST(recorder, after_the_end_calls_apply_and_nothing_is_written) {
  Recording recording(OwnedWorld::def_of({1, 0, 0}));
  EXPECT_EQ(recording.recorder.begin(), Status::ok);
  EXPECT_EQ(recording.recorder.end(), Status::ok);
  const size_t written = recording.memory.bytes.size();
  BodyId id;
  EXPECT_EQ(recording.recorder.create_body({}, id), Status::ok);
  recording.recorder.step();
  EXPECT_EQ(recording.recorder.end(), Status::ok);
  EXPECT_EQ(recording.memory.bytes.size(), written);
  EXPECT_EQ(get_info(recording.owned.world).tick, 1u);
}

DETENT_TEST(recorder, flushed_ticks_survive_a_missing_end) {
  const Scene& scene = *find_scene("tiny");
  Recording recording(scene.world());
  scene.build(recording.recorder);
  EXPECT_EQ(recording.recorder.begin(), Status::ok);
  play_scene(recording.recorder, scene, 3);
  EXPECT_EQ(recording.recorder.flush(), Status::ok);
  play_scene(recording.recorder, scene, 3);
  const Replay outcome = replay(recording.memory.bytes);
  EXPECT_EQ(outcome.error.status, Status::truncated);
  EXPECT_EQ(outcome.ticks, 3u);
}

#if !DETENT_FIXED
DETENT_TEST(recorder, a_negative_zero_replays) {
  Recording recording(OwnedWorld::def_of({1, 0, 0}));
  EXPECT_EQ(recording.recorder.begin(), Status::ok);
  BodyDef def;
  def.linear_velocity.x = Real(-0.0);
  def.shape.half_length = Real(-0.0);
  BodyId id;
  EXPECT_EQ(recording.recorder.create_body(def, id), Status::ok);
  recording.recorder.step();
  EXPECT_EQ(recording.recorder.end(), Status::ok);
  EXPECT_TRUE(replay(recording.memory.bytes).finished);
}

DETENT_TEST(recorder, not_a_number_is_refused_in_a_field_that_the_shape_does_not_use) {
  Recording recording(OwnedWorld::def_of({1, 0, 0}));
  BodyDef def;
  def.shape = sphere(Real(1.0));
  def.shape.half_extents.y = __builtin_nanf("");
  BodyId id;
  EXPECT_EQ(recording.recorder.create_body(def, id), Status::out_of_range);
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
