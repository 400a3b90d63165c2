#pragma once
#include <functional>

#include "tests/campaigns/zoo/visit.h"

namespace detent_zoo {

/// A scene in an engine.
struct Result {
  std::string engine;
  Verdict verdict;           ///< `problem`: what it cannot express, or why it could not be played
  double mean = 0, max = 0;  ///< us a tick: over each tick's least time of the repetitions

  bool played() const { return verdict.problem.empty(); }
  bool passed() const { return played() && verdict.failed.empty(); }
};

struct SceneResults {
  Entry entry;
  std::vector<Result> results;  ///< an engine each, in their order

  const Result* of(const std::string& engine) const;
};

/// Plays the scene once in each engine with its checks, and then for its times, the engines in turn.
SceneResults measure_scene(const Entry& entry, const std::vector<Engine>& engines, uint32_t repetitions,
                           const std::string& folder, const std::function<void(const std::string&)>& progress);

}  // namespace detent_zoo
