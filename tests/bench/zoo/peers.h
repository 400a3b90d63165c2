#pragma once
#include "tests/campaigns/zoo/frame.h"

namespace detent_zoo {

/// Those of this build: bullet, ode. What one cannot express it does not open, and says what.
std::vector<Engine> all_peers();

}  // namespace detent_zoo
