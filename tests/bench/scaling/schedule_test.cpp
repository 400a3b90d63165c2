#include "tests/bench/scaling/schedule.h"

#include <gtest/gtest.h>

namespace detent_bench {
namespace {

TEST(schedule, gives_each_part_to_the_thread_that_is_free_first) {
  const TickRecord tick = {100, 1, {{{30, 10, 10, 10}}}};
  EXPECT_EQ(scheduled_ns(tick, 1, {}), 100);
  EXPECT_EQ(scheduled_ns(tick, 2, {}), 40 + 30);  // 30 beside 10 + 10 + 10
  EXPECT_EQ(scheduled_ns(tick, 3, {}), 40 + 30);
  EXPECT_DOUBLE_EQ(shared_part(tick), 0.6);
}

TEST(schedule, counts_what_sharing_costs) {
  const TickRecord tick = {100, 2, {{{20, 20}}, {{10, 10}}}};
  EXPECT_EQ(scheduled_ns(tick, 2, {1, 5}), 40 + 20 + 10 + 2 * 1 + 2 * 5);
  EXPECT_EQ(scheduled_ns(tick, 64, {1, 5}), 40 + 20 + 10 + 2 * 6 + 2 * 5);  // six doublings
  EXPECT_EQ(scheduled_ns(tick, 1, {1, 5}), 100);
}

}  // namespace
}  // namespace detent_bench
