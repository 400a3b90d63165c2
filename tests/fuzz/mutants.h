#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>

#include "tests/fuzz/target.h"

namespace detent_fuzz {

/// Gives `count` mutants of its seeds to the target, 100 times as many where DETENT_FULL is set, a sixteenth under an
/// emulator. Some must be let in, and some refused.
inline void expect_harmless(const Target& target, uint32_t count) {
  const std::vector<Bytes> seeds = target.seeds();
  for (const Bytes& seed : seeds) EXPECT_TRUE(target.take(seed));
  detent_queries::Random random(1);
  const bool emulated = getenv("DETENT_EMULATED") != nullptr;
  const uint32_t rounds = emulated ? count / 16 : getenv("DETENT_FULL") != nullptr ? 100 * count : count;
  uint32_t let_in = 0;
  for (uint32_t i = 0; i < rounds; ++i) {
    const Bytes& seed = seeds[random.below(static_cast<uint32_t>(seeds.size()))];
    let_in += target.take(detent_test::mutated(seed, random)) ? 1u : 0u;
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "mutant " << i;
      return;
    }
  }
  EXPECT_GT(let_in, 0u);
  EXPECT_LT(let_in, rounds);
  testing::Test::RecordProperty("let_in", static_cast<int>(let_in));
}

}  // namespace detent_fuzz
