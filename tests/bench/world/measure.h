#pragma once
#include <functional>
#include <string>

#include "tests/bench/world/reference.h"
#include "tests/bench/world/rows.h"

/// Runs engines on a scene and takes the times.
namespace detent_bench {

/// An engine and how hard it is to try.
struct Contestant {
  WorldEngine engine;
  Effort effort;
};

/// How a scene is measured.
struct WorldPlan {
  detent_test::Ground ground = detent_test::Ground::own;
  uint32_t repetitions = 3;
  uint32_t ticks_max = UINT32_MAX;
  bool measures = true;                  ///< false: only what a timed run tells as well
  const Reference* reference = nullptr;  ///< of a study
};

struct WorldFindings {
  std::vector<WorldRow> rows;         ///< window by window, in the contestants' order
  std::vector<std::string> left_out;  ///< a line for each contestant that cannot
  Interruptions interruptions;
};

using WorldProgress = std::function<void(uint64_t done, uint64_t total)>;

/// First each contestant makes a run that is not timed: what it tells is measured there, since to read poses between
/// steps would change what the caches hold. Then, repetition by repetition, all take turns in an order that rotates,
/// each with a world of its own from the first tick on. The clock is read around a step, and nothing else happens
/// between two.
WorldFindings measure_world(const WorldScene& scene, const std::vector<Contestant>& contestants, const WorldPlan& plan,
                            const WorldProgress& progress);

}  // namespace detent_bench
