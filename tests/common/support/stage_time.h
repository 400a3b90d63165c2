#pragma once
#include <stdint.h>

#include <vector>

namespace detent_test {

/// The time that a stage of the steps has taken so far.
struct StageTime {
  const char* name;
  uint64_t ns;
};

/// Of all stages of a step in their order; empty for an engine that does not tell.
using StageTimes = std::vector<StageTime>;

}  // namespace detent_test
