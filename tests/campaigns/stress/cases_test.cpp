#include "tests/campaigns/stress/cases.h"
#include "tests/campaigns/stress/bounds.h"
#include "tests/campaigns/stress/run_detent.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_stress::Case;
using detent_stress::Effort;
using detent_stress::Measured;
using detent_stress::Outcome;
using detent_stress::Trial;

/// Checks that all measures of a group of scenes at a scale are within their bounds: the target, or the regression
/// bound.
void expect_reached(const std::string& group, double scale) {
  const uint32_t effort = detent_oracle::rounds(4);
  Trial trial;
  trial.engine = stress_engine();
  trial.scale = scale;
  trial.effort = effort > 4 ? Effort::full : effort == 4 ? Effort::brief : Effort::tiny;
  const uint64_t seeds = effort > 4 ? 5 : effort == 4 && scale == 1 ? 2 : 1;
  for (const Case& which : detent_stress::all_cases()) {
    if (which.group != group || which.extra) continue;
    for (trial.seed = 0; trial.seed < seeds; ++trial.seed) {
      const std::string name = which.name + " seed " + std::to_string(trial.seed) + ": ";
      const Outcome outcome = run_case(which, trial);
      const bool refused = detent_stress::is_refused(which.name, trial.engine.config, scale);
      if (outcome.problem.empty() == refused) ADD_FAILURE() << name << (refused ? "not refused" : outcome.problem);
      for (const Measured& measured : outcome.measured) {
        const auto* wanted = detent_stress::find_wanted(which.name, measured.name);
        if (wanted == nullptr) continue;
        const auto* gap = detent_stress::find_gap(which.name, trial.engine.config, scale, measured.name);
        const double held = gap != nullptr ? gap->held : wanted->bound;
        if (!(measured.value <= held)) {
          ADD_FAILURE() << name << measured.name << " is " << measured.value << ", held to " << held << ", wanted "
                        << wanted->bound;
        }
      }
    }
  }
}

// For S5 a wall of 0.1 mm is below the least size of a shape, so its smallest scale is 1.25 cm.
constexpr double k_small = 0.01, k_small_wall = 0.0125, k_large = 100;

DETENT_TEST(stress, a_pyramid_stands) { expect_reached("S1", 1); }
DETENT_TEST(stress, a_pyramid_stands_at_1_cm) { expect_reached("S1", k_small); }
DETENT_TEST(stress, a_pyramid_stands_at_100_m) { expect_reached("S1", k_large); }
DETENT_TEST(stress, towers_stand) { expect_reached("S2", 1); }
DETENT_TEST(stress, towers_stand_at_1_cm) { expect_reached("S2", k_small); }
DETENT_TEST(stress, towers_stand_at_100_m) { expect_reached("S2", k_large); }
DETENT_TEST(stress, heavy_things_rest_on_light_ones) { expect_reached("S3", 1); }
DETENT_TEST(stress, heavy_things_rest_on_light_ones_at_1_cm) { expect_reached("S3", k_small); }
DETENT_TEST(stress, heavy_things_rest_on_light_ones_at_100_m) { expect_reached("S3", k_large); }
DETENT_TEST(stress, a_pit_keeps_what_falls_into_it) { expect_reached("S4", 1); }
DETENT_TEST(stress, a_pit_keeps_what_falls_into_it_at_1_cm) { expect_reached("S4", k_small); }
DETENT_TEST(stress, a_pit_keeps_what_falls_into_it_at_100_m) { expect_reached("S4", k_large); }
DETENT_TEST(stress, nothing_passes_through_paper) { expect_reached("S5", 1); }
DETENT_TEST(stress, nothing_passes_through_paper_at_1_cm) { expect_reached("S5", k_small_wall); }
DETENT_TEST(stress, nothing_passes_through_paper_at_100_m) { expect_reached("S5", k_large); }
DETENT_TEST(stress, a_chain_holds_a_weight) { expect_reached("S6", 1); }
DETENT_TEST(stress, a_chain_holds_a_weight_at_1_cm) { expect_reached("S6", k_small); }
DETENT_TEST(stress, a_chain_holds_a_weight_at_100_m) { expect_reached("S6", k_large); }
DETENT_TEST(stress, a_thrown_racket_flips_as_euler_says) { expect_reached("S7", 1); }
DETENT_TEST(stress, a_thrown_racket_flips_as_euler_says_at_1_cm) { expect_reached("S7", k_small); }
DETENT_TEST(stress, a_thrown_racket_flips_as_euler_says_at_100_m) { expect_reached("S7", k_large); }
DETENT_TEST(stress, dominoes_fall_one_after_the_other) { expect_reached("S8", 1); }
DETENT_TEST(stress, dominoes_fall_one_after_the_other_at_1_cm) { expect_reached("S8", k_small); }
DETENT_TEST(stress, dominoes_fall_one_after_the_other_at_100_m) { expect_reached("S8", k_large); }
DETENT_TEST(stress, friction_decides_on_a_slope) { expect_reached("S9", 1); }
DETENT_TEST(stress, friction_decides_on_a_slope_at_1_cm) { expect_reached("S9", k_small); }
DETENT_TEST(stress, friction_decides_on_a_slope_at_100_m) { expect_reached("S9", k_large); }
DETENT_TEST(stress, stacks_stand_and_fall_asleep) { expect_reached("S10", 1); }
DETENT_TEST(stress, stacks_stand_and_fall_asleep_at_1_cm) { expect_reached("S10", k_small); }
DETENT_TEST(stress, stacks_stand_and_fall_asleep_at_100_m) { expect_reached("S10", k_large); }
DETENT_TEST(stress, far_away_everything_moves_by_the_same_bits) { expect_reached("S11", 1); }
DETENT_TEST(stress, a_ball_bounces_as_high_as_it_fell) { expect_reached("S12", 1); }
DETENT_TEST(stress, a_ball_bounces_as_high_as_it_fell_at_1_cm) { expect_reached("S12", k_small); }
DETENT_TEST(stress, a_ball_bounces_as_high_as_it_fell_at_100_m) { expect_reached("S12", k_large); }

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
