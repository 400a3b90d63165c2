#include "tests/campaigns/fuzz/tool.h"

#include "tests/campaigns/fuzz/mutants.h"

namespace {

TEST(mutants, of_scenes_are_refused_or_played) {
  detent_fuzz::expect_harmless(detent_fuzz::k_scenes_target, 2000);
  detent_fuzz::expect_cases_harmless(detent_fuzz::k_scenes_target, "scenes");
}

TEST(mutants, of_compressed_recordings_are_refused_or_unpacked) {
  if (detent_fuzz::k_packed_target.seeds().empty()) GTEST_SKIP() << "built without zstd";
  detent_fuzz::expect_harmless(detent_fuzz::k_packed_target, 2000);
  detent_fuzz::expect_cases_harmless(detent_fuzz::k_packed_target, "packed");
}

}  // namespace
