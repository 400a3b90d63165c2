#pragma once
#include <stdint.h>
#include <stdlib.h>

namespace detent_oracle {

/// How often a test with random cases runs: `count`, and 20 times that when DETENT_FULL is set.
inline uint32_t rounds(uint32_t count) { return getenv("DETENT_FULL") != nullptr ? 20 * count : count; }

}  // namespace detent_oracle
