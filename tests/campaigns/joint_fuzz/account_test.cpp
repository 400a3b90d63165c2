#include "tests/campaigns/joint_fuzz/account.h"

#include <gtest/gtest.h>

#include <cmath>

namespace detent_joint_fuzz {
namespace {

const double k_half = std::sqrt(0.5);
const Rotation k_x_to_y = {0, 0, k_half, k_half};  ///< a rotation by 90 degrees about z

/// Two bodies, the first a wall at the origin.
Scene scene_with(const SceneJoint& joint) {
  Scene scene;
  scene.gravity = 9.81;
  scene.extent = 2;
  scene.bodies.resize(2);
  scene.bodies[0].fixed = true;
  scene.joints = {joint};
  scene.joints[0].b = 1;
  return scene;
}

TEST(joint_fuzz_account, energy_is_that_of_the_motion_the_turn_and_the_height) {
  const Scene scene = scene_with({});
  const std::vector<Inertia> inertia = {{}, {2, {1, 2, 3}}};
  // The rotation about the world's y is about the body's x.
  const States states = {{}, {{5, 7, 0}, k_x_to_y, {0, 0, 3}, {0, 4, 0}}};
  EXPECT_NEAR(energy_of(scene, inertia, states), 9 + 8 + 2 * 9.81 * 7, 1e-9);
  EXPECT_NEAR(energy_of(scene, inertia, {{}, {{5, 7, 0}, k_x_to_y, {0, 3, 0}, {0, 4, 0}}}, 0.5), 9 + 8 + 2 * 9.81 * 5.5,
              1e-9);
  EXPECT_NEAR(scale_of(scene, inertia, states), 9 + 8 + 0.1 * 2 * 9.81 * 2, 1e-3);
}

TEST(joint_fuzz_account, gaps_are_what_a_joint_does_not_leave_free) {
  // B is rotated about z by 90 degrees, and its anchor is at (3, 4, 0) from A's.
  const States states = {{}, {{3, 4, 0}, k_x_to_y, {}, {}}};
  const double quarter = std::acos(0.0);
  const auto gap_as = [&](Hold hold, double upper) {
    SceneJoint joint;
    joint.hold = hold;
    joint.axis.upper = upper;
    return gap_of(scene_with(joint).joints[0], states);
  };
  EXPECT_NEAR(gap_as(Hold::ball, 0).length, 5, 1e-12);
  EXPECT_EQ(gap_as(Hold::ball, 0).angle, 0);
  EXPECT_NEAR(gap_as(Hold::hinge, 0).angle, quarter, 1e-9);
  EXPECT_NEAR(gap_as(Hold::fixed, 0).angle, quarter, 1e-9);
  EXPECT_NEAR(gap_as(Hold::slider, 0).length, 4, 1e-12);
  EXPECT_NEAR(gap_as(Hold::slider, 0).angle, quarter, 1e-9);
  EXPECT_NEAR(gap_as(Hold::wheel, 0).angle, 0, 1e-9);
  EXPECT_NEAR(gap_as(Hold::distance, 4.5).length, 0.5, 1e-12);
  EXPECT_EQ(gap_as(Hold::distance, 6).length, 0);
}

TEST(joint_fuzz_account, drives_give_their_force_times_the_rate_and_brakes_nothing) {
  const States states = {{}, {{2, 0, 0}, {0, 0, 0, 1}, {3, 4, 0}, {0, 0, 7}}};
  SceneJoint joint;
  joint.hold = Hold::distance;
  joint.axis.force_max = 10;
  EXPECT_EQ(power_max(scene_with(joint), states), 0) << "a brake";
  joint.axis.speed = 1;
  EXPECT_NEAR(power_max(scene_with(joint), states), 10 * 3, 1e-9) << "along the way between the anchors";
  joint.axis.speed = -8;
  EXPECT_NEAR(power_max(scene_with(joint), states), 10 * 8, 1e-9);
  joint.hold = Hold::hinge;
  joint.axis = {.frequency = 2, .force_max = 10};
  EXPECT_NEAR(power_max(scene_with(joint), states), 10 * 7, 1e-9);
}

}  // namespace
}  // namespace detent_joint_fuzz
