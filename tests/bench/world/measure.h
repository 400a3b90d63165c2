#pragma once
#include <functional>
#include <string>

#include "tests/bench/world/rows.h"
#include "tests/bench/world/scenes.h"

/// Runs engines on a scene and takes the times.
namespace detent_bench {

/// An engine and how hard it is to try.
struct Contestant {
  WorldEngine engine;
  Effort effort;
};

struct WorldFindings {
  std::vector<WorldRow> rows;         ///< window by window, in the contestants' order
  std::vector<std::string> left_out;  ///< a line for each contestant that cannot
  uint64_t asked = 0;                 ///< timed steps long enough to ask whether they were interrupted
  uint64_t interrupted = 0;  ///< those in which another process had the core: only the thread's own time counts
};

using WorldProgress = std::function<void(uint64_t done, uint64_t total)>;

/// First each contestant makes a run that is not timed: what it tells is measured there, since to read poses between
/// steps would change what the caches hold. Then, repetition by repetition, all take turns in an order that rotates,
/// each with a world of its own from the first tick on. The clock is read around a step, and nothing else happens
/// between two.
WorldFindings measure_world(const WorldScene& scene, const std::vector<Contestant>& contestants, uint32_t repetitions,
                            uint32_t ticks_max, const WorldProgress& progress);

}  // namespace detent_bench
