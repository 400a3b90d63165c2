#include "tests/fuzz/mutants.h"

#include "tests/fuzz/targets.h"
#include "tests/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(mutants, of_snapshots_are_refused_or_harmless) { detent_fuzz::expect_harmless(k_snapshot_target, 2500); }

DETENT_TEST(mutants, of_recordings_are_refused_or_harmless) { detent_fuzz::expect_harmless(k_recording_target, 2500); }

DETENT_TEST(mutants, of_cooked_assets_are_refused_or_harmless) { detent_fuzz::expect_harmless(k_assets_target, 2500); }

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
