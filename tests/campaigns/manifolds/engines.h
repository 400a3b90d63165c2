#pragma once
#include <vector>

#include "tests/campaigns/manifolds/run.h"

namespace detent_manifolds {

/// The library in each configuration of this build.
std::vector<Engine> all_engines();

}  // namespace detent_manifolds
