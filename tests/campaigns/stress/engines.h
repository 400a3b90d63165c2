#pragma once
#include <vector>

#include "tests/campaigns/stress/run.h"

namespace detent_stress {

/// The library in each configuration of this build.
std::vector<Engine> all_engines();

}  // namespace detent_stress
