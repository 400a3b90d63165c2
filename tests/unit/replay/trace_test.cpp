#include "base/digest.h"
#include "chunks.h"
#include "replay/replay_watch.h"
#include "replay/trace_stream.h"
#include "tests/common/support/spoil.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr uint32_t k_stages = static_cast<uint32_t>(ChunkType::stages),
                   k_state = static_cast<uint32_t>(ChunkType::state);

/// Two balls and a box that meet on a half-space within 20 ticks.
Bytes record_traced(const TraceDef* trace, const StepObserver* observer = nullptr, uint8_t filling = 0) {
  const WorldDef def = OwnedWorld::def_of({5, 6, 0, true, 1, 0});
  Recording recording(def);
  World& world = recording.owned.world;
  spoil_work_space(world, filling);
  uint8_t state[16384];
  EXPECT_LE(snapshot_bytes(def.capacity), sizeof state);
  EXPECT_OK(save(world, state, sizeof state));
  EXPECT_OK(restore(world, state, sizeof state));  // what it keeps from step to step is made anew
  world.hooks.observer = observer;
  Recorder& recorder = recording.recorder;
  BodyId ids[4];
  BodyDef body;
  body.type = BodyType::fixed;
  body.shape = half_space();
  EXPECT_OK(recorder.create_body(body, ids[0]));
  body = {};
  body.position = {0.0, 0.5, 0.0};
  EXPECT_OK(recorder.create_body(body, ids[1]));
  body.position = {0.25, 1.75, 0.0};
  body.shape = box({0.5, 0.25, 0.5});
  EXPECT_OK(recorder.create_body(body, ids[2]));
  body.position = {3.0, 1.0, 0.0};
  EXPECT_OK(recorder.create_body(body, ids[3]));
  if (trace != nullptr) {
    EXPECT_OK(recorder.trace(*trace));
  }
  EXPECT_OK(recorder.begin());
  for (uint32_t tick = 1; tick <= 20; ++tick) {
    if (tick == 5) {
      EXPECT_OK(recorder.set_velocity(ids[3], {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}));
    }
    recorder.step();
  }
  EXPECT_OK(recorder.end());
  world.hooks.observer = nullptr;
  return recording.memory.bytes;
}

/// The bytes of each tick's trace, by the number of the tick.
std::vector<Bytes> traces_of(const Bytes& recording, uint32_t type) {
  std::vector<Bytes> traces(22);
  for (const Chunk& chunk : take_apart(recording).chunks) {
    if (chunk.type != type) continue;
    Bytes& trace = traces[static_cast<size_t>(chunk.tick) + 1];
    trace.insert(trace.end(), chunk.payload.begin(), chunk.payload.end());
  }
  return traces;
}

struct Count {
  uint32_t stages = 0, elements = 0, contacts = 0, bodies = 0;
  bool whole = false;
};
Count count_of(const Bytes& trace, bool full) {
  Count count;
  uint64_t sum = 0;
  uint32_t in_stage = 0;
  TraceReader reader(trace.data(), static_cast<uint32_t>(trace.size()), full);
  for (TraceElement element; reader.next(element);) {
    if (element.part == nullptr) {
      EXPECT_EQ(element.place, in_stage);
      if (full) {
        EXPECT_EQ(little_endian(element.bytes, 8), sum);
      }
      in_stage = 0;
      sum = 0;
      ++count.stages;
      continue;
    }
    ++in_stage;
    ++count.elements;
    if (full) sum += trace_digest(*element.part, element.place, element.bytes);
    count.contacts += element.part->kind == TraceKind::contact && element.part->number >= 32 ? 1u : 0u;
    count.bodies += element.part->kind == TraceKind::body && element.part->number >= 32 ? 1u : 0u;
  }
  count.whole = reader.whole();
  return count;
}

}  // namespace

DETENT_TEST(trace, only_the_ticks_of_the_window_are_traced) {
  const TraceDef def = {TraceLevel::full, 4, 6};
  const std::vector<Bytes> traces = traces_of(record_traced(&def), k_state);
  for (size_t tick = 0; tick < traces.size(); ++tick) EXPECT_EQ(traces[tick].empty(), tick < 4 || tick > 6) << tick;
}

