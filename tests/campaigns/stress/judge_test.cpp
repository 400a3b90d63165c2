#include <math.h>
#include <string.h>

#include "tests/campaigns/stress/bounds.h"
#include "tests/campaigns/stress/cases.h"
#include "tests/campaigns/stress/measures.h"
#include "tests/common/support/test.h"

/// The results of the cases for engines with known faults.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_stress::BodyState;
using detent_stress::Case;
using detent_stress::Counts;
using detent_stress::Effort;
using detent_stress::Measured;
using detent_stress::Outcome;
using detent_stress::Settings;
using detent_stress::Stage;
using detent_stress::States;
using detent_stress::Trial;

enum class Fault {
  still,     ///< nothing moves
  ghostly,   ///< bodies move as they were shot, through everything
  sticking,  ///< a body that touches body 0 sticks to it with half of it on the other side
  turning,   ///< a body that touches body 0 moves back as it came
  losing,    ///< nothing moves, and each step drops a contact
};

class FaultyRun : public detent_stress::Run {
 public:
  FaultyRun(const Stage& stage, Fault fault) : stage_(stage), states_(states_at_start(stage)), fault_(fault) {}
  Counts step() override {
    Counts counts;
    counts.lost = fault_ == Fault::losing ? 1 : 0;
    if (fault_ == Fault::still || fault_ == Fault::losing) return counts;
    for (size_t i = 0; i < states_.size(); ++i) {
      BodyState& state = states_[i];
      for (int k = 0; k < 3; ++k) state.position[k] += state.linear_velocity[k] * stage_.tick;
      if (i == 0 || fault_ == Fault::ghostly) continue;
      const BodyState& target = states_[0];
      std::array<double, 3> from;
      for (size_t k = 0; k < 3; ++k) from[k] = state.position[k] - target.position[k];
      from = detent_stress::to_local(target.rotation, from);
      if (from[2] > 0) continue;
      // The body moves to the target's plane, or back to its start.
      const bool turns = fault_ == Fault::turning;
      for (size_t k = 0; k < 3; ++k) {
        state.position[k] = turns ? state.position[k] - state.linear_velocity[k] * stage_.tick : target.position[k];
        state.linear_velocity[k] = turns ? -state.linear_velocity[k] : 0;
      }
      if (turns) continue;
      // Upright on the plane: a rotation by a right angle maps y to z.
      const double half = sqrt(0.5), rotation_vector[4] = {half, 0, 0, half}, *q = target.rotation;
      const double upright[4] = {
          q[3] * rotation_vector[0] + q[0] * rotation_vector[3], q[1] * rotation_vector[3] + q[2] * rotation_vector[0],
          q[2] * rotation_vector[3] - q[1] * rotation_vector[0], q[3] * rotation_vector[3] - q[0] * rotation_vector[0]};
      for (int k = 0; k < 4; ++k) state.rotation[k] = upright[k];
      for (size_t k = 0; k < 3; ++k) state.position[k] += 1e-6 * detent_stress::to_world(target.rotation, {0, 0, 1})[k];
    }
    return counts;
  }
  States states() const override { return states_; }
  uint64_t digest() const override { return 0; }
  uint64_t relative_digest() const override { return static_cast<uint64_t>(states_[0].position[0]); }
  uint32_t bytes() const override { return 0; }

 private:
  Stage stage_;
  States states_;
  Fault fault_;
};

/// The measured value; -1 if it is not measured.
double measured(const std::string& scene, Fault fault, const std::string& measure) {
  Trial trial;
  trial.effort = Effort::tiny;
  trial.engine.make = [fault](const Stage& stage, const Settings&, std::string&) {
    return std::unique_ptr<detent_stress::Run>(new FaultyRun(stage, fault));
  };
  for (const Case& which : detent_stress::all_cases()) {
    if (which.name != scene) continue;
    for (const Measured& each : run_case(which, trial).measured) {
      if (each.name == measure) return each.value;
    }
  }
  return -1;
}

constexpr double k_shots = 5;

