#include "tests/campaigns/fuzz/mutants.h"

#include "tests/campaigns/fuzz/targets.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_fuzz;

DETENT_TEST(mutants, of_snapshots_are_refused_or_harmless) { expect_harmless(k_snapshot_target, 2500); }

DETENT_TEST(mutants, of_deltas_are_refused_or_harmless) { expect_harmless(k_delta_target, 1000); }

DETENT_TEST(mutants, of_recordings_are_refused_or_harmless) { expect_harmless(k_recording_target, 2500); }

DETENT_TEST(mutants, of_cooked_assets_are_refused_or_harmless) { expect_harmless(k_assets_target, 2500); }

DETENT_TEST(tapes, of_what_a_session_hears_leave_what_is_confirmed) { expect_harmless_tapes(k_session_target, 400); }

DETENT_TEST(cases, that_once_did_harm_do_none) {
  expect_cases_harmless(k_snapshot_target, "snapshot");
  expect_cases_harmless(k_delta_target, "delta");
  expect_cases_harmless(k_recording_target, "recording");
  expect_cases_harmless(k_assets_target, "assets");
  expect_cases_harmless(k_session_target, "session");
  expect_cases_harmless(k_calls_target, "calls");
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
