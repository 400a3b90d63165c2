#include "match.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

struct Opened {
  MemorySource memory;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player;
  explicit Opened(const Bytes& bytes) : memory{&bytes}, player(memory.source(), buffer, sizeof buffer) {
    EXPECT_EQ(player.open(), Status::ok);
  }
};

/// The canonical state of the scene after `ticks` ticks.
Bytes saved_at(const Bytes& recording, uint64_t ticks) {
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(opened.player.start(owned.world), Status::ok);
  TickResult result;
  while (get_info(owned.world).tick < ticks) EXPECT_EQ(opened.player.next_tick(owned.world, result), Status::ok);
  Bytes bytes(snapshot_bytes(opened.player.info().capacity));
  EXPECT_EQ(save(owned.world, bytes.data(), static_cast<uint32_t>(bytes.size())), Status::ok);
  return bytes;
}

Replay continue_from(const Bytes& recording, const Bytes& state) {
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(restore(owned.world, state.data(), static_cast<uint32_t>(state.size())), Status::ok);
  Replay outcome;
  Status status = opened.player.start_at(owned.world);
  while (status == Status::ok && !outcome.finished) {
    TickResult result;
    status = opened.player.next_tick(owned.world, result);
    if (status != Status::ok) break;
    outcome.finished = result.finished;
    if (!result.finished) ++outcome.ticks;
  }
  outcome.error = opened.player.error();
  return outcome;
}

}  // namespace

DETENT_TEST(player, the_header_says_what_was_recorded) {
  const Bytes recording = record_small(2, {5});
  const Opened opened(recording);
  const RecordingInfo& info = opened.player.info();
  EXPECT_EQ(info.format_version, k_recording_format_version);
  EXPECT_EQ(info.simulation_version, k_simulation_version);
  EXPECT_EQ(info.config, k_config);
  EXPECT_TRUE((info.capacity == Capacity{3, 3, 0}));
  EXPECT_EQ(info.digest_interval, 5u);
  EXPECT_EQ(info.tick, 0u);
  EXPECT_EQ(info.snapshot_bytes, snapshot_bytes(info.capacity));
}

DETENT_TEST(player, a_digest_is_compared_at_each_multiple_of_the_interval) {
  EXPECT_EQ(replay(record_small(20, {1})).compared, 20u);
  EXPECT_EQ(replay(record_small(20, {6})).compared, 3u);
  const Replay only_last = replay(record_small(20, {0}));
  EXPECT_EQ(only_last.compared, 0u);
  EXPECT_TRUE(only_last.finished);
}

DETENT_TEST(player, a_state_that_differs_is_found_in_the_tick_it_differs) {
  const Bytes recording = record_small(20);
  for (uint64_t tick = 0; tick < 20; ++tick) {
    ReplayError errors[2];
    for (uint32_t data = 1; data <= 2; ++data) {
      const Replay outcome = replay(recording, [tick, data](World& world, uint64_t now) {
        if (now == tick) {
          EXPECT_EQ(set_user_data(world, next_body(world, {}), data), Status::ok);
        }
      });
      errors[data - 1] = outcome.error;
      EXPECT_EQ(outcome.error.status, Status::digest_differs);
      EXPECT_EQ(outcome.error.tick, tick + 1);
      EXPECT_STREQ(outcome.error.field, "digest");
      EXPECT_NE(outcome.error.digest_recorded, outcome.error.digest_replayed);
    }
    EXPECT_EQ(errors[0].digest_recorded, errors[1].digest_recorded);
    EXPECT_NE(errors[0].digest_replayed, errors[1].digest_replayed);
  }
}

DETENT_TEST(player, a_state_that_differs_after_the_last_tick_is_found_at_the_end) {
  const Replay outcome = replay(record_small(4), [](World& world, uint64_t now) {
    if (now == 4) {
      EXPECT_EQ(set_user_data(world, next_body(world, {}), 1), Status::ok);
    }
  });
  EXPECT_EQ(outcome.ticks, 4u);
  EXPECT_FALSE(outcome.finished);
  EXPECT_EQ(outcome.error.status, Status::digest_differs);
  EXPECT_STREQ(outcome.error.field, "final digest");
}

DETENT_TEST(player, a_call_that_this_world_refuses_is_a_difference) {
  const Replay outcome = replay(record_small(1, {0}), [](World& world, uint64_t now) {
    if (now == 1) {
      EXPECT_EQ(destroy_body(world, {2, 1}), Status::ok);
    }  // the body that the last call names
  });
  EXPECT_EQ(outcome.error.status, Status::digest_differs);
  EXPECT_STREQ(outcome.error.field, "call refused");
}

DETENT_TEST(player, another_id_than_the_recorded_one_is_a_difference) {
  const Replay outcome = replay(record_small(3, {0}), [](World& world, uint64_t now) {
    if (now == 1) {
      EXPECT_EQ(destroy_body(world, {1, 1}), Status::ok);  // the next body gets its slot
    }
  });
  EXPECT_EQ(outcome.error.status, Status::digest_differs);
  EXPECT_EQ(outcome.error.tick, 1u);
  EXPECT_STREQ(outcome.error.field, "body id given");
}

