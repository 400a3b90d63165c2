#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/campaigns/sequences/digests.h"
#include "tests/campaigns/sequences/game.h"
#include "tests/common/oracle/effort.h"

#define DETENT_TEXT(name) DETENT_TEXT_OF(name)
#define DETENT_TEXT_OF(name) #name

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_block = 100;  ///< sequences of one digest
constexpr char k_name[] = DETENT_TEXT(DETENT_NAMESPACE);

uint64_t play(uint32_t first, uint32_t count) {
  uint64_t running = 0;
  for (uint32_t seed = first; seed < first + count; ++seed) {
    running = digest_step(running, Game(Draw(seed, seed % 4 == 0)).play());
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "sequence " << seed;
      return 0;
    }
  }
  return digest_finish(running);
}

/// What a number of the environment says, or `otherwise`.
uint32_t number_of(const char* variable, uint32_t otherwise) {
  const char* text = getenv(variable);
  return text == nullptr ? otherwise : static_cast<uint32_t>(strtoul(text, nullptr, 10));
}

/// DETENT_SEQUENCES and DETENT_SEQUENCES_FIRST ask for others than the usual ones, whose digests are then printed.
DETENT_TEST(sequences, random_calls_do_what_is_written_of_them_and_have_the_recorded_digests) {
  const bool printed = getenv("DETENT_SEQUENCES") != nullptr;
  const uint32_t count = number_of("DETENT_SEQUENCES", detent_oracle::rounds(400));
  const uint32_t first = number_of("DETENT_SEQUENCES_FIRST", 1);
  for (uint32_t done = 0; done < count; done += k_block) {
    const uint32_t at = first + done, left = count - done;
    const uint64_t digest = play(at, left < k_block ? left : k_block);
    if (HasFailure()) return;
    if (printed) {
      printf("sequences %s %" PRIu32 " %016" PRIx64 "\n", k_name, at, digest);
      fflush(stdout);
      continue;
    }
    for (const SequencesDigest& recorded : k_sequences_digests) {
      if (recorded.first == at && strcmp(recorded.config, k_name) == 0) {
        EXPECT_EQ(digest, recorded.digest) << "sequences from " << at << " on (tests/campaigns/sequences/regenerate)";
      }
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
