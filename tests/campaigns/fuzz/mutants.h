#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/campaigns/fuzz/target.h"

namespace detent_fuzz {

/// How many inputs a target is given: as many as DETENT_MUTANTS says; 100 times `count` where DETENT_FULL is set, a
/// sixteenth under an emulator.
inline uint32_t rounds_of(uint32_t count) {
  if (const char* const told = getenv("DETENT_MUTANTS")) return static_cast<uint32_t>(strtoul(told, nullptr, 10));
  if (getenv("DETENT_EMULATED") != nullptr) return count / 16;
  return getenv("DETENT_FULL") != nullptr ? 100 * count : count;
}

/// Gives the target as many of what `next` makes. Some must be let in, and some refused.
template <class Next>
void expect_some_let_in(const Target& target, uint32_t rounds, const Next& next) {
  uint32_t let_in = 0;
  for (uint32_t i = 0; i < rounds; ++i) {
    let_in += target.take(next()) ? 1u : 0u;
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "input " << i;
      return;
    }
  }
  EXPECT_GT(let_in, 0u);
  EXPECT_LT(let_in, rounds);
  testing::Test::RecordProperty("inputs", static_cast<int>(rounds));
  testing::Test::RecordProperty("let_in", static_cast<int>(let_in));
}

/// Mutants of its seeds.
inline void expect_harmless(const Target& target, uint32_t count) {
  const std::vector<Bytes> seeds = target.seeds();
  for (const Bytes& seed : seeds) EXPECT_TRUE(target.take(seed));
  detent_queries::Random random(1);
  expect_some_let_in(target, rounds_of(count), [&] {
    return detent_test::mutated(seeds[random.below(static_cast<uint32_t>(seeds.size()))], random);
  });
}

/// What once did harm: the files of tests/campaigns/fuzz/cases/`name`, as libFuzzer wrote them, whose first byte is
/// main.cpp's.
inline void expect_cases_harmless(const Target& target, const char* name) {
  std::error_code error;
  for (std::filesystem::directory_iterator at(std::filesystem::path(DETENT_FUZZ_CASES) / name, error), end;
       !error && at != end; at.increment(error)) {
    std::ifstream file(at->path(), std::ios::binary);
    const Bytes bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    ASSERT_FALSE(bytes.empty()) << at->path().filename();
    target.take({bytes.begin() + 1, bytes.end()});
    EXPECT_FALSE(testing::Test::HasFailure()) << at->path().filename();
  }
}

/// Random bytes, for a target whose calls they decide.
inline void expect_harmless_tapes(const Target& target, uint32_t count) {
  detent_queries::Random random(1);
  expect_some_let_in(target, rounds_of(count), [&] {
    Bytes tape(100 + random.below(2000));
    for (uint8_t& byte : tape) byte = static_cast<uint8_t>(random.below(256));
    return tape;
  });
}

}  // namespace detent_fuzz