DETENT_TEST(player, skipping_reads_all_of_it_without_a_world) {
  const Bytes recording = record_scene(*find_scene("traffic"), 50);
  Opened opened(recording);
  TickResult result;
  uint64_t ticks = 0;
  for (;; ++ticks) {
    ASSERT_EQ(opened.player.skip_tick(result), Status::ok) << opened.player.error().field;
    if (result.finished) break;
    EXPECT_EQ(result.tick, ticks + 1);
    EXPECT_TRUE(result.compared);
  }
  EXPECT_EQ(ticks, 50u);
  EXPECT_EQ(opened.player.bytes_read(), recording.size());
  EXPECT_EQ(result.digest, replay(recording).digest);
}

DETENT_TEST(player, a_saved_state_continues_from_every_tick) {
  const Bytes recording = record_scene(*find_scene("traffic"), 50);
  for (uint64_t tick = 0; tick <= 50; tick += 10) {
    const Replay outcome = continue_from(recording, saved_at(recording, tick));
    EXPECT_TRUE(outcome.finished) << outcome.error.field;
    EXPECT_EQ(outcome.ticks, 50 - tick);
  }
}

DETENT_TEST(player, a_saved_state_from_outside_the_recording_is_refused) {
  const Bytes longer = record_scene(*find_scene("tiny"), 20);
  const Bytes shorter = record_scene(*find_scene("tiny"), 10);
  EXPECT_EQ(continue_from(shorter, saved_at(longer, 15)).error.status, Status::out_of_range);

  Recording late(find_scene("tiny")->world());
  find_scene("tiny")->build(late.recorder);
  play_scene(late.recorder, *find_scene("tiny"), 5);
  EXPECT_EQ(late.recorder.begin(), Status::ok);
  EXPECT_EQ(late.recorder.end(), Status::ok);
  EXPECT_EQ(continue_from(late.memory.bytes, saved_at(longer, 3)).error.status, Status::out_of_range);
}

DETENT_TEST(player, a_saved_state_that_differs_is_refused_before_it_goes_on) {
  const Bytes recording = record_scene(*find_scene("stack"), 20);
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  for (uint32_t tick = 0; tick < 7; ++tick) step(owned.world);
  EXPECT_EQ(opened.player.start_at(owned.world), Status::digest_differs);
  EXPECT_EQ(opened.player.error().tick, 7u);
}

DETENT_TEST(player, a_recording_may_begin_in_the_middle_of_a_match) {
  const Scene& scene = *find_scene("stack");
  Recording recording(scene.world());
  scene.build(recording.recorder);
  play_scene(recording.recorder, scene, 30);
  EXPECT_EQ(recording.recorder.begin(), Status::ok);
  play_scene(recording.recorder, scene, 30);
  EXPECT_EQ(recording.recorder.end(), Status::ok);
  const Replay outcome = replay(recording.memory.bytes);
  EXPECT_TRUE(outcome.finished) << outcome.error.field;
  EXPECT_EQ(outcome.ticks, 30u);
}

DETENT_TEST(player, a_world_of_another_capacity_is_refused) {
  const Bytes recording = record_small(2);
  for (const Capacity capacity : {Capacity{4, 3, 0}, Capacity{3, 4, 0}, Capacity{3, 3, 1}}) {
    Opened opened(recording);
    OwnedWorld owned(capacity);
    EXPECT_EQ(opened.player.start(owned.world), Status::capacity_differs);
    EXPECT_STREQ(opened.player.error().field, "capacity");
  }
}

DETENT_TEST(player, calls_out_of_their_order_are_refused) {
  const Bytes recording = record_small(2);
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  TickResult result;
  EXPECT_EQ(opened.player.open(), Status::bad_argument);
  EXPECT_EQ(opened.player.next_tick(owned.world, result), Status::bad_argument);
  EXPECT_EQ(opened.player.start(owned.world), Status::ok);
  EXPECT_EQ(opened.player.start(owned.world), Status::bad_argument);
  for (uint32_t tick = 0; tick < 3; ++tick) EXPECT_EQ(opened.player.next_tick(owned.world, result), Status::ok);
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(opened.player.next_tick(owned.world, result), Status::bad_argument);
}

DETENT_TEST(player, a_failing_source_is_reported_and_stays) {
  const auto broken = [](void*, uint8_t*, uint32_t, uint32_t&) { return Status::sink_failed; };
  uint8_t buffer[k_recording_buffer_bytes];
  Player player({broken, nullptr}, buffer, sizeof buffer);
  EXPECT_EQ(player.open(), Status::sink_failed);
  EXPECT_EQ(player.open(), Status::sink_failed);
  Player small({broken, nullptr}, buffer, sizeof buffer - 1);
  EXPECT_EQ(small.open(), Status::buffer_too_small);
  Player none({}, buffer, sizeof buffer);
  EXPECT_EQ(none.open(), Status::bad_argument);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
