#pragma once
#include <functional>

#include "tests/bench/step_times.h"
#include "tests/campaigns/zoo/visit.h"

namespace detent_zoo {

/// A scene in an engine.
struct Result {
  std::string engine;
  Verdict verdict;  ///< `problem`: what it cannot express, or why it could not be played
  detent_bench::StepTimes times;
  detent_bench::StageShares stages;  ///< of the run with checks

  bool played() const { return verdict.problem.empty(); }
  bool passed() const { return played() && verdict.failed.empty(); }
};

struct SceneResults {
  Entry entry;
  std::string kind;  ///< of games; else empty
  detent_test::Ground ground = detent_test::Ground::own;
  std::vector<Result> results;  ///< an engine each, in their order

  const Result* of(const std::string& engine) const;
};

/// Plays the scene on its ground once in each engine with its checks, and then for its times, the engines in turn.
void measure_scene(SceneResults& scene, const std::vector<Engine>& engines, uint32_t repetitions,
                   const std::string& folder, const std::function<void(const std::string&)>& progress);

}  // namespace detent_zoo
