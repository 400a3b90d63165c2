#pragma once
#include <string>

#include "tests/bench/world/engine.h"

namespace detent_bench {

/// Every engine of this build: the library's configurations, then the peers whose modules could be loaded. Where one
/// could not, `problem` says why.
WorldEngineList all_world_engines(std::string& problem);

}  // namespace detent_bench
