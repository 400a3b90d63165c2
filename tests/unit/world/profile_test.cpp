#include <detent/world.h>

#include <string>

#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A clock that increases by one at each call.
uint64_t count_up(void* user) { return ++*static_cast<uint64_t*>(user); }

DETENT_TEST(profile, every_stage_of_a_step_is_timed_once_and_the_state_is_the_same) {
  Lab plain = make_pile(), timed = make_pile();
  uint64_t clock = 100;
  Profile profile;
  profile.now = count_up;
  profile.user = &clock;
  timed.world.hooks.profile = &profile;
  plain.run(10);
  timed.run(10);
  EXPECT_EQ(digest(plain.world), digest(timed.world));
  EXPECT_EQ(profile.steps, 10u);
  for (const uint64_t ticks : profile.ticks) EXPECT_EQ(ticks, 10u);
  EXPECT_EQ(clock, 100 + 10 * (k_step_stage_count + 1));
  profile.now = nullptr;
  timed.run(1);
  EXPECT_EQ(profile.steps, 10u);
}

DETENT_TEST(profile, an_idle_step_is_not_timed) {
  Lab lab({1, 1, 0}, {}, true);
  lab.add_ground();
  uint64_t clock = 0;
  Profile profile;
  profile.now = count_up;
  profile.user = &clock;
  lab.run(2);
  lab.world.hooks.profile = &profile;
  lab.run(2);
  EXPECT_EQ(profile.steps, 0u);
}

DETENT_TEST(profile, stages_have_names) {
  EXPECT_EQ(std::string(stage_name(StepStage::find_pairs)), "find_pairs");
  EXPECT_EQ(std::string(stage_name(StepStage::store)), "store");
  EXPECT_EQ(std::string(stage_name(static_cast<StepStage>(k_step_stage_count))), "");
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
