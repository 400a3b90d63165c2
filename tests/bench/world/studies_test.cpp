#include "tests/bench/world/studies.h"

#include <gtest/gtest.h>
#include <math.h>

#include <algorithm>

#include "tests/campaigns/stress/scenes.h"

namespace detent_bench {

namespace {

const WorldStudy& study(const std::string& name) {
  return *std::find_if(world_studies().begin(), world_studies().end(),
                       [&name](const WorldStudy& each) { return each.scene.name == name; });
}

/// The velocity of the only body, by differences.
double speed_x(const WorldStudy& study, double seconds) {
  const Stage stage = study.scene.stage();
  return (study.exact(stage, seconds + 1e-4)[1].position[0] - study.exact(stage, seconds - 1e-4)[1].position[0]) / 2e-4;
}

TEST(studies, the_error_is_the_distance_of_the_bodies_that_move) {
  const Stage stage = detent_stress::tower(2, 0);
  States states = states_at_start(stage);
  states[0].position[0] += 9;
  EXPECT_EQ(state_error(stage, states, states_at_start(stage)), 0);
  states[1].position[1] += 0.3;
  EXPECT_NEAR(state_error(stage, states, states_at_start(stage)), 0.3 / sqrt(2), 1e-12);
}

TEST(studies, a_rotation_counts_by_what_it_moves_the_ends_of_the_axes) {
  Stage stage = detent_stress::free_rotation();
  const double radius = bounding_radius(stage.bodies[0]);
  States states = states_at_start(stage);
  const double angle = 0.2;
  states[0].rotation[1] = sin(angle / 2);
  states[0].rotation[3] = cos(angle / 2);
  const double chord = 2 * radius * sin(angle / 2);  // of two axes of three
  EXPECT_NEAR(state_error(stage, states, states_at_start(stage)), chord * sqrt(2.0 / 3), 1e-12);
  for (double& each : states[0].rotation) each = -each;  // the same rotation
  EXPECT_NEAR(state_error(stage, states, states_at_start(stage)), chord * sqrt(2.0 / 3), 1e-12);
}

TEST(studies, the_ball_comes_back_to_its_height) {
  const WorldStudy& bounce = study("S12");
  const Stage stage = bounce.scene.stage();
  const double fall = sqrt(2 * 4.5 / stage.gravity);
  EXPECT_NEAR(bounce.exact(stage, fall)[1].position[1], 0.5, 1e-9);
  EXPECT_NEAR(bounce.exact(stage, 2 * fall)[1].position[1], 5, 1e-9);
  EXPECT_NEAR(bounce.exact(stage, 2.5 * fall)[1].position[1], 5 - 4.5 / 4, 1e-9);
}

TEST(studies, the_ball_slides_to_five_sevenths_of_its_speed_and_rolls_on) {
  const WorldStudy& roll = study("roll");
  const Stage stage = roll.scene.stage();
  EXPECT_NEAR(speed_x(roll, 0.1), 6 - 0.1 * 0.3 * stage.gravity, 1e-6);
  EXPECT_NEAR(speed_x(roll, 1.5), 6 * 5.0 / 7, 1e-6);
  const auto turn = [&](double seconds) { return 2 * acos(roll.exact(stage, seconds)[1].rotation[3]); };
  EXPECT_NEAR((turn(0.62) - turn(0.61)) / 0.01 * 0.5, 6 * 5.0 / 7, 1e-6);  // without slip
}

TEST(studies, the_box_slides_by_what_friction_leaves_of_its_pull) {
  const WorldStudy& slide = study("S9");
  const Stage stage = slide.scene.stage();
  const auto start = slide.exact(stage, 0)[1], end = slide.exact(stage, 2)[1];
  const double x = end.position[0] - start.position[0], y = end.position[1] - start.position[1];
  EXPECT_NEAR(y / x, -0.75, 1e-9);
  EXPECT_NEAR(sqrt(x * x + y * y), 2 * stage.gravity * (0.6 - 0.5 * 0.8), 1e-9);
}

TEST(studies, each_has_one_window_and_is_compared_within_it) {
  for (const WorldStudy& each : world_studies()) {
    ASSERT_EQ(each.scene.windows.size(), 1u) << each.scene.name;
    EXPECT_GT(each.compared_until, each.scene.windows[0].first) << each.scene.name;
    EXPECT_LE(each.compared_until, each.scene.windows[0].end) << each.scene.name;
  }
}

}  // namespace

}  // namespace detent_bench
