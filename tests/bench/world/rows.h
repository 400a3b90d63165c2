#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/step_times.h"
#include "tests/bench/world/engine.h"

namespace detent_bench {

/// One engine on one window of a scene.
struct WorldRow {
  std::string scene, ground, engine, config;
  Effort effort;  ///< as asked for: 0 is the default
  StepTimes times;
  StageShares stages;
  uint32_t bodies = 0;    ///< that move
  uint32_t contacts = 0;  ///< contact points, the mean of the samples
  uint64_t bytes = 0;     ///< of memory at the window's end
  uint64_t allocs = 0;    ///< while the steps were timed, at most of the repetitions
  uint64_t losses = 0;
  std::string settings;
  std::vector<std::pair<std::string, double>> measures;
};

/// The rows of one scene and ground as a table, with the ratio to Bullet in double.
std::string world_table_of(const std::vector<WorldRow>& rows);
/// A line a scene and ground: this library's configurations against Bullet in double, and each other.
std::string world_summary_of(const std::vector<WorldRow>& rows);
/// The time of a body in a step, ns, over the number of bodies.
std::string growth_table_of(const std::vector<WorldRow>& rows);
/// A JSON array, a row a line; of a study with the effort.
std::string world_json_of(const std::vector<WorldRow>& rows, bool study);

}  // namespace detent_bench