DETENT_TEST(judge, sees_what_flies_through_a_target) {
  for (const char* scene : {"wall_ball_100", "wall_rod_2000", "plate_ball_500", "plate_rod_100"}) {
    EXPECT_EQ(measured(scene, Fault::ghostly, "through"), k_shots) << scene;
    EXPECT_EQ(measured(scene, Fault::ghostly, "wrong_side"), k_shots) << scene;
    EXPECT_EQ(measured(scene, Fault::ghostly, "skewered"), 0) << scene;
  }
}

DETENT_TEST(judge, sees_what_sticks_in_a_target) {
  EXPECT_EQ(measured("wall_rod_500", Fault::sticking, "skewered"), k_shots);
  EXPECT_EQ(measured("wall_rod_500", Fault::sticking, "through"), 0);
}

DETENT_TEST(judge, has_nothing_against_what_goes_back_but_that_it_rebounds) {
  for (const char* scene : {"wall_ball_100", "wall_rod_2000"}) {
    for (const char* measure : {"through", "wrong_side", "skewered"})
      EXPECT_EQ(measured(scene, Fault::turning, measure), 0) << scene << " " << measure;
  }
  EXPECT_GT(measured("wall_ball_100", Fault::turning, "rebound"), 0.5);
}

DETENT_TEST(judge, sees_what_does_not_move_at_all) {
  EXPECT_EQ(measured("pyramid", Fault::still, "drift"), 0);
  EXPECT_EQ(measured("pyramid", Fault::still, "fallen"), 0);
  EXPECT_EQ(measured("dominoes", Fault::still, "standing"), 10);
  EXPECT_EQ(measured("free_rotation", Fault::still, "flips"), 74);
  EXPECT_EQ(measured("incline_slides", Fault::still, "distance"), 1);
  EXPECT_EQ(measured("bounce", Fault::still, "bounces"), 0);
  EXPECT_EQ(measured("bounce", Fault::still, "apex"), 5) << "of no bounce at all";
}

DETENT_TEST(judge, counts_what_is_lost_and_what_is_another_far_away) {
  EXPECT_EQ(measured("free_rotation", Fault::losing, "lost"), 10000);
  EXPECT_EQ(measured("free_rotation", Fault::still, "lost"), 0);
  EXPECT_EQ(measured("far_1km", Fault::still, "ticks_differ"), 30) << "its digest is not relative";
}

DETENT_TEST(judge, finds_bounds_by_scene_configuration_and_scale) {
  const auto* tower = detent_stress::find_wanted("tower_40", "drift");
  ASSERT_NE(tower, nullptr);
  EXPECT_EQ(tower->bound, 0.05);
  EXPECT_NE(detent_stress::find_wanted("free_rotation", "lost"), nullptr) << "of every scene";
  EXPECT_EQ(detent_stress::find_wanted("tower_40", "escaped"), nullptr);
  EXPECT_TRUE(detent_stress::is_refused("far_100km", "fx32", 1));
  EXPECT_FALSE(detent_stress::is_refused("far_100km", "fx64", 1));
  EXPECT_FALSE(detent_stress::is_refused("wall_ball_2000", "fx64", 1));
  EXPECT_EQ(detent_stress::find_gap("pyramid", "fx64", 1, "fallen"), nullptr);
  const auto* far = detent_stress::find_gap("far_10km", "f64", 1, "ticks_differ");
  ASSERT_NE(far, nullptr);
  EXPECT_EQ(detent_stress::find_gap("far_10km", "fx64", 1, "ticks_differ"), nullptr);
}

DETENT_TEST(judge, holds_what_misses_its_bound_to_no_less_than_that) {
  for (const detent_stress::Gap& gap : detent_stress::k_gaps) {
    const auto* wanted = detent_stress::find_wanted(gap.scene, gap.measure);
    if (wanted == nullptr) {
      for (const Case& which : detent_stress::all_cases()) {
        if (wanted == nullptr && which.name.compare(0, strlen(gap.scene), gap.scene) == 0)
          wanted = detent_stress::find_wanted(which.name, gap.measure);
      }
    }
    ASSERT_NE(wanted, nullptr) << gap.scene << " " << gap.measure << " is held, but nothing is wanted of it";
    EXPECT_GT(gap.held, wanted->bound) << gap.scene << " " << gap.measure;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