DETENT_TEST(trace, a_traced_recording_is_replayed_like_any_other_and_holds_the_same_digests) {
  const Replay plain = replay(record_traced(nullptr));
  ASSERT_TRUE(plain.finished);
  const TraceLevel levels[] = {TraceLevel::stages, TraceLevel::full};
  for (const TraceLevel level : levels) {
    const TraceDef def = {level, 1, 20};
    const Bytes recording = record_traced(&def);
    const Replay traced = replay(recording);
    EXPECT_TRUE(traced.finished) << traced.error.field;
    EXPECT_EQ(traced.compared, plain.compared);
    EXPECT_EQ(traced.digest, plain.digest);
    Parts parts = take_apart(recording);
    EXPECT_EQ(little_endian(parts.header.data() + 32, 4), static_cast<uint32_t>(level));
    // Without the trace chunks it is the plain recording, except for the borders between chunks.
    std::vector<Chunk> rest;
    for (const Chunk& chunk : parts.chunks) {
      if (chunk.type != k_stages && chunk.type != k_state) rest.push_back(chunk);
    }
    parts.chunks = rest;
    EXPECT_TRUE(replay(put_together(parts)).finished);
  }
}

DETENT_TEST(trace, each_stage_ends_with_the_count_and_the_sum_of_its_elements) {
  const TraceDef def = {TraceLevel::full, 1, 20};
  const std::vector<Bytes> traces = traces_of(record_traced(&def), k_state);
  for (uint32_t tick = 1; tick <= 20; ++tick) {
    const Count count = count_of(traces[tick], true);
    EXPECT_TRUE(count.whole);
    EXPECT_EQ(count.stages, k_trace_stage_count);
    EXPECT_GT(count.bodies, 0u);
  }
  EXPECT_GT(count_of(traces[20], true).contacts, 6u);
}

DETENT_TEST(trace, digests_are_those_of_the_full_trace) {
  const TraceDef full_def = {TraceLevel::full, 1, 20}, digest_def = {TraceLevel::stages, 1, 20};
  const std::vector<Bytes> fulls = traces_of(record_traced(&full_def), k_state);
  const std::vector<Bytes> digests = traces_of(record_traced(&digest_def), k_stages);
  for (uint32_t tick = 1; tick <= 20; ++tick) {
    TraceReader full(fulls[tick].data(), static_cast<uint32_t>(fulls[tick].size()), true);
    TraceReader brief(digests[tick].data(), static_cast<uint32_t>(digests[tick].size()), false);
    TraceElement a, b;
    while (full.next(a)) {
      ASSERT_TRUE(brief.next(b));
      ASSERT_EQ(a.part, b.part);
      ASSERT_EQ(a.place, b.place);
      if (a.part == nullptr) {
        EXPECT_EQ(little_endian(a.bytes, 8), little_endian(b.bytes, 8));
        continue;
      }
      const uint32_t key = 4 * a.part->key_words;
      EXPECT_EQ(memcmp(a.bytes, b.bytes, key), 0);
      EXPECT_EQ(little_endian(b.bytes + key, 4), digest_fold(trace_digest(*a.part, a.place, a.bytes)));
    }
    EXPECT_FALSE(brief.next(b));
    EXPECT_TRUE(full.whole() && brief.whole());
  }
}

DETENT_TEST(trace, what_was_in_the_work_space_before_is_in_no_trace) {
  const TraceDef def = {TraceLevel::full, 1, 20};
  EXPECT_TRUE(record_traced(&def, nullptr, 0x00) == record_traced(&def, nullptr, 0xa5));
}

DETENT_TEST(trace, the_worlds_own_observer_sees_every_stage_in_order_with_a_trace_and_without) {
  struct Seen {
    std::vector<StepStage> stages;
    uint32_t contacts = 0;
    static void take(void* context, const World& world, StepStage stage, uint32_t contacts) {
      Seen& seen = *static_cast<Seen*>(context);
      EXPECT_EQ(seen.stages.size() % k_step_stage_count, static_cast<size_t>(stage));
      EXPECT_LT(get_info(world).tick, 20u);
      seen.stages.push_back(stage);
      seen.contacts = contacts;
    }
  };
  const TraceDef def = {TraceLevel::full, 3, 7};
  const TraceDef* const traces[] = {nullptr, &def};
  for (const TraceDef* trace : traces) {
    Seen seen;
    const StepObserver observer = {Seen::take, &seen};
    record_traced(trace, &observer);
    EXPECT_EQ(seen.stages.size(), 20u * k_step_stage_count);
    EXPECT_GT(seen.contacts, 0u);
  }
}

