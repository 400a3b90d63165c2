#include "chunks.h"
#include "replay/query_command.h"

/// Queries in recordings.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

const Vec3<Real> k_down = {Real(0.0), Real(-8.0), Real(0.0)};
constexpr Position k_above = {Coord(0.0), Coord(4.0), Coord(0.0)};

struct Asked {
  QueryHit hit[2];
  QueryReport report;
  QueryHits room() { return {hit, 2}; }
};

/// One query of each kind, about a ball on the ground and its surroundings.
void ask_all(Recorder& recorder) {
  Asked asked;
  RayQuery ray = {k_above, k_down};
  EXPECT_EQ(recorder.query_ray(ray, asked.room(), asked.report), Status::ok);
  EXPECT_EQ(asked.report.hits, 1u);
  EXPECT_EQ(asked.hit[0].body.slot, 2u);
  ray.all = true;
  EXPECT_EQ(recorder.query_ray(ray, {asked.hit, 1}, asked.report), Status::ok);
  EXPECT_EQ(asked.report.dropped, 1u);
  CastQuery cast;
  cast.position = k_above;
  cast.displacement = k_down;
  cast.rotation_vector.x = Real(3.0);
  cast.shape = box({Real(0.25), Real(0.5), Real(0.25)});
  EXPECT_EQ(recorder.query_cast(cast, asked.room(), asked.report), Status::ok);
  EXPECT_EQ(asked.report.hits, 1u);
  OverlapQuery within;
  within.all = true;
  EXPECT_EQ(recorder.query_overlap(within, asked.room(), asked.report), Status::ok);
  EXPECT_EQ(asked.report.hits, 2u);
  EXPECT_EQ(recorder.query_bounds({k_above, k_above}, asked.room(), asked.report), Status::ok);
  EXPECT_EQ(asked.report.hits, 1u);
  ClosestQuery closest;
  closest.position = k_above;
  EXPECT_EQ(recorder.query_closest(closest, asked.room(), asked.report), Status::ok);
  EXPECT_EQ(asked.report.hits, 1u);
  EXPECT_EQ(asked.hit[0].body.slot, 2u);
  ray.displacement.x = Real(20000.0);
  EXPECT_EQ(recorder.query_ray(ray, asked.room(), asked.report), Status::out_of_range) << "and is not recorded";
}

/// A ball falls and comes to rest. Queries are recorded before some ticks and at the end.
Bytes record_queries(bool asks = true) {
  Recording recording(OwnedWorld::def_of({2, 3, 0}));
  Recorder& recorder = recording.recorder;
  BodyId id;
  BodyDef body;
  body.type = BodyType::fixed;
  body.shape = half_space();
  EXPECT_EQ(recorder.create_body(body, id), Status::ok);
  EXPECT_EQ(recorder.begin({0}), Status::ok);
  body = {};
  body.position.y = Coord(1.0);
  EXPECT_EQ(recorder.create_body(body, id), Status::ok);
  for (int tick = 0; tick < 60; ++tick) {
    if (asks && tick % 20 == 10) ask_all(recorder);
    recorder.step();
  }
  if (asks) ask_all(recorder);
  EXPECT_EQ(recorder.end(), Status::ok);
  return recording.memory.bytes;
}

/// As replay(), and repeats the queries.
ReplayError repeat(const Bytes& bytes, const std::function<void(World&, uint64_t)>& meddle = {}) {
  MemorySource memory{&bytes};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(memory.source(), buffer, sizeof buffer);
  player.repeat_queries();
  EXPECT_EQ(player.open(), Status::ok);
  OwnedWorld owned(player.info().capacity);
  Status status = player.start(owned.world);
  TickResult result;
  while (status == Status::ok && !result.finished) {
    if (meddle) meddle(owned.world, get_info(owned.world).tick);
    status = player.next_tick(owned.world, result);
  }
  EXPECT_EQ(player.error().status, status);
  return player.error();
}

DETENT_TEST(replay_queries, are_repeated_with_the_same_answers_or_passed_over) {
  const Bytes with = record_queries(), without = record_queries(false);
  EXPECT_GT(with.size(), without.size());
  EXPECT_EQ(repeat(with).status, Status::ok);
  EXPECT_EQ(repeat(without).status, Status::ok);
  const Replay passed = replay(with);
  EXPECT_TRUE(passed.finished);
  EXPECT_EQ(passed.digest, replay(without).digest) << "a query changes nothing";
}

