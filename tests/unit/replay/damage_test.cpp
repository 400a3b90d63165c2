#include "chunks.h"
#include "replay/command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

/// Checks an error of the player: a documented status, the name of a field, and an offset inside the file.
void expect_clean(const ReplayError& error, size_t file_bytes) {
  const Status status = error.status;
  EXPECT_TRUE(status == Status::not_detent || status == Status::format_unknown || status == Status::corrupt ||
              status == Status::truncated)
      << static_cast<uint32_t>(status);
  EXPECT_STRNE(error.field, "");
  EXPECT_LE(error.offset, file_bytes);
}

void set_header_word(Parts& parts, uint32_t offset, uint32_t value) {
  for (uint32_t i = 0; i < 4; ++i) parts.header[offset + i] = static_cast<uint8_t>(value >> (8 * i));
}

uint32_t first_of(const Parts& parts, ChunkType type) {
  uint32_t index = 0;
  while (parts.chunks[index].type != static_cast<uint32_t>(type)) ++index;
  return index;
}

/// The recording with its first chunk of calls replaced by `payload`.
Bytes with_calls(const Bytes& recording, const Bytes& payload) {
  Parts parts = take_apart(recording);
  parts.chunks[first_of(parts, ChunkType::calls)].payload = payload;
  return put_together(parts);
}

void expect_refused(const Bytes& bytes, Status status, const char* field) {
  const Replay outcome = replay(bytes);
  EXPECT_FALSE(outcome.finished);
  EXPECT_EQ(outcome.error.status, status) << field;
  EXPECT_STREQ(outcome.error.field, field);
}

}  // namespace

DETENT_TEST(damage, the_checksum_is_the_common_crc_32) {
  const uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32(digits, 9), 0xcbf43926u);
  EXPECT_EQ(crc32(digits + 4, 5, crc32(digits, 4)), 0xcbf43926u);
  EXPECT_EQ(crc32(digits, 0), 0u);
}

DETENT_TEST(damage, a_recording_cut_at_any_byte_is_truncated) {
  const Bytes recording = record_small(3);
  ASSERT_TRUE(replay(recording).finished);
  for (size_t count = 0; count < recording.size(); ++count) {
    const Replay outcome = replay(Bytes(recording.begin(), recording.begin() + static_cast<std::ptrdiff_t>(count)));
    EXPECT_FALSE(outcome.finished) << count;
    EXPECT_EQ(outcome.error.status, Status::truncated) << count;
    EXPECT_EQ(outcome.error.offset, count);
    EXPECT_STRNE(outcome.error.field, "");
  }
}

DETENT_TEST(damage, any_single_flipped_bit_is_found) {
  Bytes recording = record_small(3);
  ASSERT_TRUE(replay(recording).finished);
  for (size_t bit = 0; bit < recording.size() * 8; ++bit) {
    const uint8_t mask = static_cast<uint8_t>(1u << (bit % 8));
    recording[bit / 8] ^= mask;
    const Replay outcome = replay(recording);
    EXPECT_FALSE(outcome.finished) << "bit " << bit;
    expect_clean(outcome.error, recording.size());
    recording[bit / 8] ^= mask;
  }
}

DETENT_TEST(damage, bytes_after_the_end_are_an_error) {
  Bytes recording = record_small(3);
  recording.push_back(0);
  expect_refused(recording, Status::corrupt, "bytes after the end");
}

DETENT_TEST(damage, another_version_configuration_or_flag_is_refused_by_name) {
  const Parts parts = take_apart(record_small(2));
  struct Case {
    uint32_t offset;
    uint32_t value;
    Status status;
    const char* field;
  };
  const uint32_t other_config = k_config == Config::f64 ? 1 : 4;
  const Case cases[] = {
      {8, k_recording_format_version + 1, Status::format_unknown, "format version"},
      {12, k_simulation_version + 1, Status::simulation_differs, "simulation version"},
      {16, other_config, Status::config_differs, "configuration"},
      {16, 0, Status::corrupt, "configuration"},
      {16, 5, Status::corrupt, "configuration"},
      {20, 0, Status::corrupt, "snapshot bytes"},
      {20, 0xffffffff, Status::corrupt, "snapshot bytes"},
      {32, 3, Status::corrupt, "trace level"},
      {48, 0, Status::corrupt, "snapshot bytes"},
      {52, 2, Status::corrupt, "flags"},
  };
  for (const Case& changed : cases) {
    Parts other = parts;
    set_header_word(other, changed.offset, changed.value);
    expect_refused(put_together(other), changed.status, changed.field);
    EXPECT_EQ(replay(put_together(other)).error.offset, changed.field == cases[5].field ? 48 : changed.offset);
  }
  EXPECT_EQ(put_together(parts), record_small(2));
}

DETENT_TEST(damage, a_dropped_doubled_or_exchanged_chunk_is_found) {
  const Parts parts = take_apart(record_small(60));
  const size_t count = parts.chunks.size();
  ASSERT_GE(count, 5u);
  std::vector<uint32_t> numbers(count);
  for (uint32_t i = 0; i < count; ++i) numbers[i] = i;
  for (uint32_t i = 0; i + 1 < count; ++i) {
    Parts dropped = parts;
    std::vector<uint32_t> order = numbers;
    erase_at(dropped.chunks, i);
    erase_at(order, i);
    expect_refused(put_together(dropped, order), Status::corrupt, "chunk sequence");

    Parts doubled = parts;
    order = numbers;
    insert_at(doubled.chunks, i, parts.chunks[i]);
    insert_at(order, i, i);
    expect_refused(put_together(doubled, order), Status::corrupt, "chunk sequence");

    Parts exchanged = parts;
    order = numbers;
    std::swap(exchanged.chunks[i], exchanged.chunks[i + 1]);
    std::swap(order[i], order[i + 1]);
    expect_refused(put_together(exchanged, order), Status::corrupt, "chunk sequence");
  }
}

