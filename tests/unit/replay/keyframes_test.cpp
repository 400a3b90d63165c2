#include <stdlib.h>

#include "chunks.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr uint32_t k_keyframe = static_cast<uint32_t>(ChunkType::keyframe);

struct Opened {
  MemorySource memory;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player;
  explicit Opened(const Bytes& bytes, bool seekable = true)
      : memory{&bytes}, player(seekable ? memory.seekable_source() : memory.source(), buffer, sizeof buffer) {
    EXPECT_EQ(player.open(), Status::ok);
  }
};

/// The digest of the state after each tick of the recording, from its seed on.
std::vector<uint64_t> digests_of(const Bytes& recording) {
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(opened.player.start(owned.world), Status::ok);
  std::vector<uint64_t> digests = {digest(owned.world)};
  for (TickResult result;;) {
    EXPECT_EQ(opened.player.next_tick(owned.world, result), Status::ok) << opened.player.error().field;
    if (result.finished || opened.player.error().status != Status::ok) return digests;
    digests.push_back(digest(owned.world));
  }
}

std::vector<uint64_t> keyframe_ticks(const Parts& parts) {
  std::vector<uint64_t> ticks;
  for (const Chunk& chunk : parts.chunks) {
    if (chunk.type == k_keyframe && (ticks.empty() || ticks.back() != chunk.tick)) ticks.push_back(chunk.tick);
  }
  return ticks;
}

uint32_t first_keyframe(const Parts& parts) {
  uint32_t index = 0;
  while (parts.chunks[index].type != k_keyframe) ++index;
  return index;
}

/// Checks that go_to() fails on `changed` with this status and field.
void expect_go_to_fails(const Bytes& changed, uint64_t tick, Status status, const char* field) {
  Opened opened(changed);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(opened.player.go_to(owned.world, tick), status) << field;
  EXPECT_STREQ(opened.player.error().field, field);
}

}  // namespace

DETENT_TEST(keyframes, one_comes_after_each_tick_that_is_a_multiple_of_the_interval) {
  EXPECT_EQ(keyframe_ticks(take_apart(record_small(20, {1, 6}))), (std::vector<uint64_t>{6, 12, 18}));
  EXPECT_EQ(keyframe_ticks(take_apart(record_small(20, {0, 20}))), (std::vector<uint64_t>{20}));
  EXPECT_TRUE(keyframe_ticks(take_apart(record_small(20, {1, 0}))).empty());
  const Bytes recording = record_small(4, {1, 6});
  EXPECT_EQ(Opened(recording).player.info().keyframe_interval, 6u);
}

DETENT_TEST(keyframes, a_keyframe_holds_the_digest_and_the_snapshot_of_its_tick) {
  const Bytes recording = record_small(12, {1, 4});
  const Parts parts = take_apart(recording);
  Bytes held;
  for (const Chunk& chunk : parts.chunks) {
    if (chunk.type == k_keyframe && chunk.tick == 8)
      held.insert(held.end(), chunk.payload.begin(), chunk.payload.end());
  }
  Opened opened(recording, false);
  OwnedWorld owned(opened.player.info().capacity);
  ASSERT_EQ(opened.player.start(owned.world), Status::ok);
  TickResult result;
  while (get_info(owned.world).tick < 8) ASSERT_EQ(opened.player.next_tick(owned.world, result), Status::ok);
  Bytes expected;
  append(expected, digest(owned.world), 8);
  Bytes state(snapshot_bytes(opened.player.info().capacity));
  ASSERT_EQ(save(owned.world, state.data(), static_cast<uint32_t>(state.size())), Status::ok);
  expected.insert(expected.end(), state.begin(), state.end());
  EXPECT_EQ(held, expected);
}