DETENT_TEST(trace, a_step_that_has_nothing_to_do_has_no_stages) {
  Recording recording(OwnedWorld::def_of({2, 2, 0}));
  EXPECT_OK(recording.recorder.trace({TraceLevel::full, 1, 1}));
  EXPECT_OK(recording.recorder.begin());
  recording.recorder.step();  // no body
  recording.recorder.step();
  EXPECT_OK(recording.recorder.end());
  const std::vector<Bytes> traces = traces_of(recording.memory.bytes, k_state);
  EXPECT_LE(count_of(traces[1], true).stages, k_trace_stage_count);
  Recording idle(OwnedWorld::def_of({2, 2, 0}));
  idle.recorder.step();
  EXPECT_OK(idle.recorder.trace({TraceLevel::full, 2, 2}));
  EXPECT_OK(idle.recorder.begin());
  idle.recorder.step();
  EXPECT_OK(idle.recorder.end());
  EXPECT_EQ(count_of(traces_of(idle.memory.bytes, k_state)[2], true).stages, 2u);  // calls and end
}

DETENT_TEST(trace, a_failing_sink_ends_the_recording_and_not_the_step) {
  uint64_t digests[2] = {};
  for (uint32_t i = 0; i < 2; ++i) {
    Recording recording(OwnedWorld::def_of({4, 4, 0}));
    Recorder& recorder = recording.recorder;
    if (i == 1) recording.memory.writes_max = 40;
    BodyId id;
    EXPECT_OK(recorder.create_body({}, id));
    EXPECT_OK(recorder.trace({}));
    EXPECT_OK(recorder.begin());
    for (uint32_t tick = 0; tick < 30; ++tick) recorder.step();
    EXPECT_EQ(recorder.end() == Status::ok, i == 0);
    digests[i] = digest(recording.owned.world);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

DETENT_TEST(trace, a_window_that_is_none_and_a_recording_that_has_begun_are_refused) {
  Recording recording(OwnedWorld::def_of({2, 2, 0}));
  EXPECT_EQ(recording.recorder.trace({TraceLevel::full, 2, 1}), Status::bad_argument);
  EXPECT_EQ(recording.recorder.trace({static_cast<TraceLevel>(3), 1, 2}), Status::bad_argument);
  EXPECT_OK(recording.recorder.begin());
  EXPECT_EQ(recording.recorder.trace({TraceLevel::full, 1, 2}), Status::bad_argument);
  recording.recorder.step();
  EXPECT_OK(recording.recorder.end());
  const Replay played = replay(recording.memory.bytes);
  EXPECT_TRUE(played.finished);
  EXPECT_TRUE(traces_of(recording.memory.bytes, k_state)[1].empty());
}

DETENT_TEST(trace, bytes_that_are_no_trace_are_refused_and_never_read_beyond_their_end) {
  const TraceDef def = {TraceLevel::full, 20, 20};
  const Bytes good = traces_of(record_traced(&def), k_state)[20];
  ASSERT_TRUE(count_of(good, true).whole);
  for (size_t count = 1; count < good.size(); count += 7) {
    const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(count));
    TraceReader reader(cut.data(), static_cast<uint32_t>(cut.size()), true);
    uint32_t stages = 0;
    for (TraceElement element; reader.next(element);) stages += element.part == nullptr ? 1u : 0u;
    EXPECT_LT(stages, k_trace_stage_count);
  }
  const auto changed = [&](size_t at, uint8_t value) {
    Bytes bytes = good;
    bytes[at] = value;
    TraceReader reader(bytes.data(), static_cast<uint32_t>(bytes.size()), true);
    for (TraceElement element; reader.next(element);) {
    }
    return reader.whole();
  };
  EXPECT_TRUE(changed(2, good[2]));
  EXPECT_FALSE(changed(0, 10));  // a stage that there is not
  EXPECT_FALSE(changed(0, 3));   // then `calls` comes after it
  EXPECT_FALSE(changed(1, 99));  // a part that there is not
  Bytes twice = good;
  twice.insert(twice.end(), good.begin(), good.end());
  EXPECT_FALSE(count_of(twice, true).whole);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
