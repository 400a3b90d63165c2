#include "chunks.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Features k_balls = Features::sphere | Features::half_space;

struct Made {
  std::vector<uint64_t> words;
  World world;

  explicit Made(const FeatureTable& features) {
    WorldDef def;
    def.capacity = {4, 8, 0};
    def.continuous = def.sleeping = false;
    words.resize(world_bytes(def.capacity) / 8);
    EXPECT_EQ(
        create_world(reinterpret_cast<uint8_t*>(words.data()), world_bytes(def.capacity), def, {}, features, world),
        Status::ok);
  }
};

/// Records a ball that falls, and after some ticks another shape.
Bytes record_with(const FeatureTable& features, const Shape& later) {
  Made made(features);
  MemorySink memory;
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(made.world, memory.sink(), buffer, sizeof buffer);
  BodyDef ball;
  ball.shape = sphere(Real(0.5));
  BodyId id;
  EXPECT_EQ(recorder.begin(), Status::ok);
  EXPECT_EQ(recorder.create_body(ball, id), Status::ok);
  for (int tick = 0; tick < 5; ++tick) recorder.step();
  BodyDef other;
  other.shape = later;
  EXPECT_EQ(recorder.create_body(other, id), Status::ok);
  for (int tick = 0; tick < 5; ++tick) recorder.step();
  EXPECT_EQ(recorder.end(), Status::ok);
  return memory.bytes;
}

ReplayError replay_with(const FeatureTable& features, const Bytes& recording) {
  Made made(features);
  MemorySource memory{&recording};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(memory.source(), buffer, sizeof buffer);
  TickResult result;
  Status status = player.open();
  if (status == Status::ok) status = player.start(made.world);
  while (status == Status::ok && !result.finished) status = player.next_tick(made.world, result);
  return player.error();
}

DETENT_TEST(replay_features, a_recording_is_replayed_by_a_world_that_has_all_that_its_own_had) {
  const Bytes lean = record_with(feature_table<k_balls>, sphere(Real(0.25)));
  EXPECT_EQ(replay_with(feature_table<k_balls>, lean).status, Status::ok);
  EXPECT_EQ(replay_with(feature_table<k_balls | Features::box>, lean).status, Status::ok);
  EXPECT_EQ(replay_with(feature_table<Features::all>, lean).status, Status::ok);
}

DETENT_TEST(replay_features, a_recording_of_a_world_that_had_more_is_refused_at_its_seed) {
  const Bytes all = record_with(feature_table<Features::all>, sphere(Real(0.25)));
  const ReplayError error = replay_with(feature_table<k_balls>, all);
  EXPECT_EQ(error.status, Status::feature_missing);
  EXPECT_STREQ(error.field, "seed");
  EXPECT_EQ(replay_with(feature_table<Features::all>, all).status, Status::ok);
}

DETENT_TEST(replay_features, a_call_that_needs_what_its_seed_had_not_is_refused_by_name) {
  Bytes lean = record_with(feature_table<k_balls | Features::box>, box({0.5, 0.5, 0.5}));
  Parts parts = take_apart(lean);
  // The seed chunk then states that the feature `box` was left out.
  parts.chunks[0].payload[28] |= static_cast<uint8_t>(Features::box);
  const ReplayError error = replay_with(feature_table<k_balls>, put_together(parts));
  EXPECT_EQ(error.status, Status::feature_missing);
  EXPECT_STREQ(error.field, "call");
  EXPECT_EQ(error.tick, 5u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
