#include "tests/campaigns/fuzz/tool.h"

#include <gtest/gtest.h>
#include <stdio.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "run.h"
#include "zstandard.h"

namespace detent_fuzz {
namespace {

using namespace detent_tool;

constexpr uint32_t k_ticks = 3, k_world_bytes_max = 1u << 22;
constexpr uint64_t k_unpacked_max = 1u << 20;

// Scenes.

void expect_printable(const Problem& problem) {
  for (const char letter : problem_text("scene.json", problem)) EXPECT_GE(static_cast<unsigned char>(letter), ' ');
}

bool take_scene(const Bytes& bytes) {
  if (bytes.empty()) return false;
  const std::string text(bytes.begin() + 1, bytes.end());
  Node root;
  Problem problem;
  if (!parse_json(text, root, problem)) {
    EXPECT_FALSE(problem.text.empty());
    expect_printable(problem);
    return false;
  }
  RunRequest request;
  request.path = DETENT_ROOT "/tests/tool/scene_files/scene.json";
  request.root = &root;
  request.ticks_given = true;
  request.ticks = k_ticks;
  request.prints = {true, true, true, true};
  request.world_bytes_max = k_world_bytes_max;
  const Engine& engine = engines()[bytes[0] % engines().size()];
  const RunOutcome outcome = engine.run(
      request, [](const RunLine&) {}, [](uint64_t, uint64_t) {});
  for (const Problem& each : outcome.problems) expect_printable(each);
  return outcome.problems.empty();
}

/// The examples, and the scene that has every key.
std::vector<Bytes> scenes() {
  std::vector<Bytes> made;
  const char* const paths[] = {DETENT_ROOT "/tests/tool/scene_files/every.json",
                               DETENT_ROOT "/examples/scenes/chain.json", DETENT_ROOT "/examples/scenes/stack.json"};
  for (const char* const path : paths) {
    std::ifstream file(path, std::ios::binary);
    for (size_t engine = 0; engine < engines().size(); ++engine) {
      file.seekg(0);
      made.push_back({static_cast<uint8_t>(engine)});
      made.back().insert(made.back().end(), std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
      file.clear();
    }
  }
  return made;
}

// Compressed recordings.

/// What the file gives from here on. False if it cannot be read to its end.
bool read_all(Input& input, Bytes& all) {
  uint8_t piece[1000];
  for (uint32_t got = sizeof piece; got == sizeof piece;) {
    if (!input.read(piece, sizeof piece, got)) return false;
    EXPECT_LE(got, sizeof piece);
    all.insert(all.end(), piece, piece + got);
  }
  return true;
}

/// Whatever is sought is what was there before.
void seek_about(Input& input, const Bytes& all, uint64_t seed) {
  detent_queries::Random random(seed);
  for (uint32_t i = 0; i < 4; ++i) {
    const uint64_t offset = random.below(static_cast<uint32_t>(all.size()) + 100);
    uint8_t piece[300];
    uint32_t got = 0;
    ASSERT_TRUE(input.seek(offset) && input.read(piece, sizeof piece, got));
    const uint64_t left = offset < all.size() ? all.size() - offset : 0;
    ASSERT_EQ(got, left < sizeof piece ? left : sizeof piece);
    if (got != 0) {
      EXPECT_EQ(memcmp(piece, all.data() + offset, got), 0);
    }
  }
}

bool take_packed(const Bytes& bytes) {
  if (bytes.size() < 2) return false;
  Bytes packed(bytes.begin() + 1, bytes.end());
  std::string problem;
  const std::unique_ptr<Input> input = unpack(File(fmemopen(packed.data(), packed.size(), "rb")), problem);
  if (input == nullptr) return false;
  input->bytes_max = k_unpacked_max;
  Bytes all;
  if (!read_all(*input, all)) {
    EXPECT_FALSE(input->problem.empty());
    EXPECT_LE(all.size(), k_unpacked_max);
    return false;
  }
  seek_about(*input, all, bytes[0]);
  return true;
}

/// None where the tool was built without zstd.
std::vector<Bytes> packed() {
  std::vector<Bytes> made;
  for (uint32_t count = 0; count <= 20000; count += 5000) {
    char* bytes = nullptr;
    size_t size = 0;
    std::string problem;
    const std::unique_ptr<Output> output = pack(File(open_memstream(&bytes, &size)), problem);
    if (output == nullptr) return {};
    for (uint32_t i = 0; i < count; ++i) {
      const uint8_t byte = static_cast<uint8_t>(i % 300 * (i / 4000));
      EXPECT_TRUE(output->write(&byte, 1));
    }
    EXPECT_TRUE(output->close());
    made.push_back({static_cast<uint8_t>(count)});
    made.back().insert(made.back().end(), bytes, bytes + size);
    free(bytes);
  }
  return made;
}

}  // namespace

const Target k_scenes_target = {take_scene, scenes};
const Target k_packed_target = {take_packed, packed};

}  // namespace detent_fuzz