DETENT_TEST(replay_queries, another_answer_is_found_at_the_query) {
  // The query's answer shows the change first: the recording has no digest of the state between the change and the
  // query.
  const auto repeat_with = [](Coord x) {
    return repeat(record_queries(), [x](World& world, uint64_t tick) {
      if (tick == 29) {
        EXPECT_EQ(set_pose(world, {2, 1}, {x, Coord(0.5), Coord(0.0)}, {0.0, 0.0, 0.0, 1.0}), Status::ok);
      }
    });
  };
  const ReplayError error = repeat_with(Coord(0.0625)), other = repeat_with(Coord(0.125));
  EXPECT_EQ(error.status, Status::digest_differs);
  EXPECT_STREQ(error.field, "query answer");
  EXPECT_EQ(error.tick, 30u);
  EXPECT_NE(error.digest_recorded, error.digest_replayed);
  EXPECT_EQ(other.digest_recorded, error.digest_recorded);
  EXPECT_NE(other.digest_replayed, error.digest_replayed);
  EXPECT_NE(other.digest_replayed, other.digest_recorded);
}

template <class Command>
void expect_round_trip(Command command) {
  Normaliser normaliser;
  visit(normaliser, command);
  EXPECT_EQ(normaliser.status, Status::ok);
  uint8_t first[512] = {}, second[512] = {};
  Writer writer{first, sizeof first};
  visit(writer, command);
  ASSERT_FALSE(writer.full);
  EXPECT_EQ(little_endian(first, 2), writer.count - 2);
  EXPECT_EQ(first[2], static_cast<uint8_t>(Command::k_kind));
  Reader reader{first, writer.count};
  Command read;
  visit(reader, read);
  EXPECT_EQ(reader.failed, nullptr) << reader.failed;
  EXPECT_EQ(reader.at, writer.count);
  Writer again{second, sizeof second};
  visit(again, read);
  EXPECT_EQ(memcmp(first, second, sizeof first), 0);
}

DETENT_TEST(replay_queries, every_query_survives_writing_and_reading) {
  const Position place = {Coord(-100.5), Coord(0.0), Coord(20000.25)}, other = {Coord(1.0), Coord(2.0), Coord(3.5)};
  const Quat rotation = {Unit(0.0), Unit(-0.6), Unit(0.0), Unit(0.8)};
  const Vec3<Real> displacement = {Real(1.25), Real(-2.5), Real(0.0)},
                   rotation_vector = {Real(3.0), Real(0.0), Real(0.5)};
  const QueryFilter filter = {3, 0x80000001, {7, 8}};
  const Shape shape = rounded(hull(5), Real(0.375));
  expect_round_trip(RayCommand{{place, displacement, filter, true}, 0xfedcba9876543210u});
  expect_round_trip(CastCommand{{shape, place, rotation, displacement, rotation_vector, filter, true}, 1});
  expect_round_trip(OverlapCommand{{shape, place, rotation, filter, true}, 2});
  expect_round_trip(BoundsCommand{{place, other, filter, true}, 3});
  expect_round_trip(ClosestCommand{{shape, place, rotation, Real(2.5), filter, true}, 4});
}

DETENT_TEST(replay_queries, a_query_that_is_not_one_is_corrupt_to_who_repeats_it_and_its_length_to_all) {
  Recording recording(OwnedWorld::def_of({1, 1, 0}));
  ASSERT_EQ(recording.recorder.begin({0}), Status::ok);
  QueryReport report;
  ASSERT_EQ(recording.recorder.query_ray({k_above, k_down}, {}, report), Status::ok);
  ASSERT_EQ(recording.recorder.end(), Status::ok);
  const Parts parts = take_apart(recording.memory.bytes);
  const auto doctored = [&](uint32_t byte, uint8_t value) {
    Parts changed = parts;
    for (Chunk& chunk : changed.chunks) {
      if (chunk.type == static_cast<uint32_t>(ChunkType::calls)) chunk.payload[byte] = value;
    }
    return put_together(changed);
  };
  EXPECT_EQ(repeat(put_together(parts)).status, Status::ok);
  const Bytes unknown = doctored(3, 99);
  EXPECT_EQ(repeat(unknown).status, Status::corrupt);
  EXPECT_STREQ(repeat(unknown).field, "query kind");
  EXPECT_TRUE(replay(unknown).finished);
  const Bytes longer = doctored(2, 1);
  EXPECT_EQ(repeat(longer).status, Status::corrupt);
  EXPECT_EQ(replay(longer).error.status, Status::corrupt);
  EXPECT_STREQ(replay(longer).error.field, "query length");
  const Bytes shorter = doctored(1, 9);
  EXPECT_EQ(repeat(shorter).status, Status::corrupt);
  EXPECT_EQ(replay(shorter).error.status, Status::corrupt) << "what then follows is no record";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
