#include "tests/bench/world/watch.h"

#include <gtest/gtest.h>
#include <math.h>

#include "tests/campaigns/stress/scenes.h"

namespace detent_bench {

namespace {

using detent_stress::DepthMeter;
using detent_stress::Role;

/// NaN if there is none of this name.
double measure(const Watch& watch, const States& states, const std::string& name) {
  for (const auto& [key, value] : watch.measures(states)) {
    if (key == name) return value;
  }
  return NAN;
}

/// Turned about z.
void rotation_vector(detent_stress::BodyState& state, double angle) {
  state.rotation[2] = sin(angle / 2);
  state.rotation[3] = cos(angle / 2);
}

TEST(watch, energy_of_a_fall_stays_and_of_a_halt_is_lost) {
  const Stage stage = detent_stress::bounce(5, 1);
  const DepthMeter depths(stage);
  Watch watch(stage, depths);
  States states = states_at_start(stage);
  watch.begin(states);
  states[1].position[1] -= 2;
  states[1].linear_velocity[1] = -sqrt(2 * stage.gravity * 2);
  EXPECT_NEAR(measure(watch, states, "energy"), 0, 1e-12);
  states[1].linear_velocity[1] = 0;
  EXPECT_NEAR(measure(watch, states, "energy"), -2 * stage.gravity, 1e-12);
}

TEST(watch, the_walls_of_the_pit_have_not_escaped_but_what_is_beyond_them_has) {
  const Stage stage = detent_stress::pit(64, 1);
  const DepthMeter depths(stage);
  Watch watch(stage, depths);
  States states = states_at_start(stage);
  watch.begin(states);
  EXPECT_EQ(measure(watch, states, "escaped"), 0);
  states[10].position[0] = 5.6;
  states[11].position[1] = -0.6;
  states[12].position[2] = -5.6;
  EXPECT_EQ(measure(watch, states, "escaped"), 3);
}

TEST(watch, a_domino_falls_once_and_the_last_one_gives_the_time) {
  const Stage stage = detent_stress::dominoes(3);
  const DepthMeter depths(stage);
  Watch watch(stage, depths);
  States states = states_at_start(stage);
  watch.begin(states);
  watch.tick(states, 0);
  EXPECT_EQ(measure(watch, states, "fallen"), 0);
  rotation_vector(states[1], -1.1);
  watch.tick(states, 1);
  rotation_vector(states[2], -1.1);
  states[2].position[2] = -0.25;
  watch.tick(states, 2);
  watch.tick(states, 3);
  EXPECT_EQ(measure(watch, states, "fallen"), 2);
  EXPECT_EQ(measure(watch, states, "last_fall_s"), 3 * stage.tick);
  EXPECT_EQ(measure(watch, states, "drift"), 0.25);
}

TEST(watch, a_scene_is_asleep_after_the_last_tick_that_moved_a_body) {
  const Stage stage = detent_stress::sleep_stacks(1, 2, true);
  const DepthMeter depths(stage);
  Watch watch(stage, depths);
  States states = states_at_start(stage);
  watch.begin(states);
  for (uint32_t tick = 0; tick < 10; ++tick) {
    if (tick == 4) states[2].position[0] += 1e-9;
    watch.tick(states, tick);
  }
  EXPECT_EQ(measure(watch, states, "ticks_until_asleep"), 5);
}

TEST(watch, a_chain_is_judged_by_its_stretch_alone) {
  const Stage stage = detent_stress::chain(4, 10);
  const DepthMeter depths(stage);
  Watch watch(stage, depths);
  States states = states_at_start(stage);
  watch.begin(states);
  for (const double gap : {0.0, 0.2, 0.3, 0.1, 0.02, 0.04}) {
    states[5].position[1] = -gap;
    watch.tick(states, 0);
  }
  EXPECT_NEAR(measure(watch, states, "stretch_max"), 0.15, 1e-12);
  EXPECT_NEAR(measure(watch, states, "stretch_late"), 0.015, 1e-12);
  EXPECT_TRUE(isnan(measure(watch, states, "penetration_max")));
}

TEST(watch, depths_and_speeds_are_of_the_window_alone) {
  const Stage stage = detent_stress::tower(2, 0);
  const DepthMeter depths(stage);
  Watch watch(stage, depths);
  States states = states_at_start(stage);
  watch.begin(states);
  watch.begin_window();
  states[2].position[1] -= 0.25;
  watch.sample(states);
  EXPECT_NEAR(measure(watch, states, "penetration_max"), 0.25, 1e-5);
  watch.begin_window();
  states[2].position[1] += 0.125;
  states[2].linear_velocity[0] = 3;
  watch.sample(states);
  states[2].position[1] += 0.0625;
  states[2].linear_velocity[0] = 1;
  watch.sample(states);
  EXPECT_NEAR(measure(watch, states, "penetration_max"), 0.125, 1e-5);
  EXPECT_NEAR(measure(watch, states, "penetration_mean"), 0.09375, 1e-5);
  EXPECT_NEAR(measure(watch, states, "speed_mean"), 1, 1e-12);
  EXPECT_NEAR(measure(watch, states, "sag"), 0.0625, 1e-12);
}

}  // namespace

}  // namespace detent_bench
