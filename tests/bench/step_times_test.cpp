#include "tests/bench/step_times.h"

#include <gtest/gtest.h>

namespace detent_bench {

namespace {

TEST(step_times, median_and_percentile_and_worst_are_those_of_the_ticks) {
  std::vector<double> us;
  for (int i = 1000; i > 0; --i) us.push_back(i);
  const StepTimes times = step_times(us);
  EXPECT_EQ(times.mean, 500.5);
  EXPECT_EQ(times.median, 500);
  EXPECT_EQ(times.p99, 990);
  EXPECT_EQ(times.max, 1000);
}

TEST(step_times, one_tick_is_all_of_them_and_none_is_zero) {
  EXPECT_EQ(step_times({7}).median, 7);
  EXPECT_EQ(step_times({7}).p99, 7);
  EXPECT_EQ(step_times({}).max, 0);
}

TEST(step_times, a_tick_counts_by_its_least_repetition_and_not_at_all_without_one) {
  LeastTimes least(4);
  for (size_t tick = 0; tick < 3; ++tick) least.take(tick, 10.0 * static_cast<double>(tick + 1));
  least.take(2, 5);
  least.take(0, 90);
  const StepTimes times = least.summary();
  EXPECT_EQ(times.max, 20);
  EXPECT_NEAR(times.mean, 35.0 / 3, 1e-12);
  EXPECT_EQ(LeastTimes(4).summary().max, 0);
}

TEST(step_times, an_interrupted_step_counts_by_the_time_of_its_thread) {
  Interruptions interruptions;
  EXPECT_LT(interruptions.us_of([] { return 1e9; }), 1e5);  // a second by the clock, in which the thread did nothing
  EXPECT_EQ(interruptions.interrupted(), 1u);
  EXPECT_LT(interruptions.us_of([] { return 50.0; }), 0.051);
}

TEST(step_times, short_steps_are_not_asked_about) {
  Interruptions interruptions;
  for (int i = 0; i < 10; ++i) interruptions.us_of([] { return 50.0; });
  EXPECT_EQ(interruptions.asked(), 1u);
  for (int i = 0; i < 10; ++i) interruptions.us_of([] { return 5000.0; });
  EXPECT_EQ(interruptions.asked(), 10u);  // all but the one after the last short step
}

TEST(stages, shares_are_of_the_time_between_two_readings) {
  const StageShares shares = stage_shares({{"a", 100}, {"b", 100}}, {{"a", 130}, {"b", 110}});
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].first, "a");
  EXPECT_NEAR(shares[0].second, 0.75, 1e-12);
  EXPECT_NEAR(shares[1].second, 0.25, 1e-12);
  EXPECT_NEAR(stage_shares({}, {{"a", 1}, {"b", 3}})[1].second, 0.75, 1e-12);
}

TEST(stages, without_time_there_are_no_shares) {
  EXPECT_TRUE(stage_shares({}, {}).empty());
  EXPECT_TRUE(stage_shares({{"a", 5}}, {{"a", 5}}).empty());
}

TEST(stages, the_text_has_the_two_greatest) {
  EXPECT_EQ(stages_text({{"a", 0.1}, {"b", 0.3}, {"c", 0.6}}), "c 60 %, b 30 %");
  EXPECT_EQ(stages_text({}), "");
}

}  // namespace

}  // namespace detent_bench