DETENT_TEST(keyframes, without_them_the_recording_is_the_same_but_for_its_header_and_numbers) {
  const Parts with = take_apart(record_small(20, {1, 7}));
  const Parts without = take_apart(record_small(20, {1, 0}));
  const auto calls_of = [](const Parts& parts) {
    Bytes calls;
    for (const Chunk& chunk : parts.chunks) {
      if (chunk.type != k_keyframe) calls.insert(calls.end(), chunk.payload.begin(), chunk.payload.end());
    }
    return calls;
  };
  EXPECT_EQ(calls_of(with), calls_of(without));
}

DETENT_TEST(keyframes, a_replay_that_passes_one_of_another_state_stops_there) {
  Parts parts = take_apart(record_small(20, {0, 7}));
  const uint32_t index = first_keyframe(parts);
  parts.chunks[index].payload[3] ^= 1;
  const Replay outcome = replay(put_together(parts));
  EXPECT_EQ(outcome.error.status, Status::digest_differs);
  EXPECT_STREQ(outcome.error.field, "keyframe digest");
  EXPECT_EQ(outcome.error.tick, 7u);
}

DETENT_TEST(keyframes, every_tick_is_reached_forwards_and_back) {
  for (const uint32_t interval : {0u, 1u, 7u, 40u}) {
    const Bytes recording = record_scene(*find_scene("traffic"), 40, {1, interval});
    const std::vector<uint64_t> expected = digests_of(recording);
    ASSERT_EQ(expected.size(), 41u);
    Opened opened(recording);
    OwnedWorld owned(opened.player.info().capacity);
    const uint32_t ticks[] = {13, 13, 14, 39, 3, 0, 40, 7, 6, 8, 28, 1};
    for (const uint32_t tick : ticks) {
      ASSERT_EQ(opened.player.go_to(owned.world, tick), Status::ok) << opened.player.error().field;
      EXPECT_EQ(get_info(owned.world).tick, tick);
      EXPECT_EQ(digest(owned.world), expected[tick]) << "interval " << interval << ", tick " << tick;
    }
    TickResult result;
    for (uint32_t tick = 2; tick <= 40; ++tick) {
      ASSERT_EQ(opened.player.next_tick(owned.world, result), Status::ok) << opened.player.error().field;
      EXPECT_EQ(result.digest, expected[tick]);
    }
    ASSERT_EQ(opened.player.next_tick(owned.world, result), Status::ok);
    EXPECT_TRUE(result.finished);
    EXPECT_EQ(opened.player.go_to(owned.world, 20), Status::ok) << "back from the end";
    EXPECT_EQ(digest(owned.world), expected[20]);
  }
}

DETENT_TEST(keyframes, what_lies_before_the_last_keyframe_is_hopped_over) {
  const Bytes recording = record_scene(*find_scene("traffic"), 200, {1, 50});
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(opened.player.go_to(owned.world, 150), Status::ok);
  const uint32_t state = opened.player.info().snapshot_bytes;
  EXPECT_LT(opened.memory.given, state + recording.size() / 8) << "one state, and headers";
}

DETENT_TEST(keyframes, without_a_seek_a_replay_goes_forward_only) {
  const Bytes recording = record_small(20, {1, 6});
  const std::vector<uint64_t> expected = digests_of(recording);
  Opened opened(recording, false);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(opened.player.go_to(owned.world, 9), Status::ok);
  EXPECT_EQ(digest(owned.world), expected[9]);
  EXPECT_EQ(opened.player.go_to(owned.world, 8), Status::out_of_range);
  EXPECT_EQ(digest(owned.world), expected[9]);
  EXPECT_EQ(opened.player.go_to(owned.world, 20), Status::ok);
  EXPECT_EQ(digest(owned.world), expected[20]);
  EXPECT_EQ(opened.player.go_to(owned.world, 21), Status::out_of_range);
  EXPECT_EQ(opened.player.error().status, Status::ok);
}

