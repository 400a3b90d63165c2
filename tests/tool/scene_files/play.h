#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "run.h"

/// What came of a scene that is a text.
namespace detent_tool {

struct Played {
  RunOutcome outcome;
  std::string problems;   ///< a line each: "14: bodies[3].shape: is missing"
  std::string lines;      ///< that were printed
  std::string recording;  ///< its bytes
};

inline std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// As a scene in tests/tool/scene_files, with everything printed and recorded. `ticks`: 0: the scene's own.
inline Played play(const std::string& text, const Engine& engine = engines().front(), uint32_t ticks = 0) {
  Played played;
  Node root;
  Problem problem;
  const auto note = [&played](const Problem& each) {
    const std::string place = std::to_string(each.line) + (each.path.empty() ? "" : ": " + each.path);
    played.problems += place + ": " + each.text + "\n";
  };
  if (!parse_json(text, root, problem)) {
    note(problem);
    return played;
  }
  RunRequest request;
  request.path = DETENT_ROOT "/tests/tool/scene_files/scene.json";
  request.root = &root;
  request.ticks_given = ticks != 0;
  request.ticks = ticks;
  request.prints = {true, true, true, true};
  request.recording = testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".rec";
  const auto print = [&played](const RunLine& line) {
    played.lines += std::to_string(line.tick) + " " + line.what;
    for (const RunLine::Value& value : line.values) {
      played.lines += std::string(" ") + value.name + " " + value.text;
      for (const double number : value.numbers) played.lines += " " + std::to_string(number);
    }
    played.lines += "\n";
  };
  played.outcome = engine.run(request, print, [](uint64_t, uint64_t) {});
  for (const Problem& each : played.outcome.problems) note(each);
  played.recording = file_text(request.recording);
  std::filesystem::remove(request.recording);
  return played;
}

}  // namespace detent_tool
