#include "delta_debugging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

/// The search of `detent shrink`, over predicates without recordings.
namespace detent_tool {
namespace {

Units first_units(uint32_t count) {
  Units units(count);
  std::iota(units.begin(), units.end(), 0u);
  return units;
}

bool has(const Units& units, uint32_t unit) { return std::binary_search(units.begin(), units.end(), unit); }

constexpr uint32_t k_no_limit = UINT32_MAX;

TEST(delta_debugging, finds_two_units_of_a_thousand_with_few_trials) {
  for (const uint32_t other : {1u, 499u, 500u, 999u}) {
    Trials trials(k_no_limit);
    const auto shows = [&](const Units& units) { return has(units, 0) && has(units, other); };
    EXPECT_EQ(minimise(first_units(1000), {}, trials, shows), (Units{0, other}));
    EXPECT_LE(trials.made(), 60u);
  }
}

TEST(delta_debugging, tries_all_at_first) {
  Trials trials(k_no_limit);
  EXPECT_TRUE(minimise(first_units(1000), {}, trials, [](const Units&) { return true; }).empty());
  EXPECT_EQ(trials.made(), 1u);
  EXPECT_TRUE(minimise({}, {}, trials, [](const Units&) { return true; }).empty());
}

TEST(delta_debugging, keeps_the_other_units) {
  Trials trials(k_no_limit);
  const Units others = {1, 5, 9};
  const Units found = minimise({0, 2, 6, 20}, others, trials, [&](const Units& units) {
    EXPECT_TRUE(std::includes(units.begin(), units.end(), others.begin(), others.end()));
    EXPECT_TRUE(std::is_sorted(units.begin(), units.end()));
    return has(units, 6);
  });
  EXPECT_EQ(found, (Units{6}));
}

TEST(delta_debugging, leaves_units_of_which_none_can_be_left_out) {
  const Units all = first_units(40);
  Trials trials(k_no_limit);
  EXPECT_EQ(minimise(all, {}, trials, [&](const Units& units) { return units == all; }), all);
  // Units 30 and 31 can only be left out together, and 5 only without them.
  const auto shows = [](const Units& units) {
    const bool pair = has(units, 30) && has(units, 31), none = !has(units, 30) && !has(units, 31);
    return has(units, 7) && (pair || none) && (has(units, 5) || none);
  };
  trials.forget();
  EXPECT_EQ(minimise(all, {}, trials, shows), (Units{7}));
}

TEST(delta_debugging, goes_over_single_units_until_none_can_be_left_out) {
  // Unit 3 can be left out only after 5, and 1 only after 3: a pass from the front finds one of them.
  const auto shows = [](const Units& units) {
    const bool even = has(units, 0) && has(units, 2) && has(units, 4);
    return even && has(units, 1) >= has(units, 3) && has(units, 3) >= has(units, 5);
  };
  Trials trials(k_no_limit);
  EXPECT_EQ(minimise(first_units(6), {}, trials, shows), (Units{0, 2, 4}));
}

TEST(delta_debugging, asks_about_no_units_twice_that_do_not_show_the_fault) {
  Trials trials(k_no_limit);
  std::set<Units> asked;
  const auto shows = [&](const Units& units) {
    EXPECT_TRUE(asked.insert(units).second);
    return has(units, 1) && has(units, 2) && has(units, 6);
  };
  const Units found = minimise(first_units(8), {}, trials, shows);
  EXPECT_EQ(found, (Units{1, 2, 6}));
  EXPECT_EQ(minimise(found, {}, trials, shows), found);
  EXPECT_EQ(trials.made(), asked.size());
  EXPECT_FALSE(trials.limit_reached());
  asked.clear();
  trials.forget();
  EXPECT_EQ(minimise(found, {}, trials, shows), found);
  // None, {6}, {1, 2}, {2, 6} and {1, 6}: {1, 2} is not asked about again.
  EXPECT_EQ(asked.size(), 5u);
}

TEST(delta_debugging, stops_at_the_limit_with_the_fewest_found) {
  Trials trials(6);
  uint32_t asked = 0;
  const auto shows = [&](const Units& units) {
    ++asked;
    return has(units, 0) && has(units, 900);
  };
  const Units found = minimise(first_units(1000), {}, trials, shows);
  EXPECT_EQ(asked, 6u);
  EXPECT_EQ(trials.made(), 6u);
  EXPECT_TRUE(trials.limit_reached());
  EXPECT_TRUE(has(found, 0) && has(found, 900));
  EXPECT_LT(found.size(), 1000u);
  EXPECT_GT(found.size(), 2u);
  EXPECT_FALSE(trials.take());
}

TEST(delta_debugging, ends_at_once_at_the_limit) {
  Trials trials(1);
  const Units all = first_units(1000000);  // one by one it would take hours
  EXPECT_EQ(minimise(all, {}, trials, [&](const Units& units) { return units.size() == all.size(); }), all);
}

}  // namespace
}  // namespace detent_tool
