#pragma once
#include <stdint.h>
#include <stdlib.h>

namespace detent_oracle {

/// How often a test with random cases runs: `count`; 20 times that when DETENT_FULL is set, a quarter under an emulator
/// (DETENT_EMULATED, which tests/CMakeLists.txt sets).
inline uint32_t rounds(uint32_t count) {
  if (getenv("DETENT_FULL") != nullptr) return 20 * count;
  return getenv("DETENT_EMULATED") != nullptr ? (count + 3) / 4 : count;
}

}  // namespace detent_oracle
