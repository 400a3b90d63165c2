#include "ports/host/detent/tick_trace.h"
#include "tests/campaigns/fuzz/mutants.h"
#include "tests/unit/replay/chunks.h"

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

/// The second tick of a world with contacts, a joint and a sensor.
Bytes traced_variety() {
  Recording recording(OwnedWorld::def_of({6, 6, 0, true, 1, 2}));
  Recorder& recorder = recording.recorder;
  BodyId ids[6];
  BodyDef body;
  body.type = BodyType::fixed;
  body.shape = half_space();
  EXPECT_OK(recorder.create_body(body, ids[0]));
  body = {};
  const Coord places[4] = {0.0, 1.0, 3.0, 6.0};
  for (uint32_t i = 0; i < 4; ++i) {
    body.position = {places[i], 0.5, 0.0};
    body.shape = i < 2 ? box({0.5, 0.5, 0.5}) : sphere(0.5);
    body.linear_velocity = {0.25, 0.0, 0.0};
    EXPECT_OK(recorder.create_body(body, ids[i + 1]));
  }
  body.sensor = true;
  body.type = BodyType::kinematic;
  EXPECT_OK(recorder.create_body(body, ids[5]));
  JointDef joint;
  joint.a = ids[1];
  joint.b = ids[3];
  joint.anchor_b = {-3.0, 0.0, 0.0};
  JointId joint_id;
  EXPECT_OK(recorder.create_joint(joint, joint_id));
  EXPECT_OK(recorder.trace({TraceLevel::full, 3, 3}));
  EXPECT_OK(recorder.begin());
  for (int i = 0; i < 3; ++i) recorder.step();
  EXPECT_OK(recorder.end());
  Bytes trace;
  for (const Chunk& chunk : take_apart(recording.memory.bytes).chunks) {
    if (chunk.type == static_cast<uint32_t>(ChunkType::state))
      trace.insert(trace.end(), chunk.payload.begin(), chunk.payload.end());
  }
  return trace;
}

DETENT_TEST(tick_trace, every_number_of_every_kind_of_element_is_named_where_it_differs) {
  const Bytes whole = traced_variety();
  TickTrace sound;
  ASSERT_TRUE(sound.read(whole, true));
  bool seen[k_trace_part_count] = {};
  TraceReader reader(whole.data(), static_cast<uint32_t>(whole.size()), true);
  for (TraceElement element; reader.next(element);) {
    if (element.part == nullptr || seen[element.part - k_trace_parts]) continue;
    const TracePart& part = *element.part;
    seen[&part - k_trace_parts] = true;
    std::vector<std::string> names;
    for (uint32_t i = 0; i < part.field_count; ++i) {
      const Field& field = part.fields[i];
      const uint32_t words = field.kind == WordKind::scaled ? 2 : 1;
      for (uint32_t word = 0; word < field.count; word += words) {
        const uint32_t at = field.offset + word * field.width;
        if (part.sorted && at < 4 * part.key_words) continue;  // that would be another element
        Bytes changed = whole;
        changed[static_cast<size_t>(element.bytes - whole.data()) + at] ^= 1;
        TickTrace other;
        ASSERT_TRUE(other.read(changed, true));
        detent_tool::Difference difference;
        ASSERT_TRUE(find_difference(sound, other, difference));
        ASSERT_EQ(difference.field_count, 1u) << part.name << ' ' << field.name;
        const detent_tool::FieldDifference& found = difference.fields[0];
        EXPECT_EQ(found.part, part.name);
        EXPECT_EQ(found.field.substr(0, std::string(field.name).size()), field.name);
        EXPECT_NE(found.a.raw, found.b.raw);
        EXPECT_FALSE(found.element.kind.empty());
        names.push_back(found.field);
      }
    }
    std::sort(names.begin(), names.end());
    EXPECT_TRUE(std::adjacent_find(names.begin(), names.end()) == names.end()) << part.name;
  }
  for (const TracePart& part : k_trace_parts) EXPECT_EQ(seen[&part - k_trace_parts], part.kind != TraceKind::asset);
}

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
