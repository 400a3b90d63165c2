#pragma once
#include <vector>

#include "tests/campaigns/joint_fuzz/run.h"

namespace detent_joint_fuzz {

/// The library in each configuration of this build.
std::vector<Engine> all_engines();

}  // namespace detent_joint_fuzz