DETENT_TEST(keyframes, a_tick_outside_the_recording_changes_nothing) {
  Recording late(find_scene("tiny")->world());
  find_scene("tiny")->build(late.recorder);
  play_scene(late.recorder, *find_scene("tiny"), 5);
  EXPECT_EQ(late.recorder.begin({1, 4}), Status::ok);
  play_scene(late.recorder, *find_scene("tiny"), 10);
  EXPECT_EQ(late.recorder.end(), Status::ok);
  const Bytes& recording = late.memory.bytes;
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  EXPECT_EQ(opened.player.go_to(owned.world, 16), Status::out_of_range) << "as the first of all";
  EXPECT_EQ(opened.player.go_to(owned.world, 9), Status::ok);
  const uint64_t before = digest(owned.world);
  EXPECT_EQ(opened.player.go_to(owned.world, 4), Status::out_of_range);
  EXPECT_EQ(opened.player.go_to(owned.world, 16), Status::out_of_range);
  EXPECT_EQ(digest(owned.world), before);
  TickResult result;
  for (uint64_t tick = 10; tick <= 15; ++tick) {
    ASSERT_EQ(opened.player.next_tick(owned.world, result), Status::ok) << opened.player.error().field;
    EXPECT_EQ(result.tick, tick);
  }
  EXPECT_EQ(opened.player.go_to(owned.world, 5), Status::ok);
}

DETENT_TEST(keyframes, a_world_that_is_not_the_replays_is_not_played_on) {
  const Bytes recording = record_small(20, {1, 6});
  Opened opened(recording);
  OwnedWorld owned(opened.player.info().capacity);
  TickResult result;
  for (uint32_t tick = 0; tick < 4; ++tick) ASSERT_EQ(opened.player.skip_tick(result), Status::ok);
  EXPECT_EQ(opened.player.go_to(owned.world, 5), Status::ok) << opened.player.error().field;
  EXPECT_EQ(digest(owned.world), digests_of(recording)[5]);
}

DETENT_TEST(keyframes, one_of_the_wrong_length_tick_or_place_is_refused) {
  const Parts parts = take_apart(record_small(20, {1, 6}));
  const uint32_t first = first_keyframe(parts);
  uint32_t last = first;
  while (parts.chunks[last + 1].type == k_keyframe) ++last;

  Parts changed = parts;
  changed.chunks[last].payload.push_back(0);
  EXPECT_EQ(replay(put_together(changed)).error.status, Status::corrupt);
  expect_go_to_fails(put_together(changed), 7, Status::corrupt, "state length");
  changed = parts;
  changed.chunks[first].payload.resize(7);
  EXPECT_STREQ(replay(put_together(changed)).error.field, "state length");
  expect_go_to_fails(put_together(changed), 7, Status::corrupt, "state length");
  changed = parts;
  erase_at(changed.chunks, last);
  EXPECT_STREQ(replay(put_together(changed)).error.field, "chunk order");
  changed = parts;
  changed.header[64] = 5;  // the keyframe interval
  EXPECT_STREQ(replay(put_together(changed)).error.field, "keyframe tick");
  expect_go_to_fails(put_together(changed), 7, Status::corrupt, "keyframe tick");
  changed = parts;
  insert_at(changed.chunks, 0, parts.chunks[first]);
  changed.chunks[0].tick = 0;
  EXPECT_STREQ(replay(put_together(changed)).error.field, "chunk order");
}

DETENT_TEST(keyframes, one_whose_state_has_another_digest_is_not_gone_on_from) {
  Parts parts = take_apart(record_small(20, {1, 6}));
  parts.chunks[first_keyframe(parts)].payload[0] ^= 1;
  expect_go_to_fails(put_together(parts), 7, Status::digest_differs, "keyframe digest");
}

