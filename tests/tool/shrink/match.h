#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "ports/host/detent/owned_world.h"
#include "ports/host/detent/recording_bytes.h"
#include "ports/host/detent/shrink_recording.h"
#include "replay/command.h"
#include "tests/common/support/test.h"

/// Small matches that are recorded, and what `detent shrink` makes of them.
namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_tool::FaultKind;
using detent_tool::Outcome;
using detent_tool::ShrinkRequest;
using detent_tool::Shrunk;
using detent_tool::Verdict;

inline std::vector<uint8_t> bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A match that is being recorded, without gravity.
class Match {
 public:
  explicit Match(Capacity capacity = {64, 256, 0, true, 16, 0}, bool continuous = true) {
    WorldDef def;
    def.capacity = capacity;
    def.gravity = {0.0, 0.0, 0.0};
    def.continuous = continuous;
    EXPECT_OK(owned.create(def, {}));
    recorder = std::make_unique<Recorder>(owned.world, bytes.sink(), buffer, k_recording_buffer_bytes);
  }

  BodyId add(const Position& position, BodyType type = BodyType::dynamic, const Shape& shape = sphere(0.5)) {
    BodyDef def;
    def.type = type;
    def.position = position;
    def.shape = shape;
    BodyId id;
    EXPECT_OK(recorder->create_body(def, id));
    return id;
  }
  /// Bodies that have nothing to do with anything.
  void add_bystanders(int count) {
    for (int i = 0; i < count; ++i) {
      Coord x = 0.0;
      EXPECT_OK(coord_from_host(100.0 + 10 * bystanders_++, x));
      add({x, 0.0, 50.0});
    }
  }
  BodyId add_box(const Position& position, const Vec3<Real>& half) { return add(position, BodyType::fixed, box(half)); }
  JointId join(BodyId a, BodyId b, const Position& point, JointType type = JointType::ball) {
    JointDef def;
    def.type = type;
    def.a = a;
    def.b = b;
    EXPECT_OK(place_joint(owned.world, point, {0.0, 0.0, 0.0, 1.0}, def));
    JointId id;
    EXPECT_OK(recorder->create_joint(def, id));
    return id;
  }
  void move(BodyId id, const Position& position) { EXPECT_OK(recorder->set_pose(id, position, {0.0, 0.0, 0.0, 1.0})); }
  void begin(const RecordingDef& def = {}) { EXPECT_OK(recorder->begin(def)); }
  void step(int ticks) {
    for (int i = 0; i < ticks; ++i) recorder->step();
  }
  /// Ends the recording and writes it to a file. Returns the path.
  std::string end() {
    EXPECT_OK(recorder->end());
    return write();
  }
  /// The same with this record as the last call.
  std::string end_with(const std::vector<uint8_t>& record) {
    EXPECT_OK(recorder->flush());
    const uint64_t tick = get_info(owned.world).tick;
    bytes.add(record.data(), static_cast<uint32_t>(record.size()), tick);
    bytes.end(tick, {tick, digest(owned.world)});
    return write();
  }
  std::string write() const {
    const std::string path = path_of("match.rec");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.bytes.data()), static_cast<std::streamsize>(bytes.bytes.size()));
    return path;
  }
  static std::string path_of(const std::string& name) {
    const testing::TestInfo* const info = testing::UnitTest::GetInstance()->current_test_info();
    return testing::TempDir() + info->test_suite_name() + "." + info->name() + "." + name;
  }

  OwnedWorld owned;
  RecordingBytes bytes;
  uint8_t buffer[k_recording_buffer_bytes];
  std::unique_ptr<Recorder> recorder;

 private:
  int bystanders_ = 0;
};

/// The record of a call.
template <class Command>
std::vector<uint8_t> record_of(Command command) {
  std::vector<uint8_t> record(1 + sizeof(Command));
  record[0] = static_cast<uint8_t>(Command::k_tag);
  Writer writer{record.data() + 1, sizeof(Command)};
  visit(writer, command);
  record.resize(1 + writer.count);
  return record;
}

/// What came of shrinking.
struct ShrinkResult {
  Outcome outcome;
  Shrunk shrunk;
  std::string path;  ///< of the written recording

  bool good() const { return outcome.verdict == Verdict::good; }
  std::vector<uint64_t> sizes() const {
    return {shrunk.after.ticks, shrunk.after.bodies, shrunk.after.joints, shrunk.after.calls};
  }
};

inline const detent_tool::Progress k_no_progress = [](uint64_t, uint64_t) {};

inline ShrinkResult shrink_of(const std::string& path, FaultKind kind, ShrinkRequest request = {}) {
  request.reading.path = path;
  request.kind = kind;
  request.output = Match::path_of("small.rec");
  std::filesystem::remove(request.output);
  ShrinkResult result;
  result.path = request.output;
  result.outcome = shrink(request, result.shrunk, k_no_progress);
  EXPECT_EQ(std::filesystem::exists(request.output), result.good()) << result.outcome.problem;
  return result;
}

/// The result verifies, and shows the same fault when it is shrunk again.
inline void expect_sound(const ShrinkResult& result, FaultKind kind, const ShrinkRequest& request = {}) {
  ASSERT_TRUE(result.good()) << result.outcome.problem;
  const Outcome verified = verify({result.path}, k_no_progress);
  if (kind == FaultKind::differs || kind == FaultKind::status) {
    EXPECT_EQ(verified.status, status_text(Status::digest_differs));
  } else {
    EXPECT_EQ(verified.problem, "");
    EXPECT_EQ(verified.ticks, result.shrunk.after.ticks);
  }
  const std::string copy = Match::path_of("copy.rec");
  std::filesystem::copy_file(result.path, copy, std::filesystem::copy_options::overwrite_existing);
  const ShrinkResult again = shrink_of(copy, kind, request);
  ASSERT_TRUE(again.good()) << again.outcome.problem;
  EXPECT_EQ(again.shrunk.fault, result.shrunk.fault);
  EXPECT_EQ(again.sizes(), result.sizes());
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