DETENT_TEST(damage, a_chunk_of_another_tick_is_refused) {
  Parts parts = take_apart(record_small(60));
  ++parts.chunks.back().tick;
  expect_refused(put_together(parts), Status::corrupt, "chunk tick");
}

DETENT_TEST(damage, renumbered_chunks_in_a_wrong_order_are_refused) {
  const Parts parts = take_apart(record_small(2));
  Parts no_calls = parts;
  erase_at(no_calls.chunks, first_of(parts, ChunkType::calls));
  EXPECT_FALSE(replay(put_together(no_calls)).finished);
  Parts no_seed = parts;
  erase_at(no_seed.chunks, first_of(parts, ChunkType::calls) - 1);
  expect_refused(put_together(no_seed), Status::corrupt, "chunk order");
  Parts more_seed = parts;
  insert_at(more_seed.chunks, first_of(parts, ChunkType::calls), parts.chunks[0]);
  expect_refused(put_together(more_seed), Status::corrupt, "chunk order");
  Parts long_seed = parts;
  long_seed.chunks[first_of(parts, ChunkType::calls) - 1].payload.push_back(0);
  expect_refused(put_together(long_seed), Status::corrupt, "state length");
}

DETENT_TEST(damage, a_seed_that_is_refused_leaves_the_world_empty) {
  const Parts parts = take_apart(record_small(2));
  Parts changed[3] = {parts, parts, parts};
  changed[0].chunks[first_of(parts, ChunkType::calls) - 1].payload.push_back(0);
  for (Chunk& chunk : changed[1].chunks) ++chunk.tick;
  ++changed[1].header[40];  // the tick
  changed[2].chunks[0].payload[60] ^= 255;
  const char* const fields[3] = {"state length", "state tick", "seed"};
  for (uint32_t i = 0; i < 3; ++i) {
    const Bytes recording = put_together(changed[i]);
    MemorySource memory{&recording};
    uint8_t buffer[k_recording_buffer_bytes];
    Player player(memory.source(), buffer, sizeof buffer);
    EXPECT_OK(player.open());
    OwnedWorld owned(player.info().capacity);
    const uint64_t empty = digest(owned.world);
    BodyId id;
    EXPECT_OK(create_body(owned.world, {}, id));
    EXPECT_EQ(player.start(owned.world), Status::corrupt);
    EXPECT_STREQ(player.error().field, fields[i]);
    EXPECT_EQ(digest(owned.world), empty) << fields[i];
  }
}

DETENT_TEST(damage, an_unknown_chunk_is_passed_over_only_if_it_is_optional) {
  const Parts parts = take_apart(record_small(3));
  for (uint32_t at = 0; at < parts.chunks.size(); ++at) {
    Parts more = parts;
    Chunk unknown;
    unknown.type = k_chunk_optional | 77;
    unknown.tick = parts.chunks[at].tick;
    unknown.payload.assign(k_chunk_payload_bytes_max, 0xa5);
    insert_at(more.chunks, at, unknown);
    EXPECT_TRUE(replay(put_together(more)).finished) << at;
    more.chunks[at].type = 77;
    expect_refused(put_together(more), Status::format_unknown, "chunk type");
  }
}

DETENT_TEST(damage, a_chunk_longer_than_the_buffer_is_refused) {
  Parts parts = take_apart(record_small(3));
  parts.chunks[0].payload.assign(k_chunk_payload_bytes_max + 1, 0);
  expect_refused(put_together(parts), Status::corrupt, "chunk length");
  parts.chunks[0].payload.assign(0xffff, 0);
  expect_refused(put_together(parts), Status::corrupt, "chunk length");
}

DETENT_TEST(damage, a_record_with_a_right_checksum_and_wrong_content_is_refused) {
  const Bytes recording = record_small(3);
  expect_refused(with_calls(recording, {0}), Status::corrupt, "record tag");
  expect_refused(with_calls(recording, {0xff}), Status::corrupt, "record tag");
  expect_refused(with_calls(recording, {static_cast<uint8_t>(RecordTag::destroy_body), 1, 0}), Status::corrupt,
                 "body slot");
  expect_refused(with_calls(recording, {static_cast<uint8_t>(RecordTag::create_body), 9}), Status::corrupt,
                 "body type");
  expect_refused(with_calls(recording, {static_cast<uint8_t>(RecordTag::tick)}), Status::corrupt, "digest interval");
  expect_refused(with_calls(recording, {static_cast<uint8_t>(RecordTag::tick_digested), 1}), Status::corrupt, "digest");
}

DETENT_TEST(damage, a_wrong_end_is_refused) {
  const Parts parts = take_apart(record_small(3));
  Parts ticks = parts;
  ++ticks.chunks.back().payload[0];
  expect_refused(put_together(ticks), Status::corrupt, "tick count");
  Parts digest = parts;
  ++digest.chunks.back().payload[8];
  expect_refused(put_together(digest), Status::digest_differs, "final digest");
  Parts longer = parts;
  longer.chunks.back().payload.push_back(0);
  expect_refused(put_together(longer), Status::corrupt, "end length");
  Parts shorter = parts;
  shorter.chunks.back().payload.pop_back();
  expect_refused(put_together(shorter), Status::corrupt, "end length");
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
