#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/world/engine.h"

namespace detent_bench {

/// One engine on one window of a scene.
struct WorldRow {
  std::string scene, engine, config;
  Effort effort;  ///< as asked for: 0 is the default
  double us_median = 0, us_p99 = 0, us_max = 0;
  uint32_t contacts = 0;  ///< contact points, the mean of the samples
  uint64_t bytes = 0;     ///< of memory at the window's end
  uint64_t allocs = 0;    ///< while the steps were timed, at most of the repetitions
  uint64_t losses = 0;
  std::string settings;
  std::vector<std::pair<std::string, double>> measures;
};

/// The row of this scene, engine and configuration at its own settings, or null.
const WorldRow* find_row(const std::vector<WorldRow>& rows, const std::string& scene, const std::string& engine,
                         const std::string& config);

/// The rows of one scene as a table, with the ratio to Bullet in double; with the effort if it is a study.
std::string world_table_of(const std::vector<WorldRow>& rows, bool study);
/// A line a scene: this library's configurations against Bullet in double, and each other.
std::string world_summary_of(const std::vector<WorldRow>& rows);
/// A JSON array, a row a line; with the effort if it is a study.
std::string world_json_of(const std::vector<WorldRow>& rows, bool study);

}  // namespace detent_bench
