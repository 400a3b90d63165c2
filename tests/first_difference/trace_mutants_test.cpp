#include "ports/host/detent/tick_trace.h"
#include "tests/fuzz/mutants.h"
#include "tests/replay/chunks.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A tick in which two balls lie on a half-space.
Bytes traced_tick(TraceLevel level) {
  Recording recording(OwnedWorld::def_of({3, 3, 0}));
  Recorder& recorder = recording.recorder;
  BodyId id;
  BodyDef body;
  body.type = BodyType::fixed;
  body.shape = half_space();
  EXPECT_OK(recorder.create_body(body, id));
  body = {};
  body.position.y = 0.5;
  EXPECT_OK(recorder.create_body(body, id));
  body.position.y = 1.5;
  EXPECT_OK(recorder.create_body(body, id));
  EXPECT_OK(recorder.trace({level, 1, 1}));
  EXPECT_OK(recorder.begin());
  recorder.step();
  EXPECT_OK(recorder.end());
  Bytes trace;
  for (const Chunk& chunk : take_apart(recording.memory.bytes).chunks) {
    if (chunk.type == static_cast<uint32_t>(ChunkType::stages) || chunk.type == static_cast<uint32_t>(ChunkType::state))
      trace.insert(trace.end(), chunk.payload.begin(), chunk.payload.end());
  }
  return trace;
}

const Bytes& whole_trace() {
  static const Bytes bytes = traced_tick(TraceLevel::full);
  return bytes;
}

/// The first byte says whether what follows is a full trace. It is read, and compared with a sound one.
bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  TickTrace trace, sound;
  EXPECT_TRUE(sound.read(whole_trace(), true));
  const bool read = trace.read({bytes.begin() + 1, bytes.end()}, (bytes[0] & 1) != 0);
  detent_tool::Difference difference;
  const bool differs = find_difference(trace, sound, difference);
  EXPECT_EQ(differs, !difference.fields.empty());
  EXPECT_LE(difference.fields.size(), detent_tool::k_fields_told);
  EXPECT_LE(difference.fields.size(), difference.field_count);
  return read;
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> made;
  const TraceLevel levels[] = {TraceLevel::stages, TraceLevel::full};
  for (const TraceLevel level : levels) {
    made.push_back({static_cast<uint8_t>(level == TraceLevel::full ? 1 : 0)});
    const Bytes trace = traced_tick(level);
    made.back().insert(made.back().end(), trace.begin(), trace.end());
  }
  return made;
}

DETENT_TEST(mutants, of_traces_are_refused_or_harmless) { detent_fuzz::expect_harmless({take, seeds}, 2500); }

DETENT_TEST(tick_trace, traces_of_one_tick_are_equal_at_both_levels) {
  TickTrace full, digests;
  ASSERT_TRUE(full.read(whole_trace(), true));
  ASSERT_TRUE(digests.read(traced_tick(TraceLevel::stages), false));
  detent_tool::Difference difference;
  EXPECT_FALSE(find_difference(full, full, difference));
  EXPECT_FALSE(find_difference(full, digests, difference));
  EXPECT_FALSE(find_difference(digests, full, difference));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