DETENT_TEST(keyframes, any_flipped_bit_of_a_keyframes_state_is_refused_or_harmless_even_under_a_right_checksum) {
  const Bytes recording = record_small(3, {1, 2});
  const Parts parts = take_apart(recording);
  const uint32_t step = getenv("DETENT_EMULATED") != nullptr ? 29 : 7;
  uint32_t refused = 0;
  for (uint32_t index = first_keyframe(parts); parts.chunks[index].type == k_keyframe; ++index) {
    for (size_t bit = 0; bit < parts.chunks[index].payload.size() * 8; bit += step) {
      Parts changed = parts;
      changed.chunks[index].payload[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
      const Bytes bytes = put_together(changed);
      Opened opened(bytes);
      OwnedWorld owned(opened.player.info().capacity);
      refused += opened.player.go_to(owned.world, 3) == Status::ok ? 0u : 1u;
    }
  }
  EXPECT_GT(refused, 25u);
}

DETENT_TEST(keyframes, seeking_among_chunks_in_any_order_ends_in_a_right_state_or_an_error) {
  const Bytes recording = record_small(40, {1, 9});
  const Parts parts = take_apart(recording);
  const std::vector<uint64_t> expected = digests_of(recording);
  uint64_t state = 1;
  const auto random = [&state](uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % below;
  };
  const uint32_t rounds = getenv("DETENT_EMULATED") != nullptr ? 100 : 400;
  uint32_t reached = 0, failed = 0;
  for (uint32_t round = 0; round < rounds; ++round) {
    Parts changed = parts;
    for (uint64_t change = 1 + random(3); change-- > 0;) {
      const uint32_t at = static_cast<uint32_t>(random(changed.chunks.size()));
      const uint32_t other = static_cast<uint32_t>(random(changed.chunks.size()));
      const uint64_t kind = random(5);
      if (kind == 0) std::swap(changed.chunks[at], changed.chunks[other]);
      if (kind == 1) insert_at(changed.chunks, at, Chunk(changed.chunks[other]));
      if (kind == 2 && changed.chunks.size() > 1) erase_at(changed.chunks, at);
      if (kind == 3) changed.chunks[at].tick = random(45);
      if (kind == 4) changed.chunks[at].type = changed.chunks[other].type;
    }
    const Bytes bytes = put_together(changed);
    Opened opened(bytes);
    OwnedWorld owned(opened.player.info().capacity);
    for (uint32_t seek = 0; seek < 6; ++seek) {
      const uint32_t tick = static_cast<uint32_t>(random(42));
      const Status status = opened.player.go_to(owned.world, tick);
      if (status == Status::ok) {
        ++reached;
        EXPECT_EQ(get_info(owned.world).tick, tick);
        EXPECT_EQ(digest(owned.world), expected[tick]) << "round " << round << ", tick " << tick;
      } else {
        ++failed;
        EXPECT_EQ(opened.player.error().status, status == Status::out_of_range ? Status::ok : status);
      }
    }
  }
  EXPECT_GT(reached, rounds / 4);
  EXPECT_GT(failed, rounds / 4);
}

DETENT_TEST(keyframes, seeking_in_a_cut_recording_ends_where_it_is_cut) {
  const Bytes recording = record_small(8, {1, 3});
  const std::vector<uint64_t> expected = digests_of(recording);
  uint32_t reached = 0;
  const size_t step = getenv("DETENT_EMULATED") != nullptr ? 5 : 1;
  for (size_t count = k_header_bytes; count < recording.size(); count += step) {
    const Bytes cut(recording.begin(), recording.begin() + static_cast<std::ptrdiff_t>(count));
    Opened opened(cut);
    OwnedWorld owned(opened.player.info().capacity);
    uint32_t tick = 0;
    while (tick <= 8 && opened.player.go_to(owned.world, tick) == Status::ok) {
      EXPECT_EQ(digest(owned.world), expected[tick]) << count;
      ++tick;
    }
    EXPECT_GE(tick, reached) << "a longer part shows no less";
    reached = tick;
    if (tick <= 8) {
      EXPECT_EQ(opened.player.error().status, Status::truncated) << count;
    }
  }
  EXPECT_EQ(reached, 9u);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
