#include "tests/campaigns/fuzz/packets.h"

#include "tests/campaigns/fuzz/mutants.h"

namespace {

TEST(mutants, of_what_machines_of_a_match_tell_are_refused_or_mean_what_they_say) {
  detent_fuzz::expect_harmless(detent_fuzz::k_packets_target, 20000);
  detent_fuzz::expect_cases_harmless(detent_fuzz::k_packets_target, "packets");
}

}  // namespace
