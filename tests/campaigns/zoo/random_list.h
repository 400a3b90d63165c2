#pragma once
#include "tests/campaigns/zoo/list.h"

/// Random scenes as rows of a list. random.csv has those that fail today.
namespace detent_zoo {

inline constexpr uint64_t k_seeds_tested = 200;  ///< the test plays the seeds from 1 to this one

/// Writes the scene with this seed into the folder, as random_<seed>.json, and returns its row. The row's source is the
/// kind of the ground; its gaps are those of `known`. `assets`: the folder of the cooked files. On failure sets
/// `problem`.
Entry write_random_scene(uint64_t seed, const std::string& folder, const std::string& assets,
                         const std::vector<Entry>& known, std::string& problem);

}  // namespace detent_zoo
