#include "tests/campaigns/fuzz/readers.h"

#include "tests/campaigns/fuzz/mutants.h"

namespace {

TEST(mutants, of_text_and_pictures_are_refused_or_cooked_or_named) {
  detent_fuzz::expect_harmless(detent_fuzz::k_readers_target, 10000);
  detent_fuzz::expect_cases_harmless(detent_fuzz::k_readers_target, "readers");
}

}  // namespace
