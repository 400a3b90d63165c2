#include <stdlib.h>

#include "chunks.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

/// The valid part of `bytes` and an end chunk, as a recording; empty if nothing can be recovered.
Bytes recover(const Bytes& bytes, ReplayError& error) {
  MemorySource memory{&bytes};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(memory.source(), buffer, sizeof buffer);
  MemorySink out;
  if (player.open() == Status::ok) {
    OwnedWorld owned(player.info().capacity);
    Status status = player.start(owned.world);
    for (TickResult result; status == Status::ok && !result.finished;) status = player.next_tick(owned.world, result);
    out.bytes.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(player.whole_bytes()));
    if (player.write_end(owned.world, out.sink()) != Status::ok) out.bytes.clear();
  }
  error = player.error();
  return out.bytes;
}

size_t first_calls_at(const Bytes& recording) {
  size_t at = k_header_bytes;
  for (const Chunk& chunk : take_apart(recording).chunks) {
    if (chunk.type != static_cast<uint32_t>(ChunkType::seed)) break;
    at += k_chunk_header_bytes + chunk.payload.size() + k_checksum_bytes;
  }
  return at;
}

}  // namespace

DETENT_TEST(recovery, what_is_whole_of_a_recording_cut_at_any_byte_is_a_recording) {
  const Bytes recording = record_small(60, {1, 25});
  const size_t seed_end = first_calls_at(recording);
  uint64_t ticks_before = 0;
  Bytes whole_before;
  const size_t step = getenv("DETENT_EMULATED") != nullptr ? 5 : 1;
  for (size_t count = 0; count < recording.size(); count += step) {
    ReplayError error;
    const Bytes whole =
        recover(Bytes(recording.begin(), recording.begin() + static_cast<std::ptrdiff_t>(count)), error);
    EXPECT_EQ(error.status, Status::truncated) << count;
    EXPECT_EQ(whole.empty(), count < seed_end) << count;
    if (whole == whole_before) continue;
    whole_before = whole;
    const Replay outcome = replay(whole);
    EXPECT_TRUE(outcome.finished) << count << ": " << outcome.error.field;
    EXPECT_EQ(outcome.ticks, error.tick) << count;
    EXPECT_GE(outcome.ticks, ticks_before) << count;
    ticks_before = outcome.ticks;
  }
  EXPECT_EQ(ticks_before, 60u);
}

DETENT_TEST(recovery, only_the_end_lost_gives_the_same_bytes_back) {
  const Bytes recording = record_small(12, {1, 5});
  ReplayError error;
  EXPECT_EQ(recover(Bytes(recording.begin(), recording.end() - 1), error), recording);
}

DETENT_TEST(recovery, a_tail_of_zeros_is_cut_off) {
  Bytes recording = record_small(200);
  const size_t middle = recording.size() * 3 / 4;
  std::fill(recording.begin() + static_cast<std::ptrdiff_t>(middle), recording.end(), uint8_t{0});
  ReplayError error;
  const Replay outcome = replay(recover(recording, error));
  EXPECT_EQ(error.status, Status::corrupt);
  EXPECT_TRUE(outcome.finished);
  EXPECT_GT(outcome.ticks, 0u);
}

DETENT_TEST(recovery, a_recording_that_is_whole_or_differs_is_not_recovered) {
  const Bytes recording = record_small(12);
  ReplayError error;
  EXPECT_TRUE(recover(recording, error).empty());
  EXPECT_EQ(error.status, Status::ok);
  Parts parts = take_apart(recording);
  parts.chunks[parts.chunks.size() - 2].payload.back() ^= 1;  // the last call's user data
  EXPECT_TRUE(recover(put_together(parts), error).empty());
  EXPECT_EQ(error.status, Status::digest_differs);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
