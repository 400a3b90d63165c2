#pragma once
#include "tests/campaigns/zoo/visit.h"

namespace detent_zoo {

struct RandomRun {
  uint64_t first = 0, last = 0;  ///< seeds
  std::string folder;            ///< the scenes are written there
  std::string assets;            ///< the folder of the cooked files
  std::string list_file;         ///< of the known gaps
  bool renew = false;            ///< the list is written anew
  Variation variation;
};

/// Plays the scenes in each engine, and prints those that fail, and how many fail which check on which ground. Returns
/// whether all are as the list says, or the list is written anew. On failure sets `problem`.
bool run_random(const RandomRun& run, const std::vector<Engine>& engines, std::string& problem);

}  // namespace detent_zoo
