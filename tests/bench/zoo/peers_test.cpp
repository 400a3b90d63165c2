#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "tests/bench/zoo/peers.h"
#include "tests/bench/zoo/script.h"
#include "tests/campaigns/zoo/mechanics.h"

/// That each peer plays what a scene says, and not something else: its shapes, masses, axes, signs and units. Bounds
/// are loose: how well it does so is what ./bench zoo tells.
namespace detent_zoo {
namespace {

using detent_test::Ground;

constexpr double k_gravity = 9.81;  // m/s^2
constexpr uint32_t k_second = 60;   // ticks

/// A scene of these bodies; `rest`: what comes after them, from a comma on.
std::string scene_of(const std::string& bodies, const std::string& rest = "") {
  const std::string path = testing::TempDir() + "peer_scene.json";
  std::ofstream(path) << "{\"format\": 1, \"ticks\": 600, \"bodies\": [" << bodies << "]" << rest << "}";
  return path;
}

const char* const k_ground = R"({"type": "fixed", "shape": {"type": "half_space"}}, )";
/// A body at (0, 3, 0) that touches nothing: fixed, or one that could move, which some engines treat as another case.
std::string pin(const std::string& type = "fixed") {
  return R"({"name": "pin", "type": ")" + type +
         R"(", "position": [0, 3, 0], "shape": {"type": "sphere", "radius": 0.1}, "filter": {"mask": 0}}, )";
}
constexpr const char* k_pin_types[] = {"fixed", "kinematic"};

class PeerTest : public testing::TestWithParam<Engine> {
 protected:
  void open(const std::string& bodies, const std::string& rest = "") {
    std::string problem;
    play_ = GetParam().open(scene_of(bodies, rest), Ground::own, problem);
    ASSERT_NE(play_, nullptr) << problem;
  }
  void run(uint32_t ticks) {
    std::string problem;
    for (uint32_t i = 0; i < ticks; ++i) {
      play_->call(problem);
      ASSERT_EQ(problem, "");
      awake_ = play_->step().awake;
    }
  }
  bool is(const char* name) const { return std::string(GetParam().config) == name; }
  BodyFrame body(size_t index) const { return play_->frame().bodies.at(index); }
  JointState joint() const {
    const Frame frame = play_->frame();
    return state_of(frame.joints.at(0), frame);
  }

  std::unique_ptr<Play> play_;
  uint32_t awake_ = 0;
};

TEST_P(PeerTest, a_box_falls_as_far_as_it_should_and_then_sleeps_on_the_ground) {
  open(std::string(k_ground) +
       R"({"position": [0, 5.5, 0], "shape": {"type": "box", "half_extents": [0.4, 0.5, 0.6]}})");
  EXPECT_NEAR(body(1).mass, 960, 1e-3);
  run(k_second / 2);
  EXPECT_NEAR(5.5 - body(1).position.y, k_gravity / 8, 0.1);
  EXPECT_EQ(awake_, 1u);
  run(5 * k_second);
  EXPECT_NEAR(body(1).position.y, 0.5, 0.01);
  EXPECT_EQ(awake_, 0u);
}

TEST_P(PeerTest, each_shape_lies_at_its_own_height) {
  open(std::string(k_ground) + R"(
    {"position": [0, 0.31, 0], "shape": {"type": "sphere", "radius": 0.3}},
    {"position": [2, 0.31, 0], "rotation": {"axis": [0, 0, 1], "degrees": 90},
     "shape": {"type": "capsule", "radius": 0.3, "half_length": 0.5}},
    {"position": [4, 0.51, 0], "shape": {"type": "cylinder", "radius": 0.3, "half_length": 0.5}})");
  run(k_second);
  EXPECT_NEAR(body(1).position.y, 0.3, 0.01);
  EXPECT_NEAR(body(2).position.y, 0.3, 0.01);
  EXPECT_NEAR(body(3).position.y, 0.5, 0.01);
}

TEST_P(PeerTest, a_pendulum_keeps_its_length_and_its_time) {
  open(pin() + R"({"name": "bob", "position": [0.2, 1, 0], "shape": {"type": "sphere", "radius": 0.1}})",
       R"(, "joints": [{"a": "pin", "b": "bob", "point": [0, 3, 0]}])");
  run(85);  // half of 2 pi sqrt(2 m / g)
  EXPECT_NEAR(body(1).position.x, -0.2, 0.03);
  EXPECT_LT(joint().gap, 0.05);
}

/// A hinge's turn about the world's z: its x lies along that.
const char* const k_arm =
    R"({"name": "arm", "position": [1, 3, 0], "shape": {"type": "box", "half_extents": [1, 0.1, 0.1]}})";
std::string hinge(const std::string& axis) {
  return R"(, "world": {"gravity": [0, 0, 0]}, "joints": [{"type": "hinge", "a": "pin", "b": "arm", "point": [0, 3, 0],
    "frame": {"axis": [0, 1, 0], "degrees": -90}, "axis": )" +
         axis + "}]";
}

TEST_P(PeerTest, a_motor_turns_the_way_that_it_is_told_as_hard_as_it_may) {
  for (const char* type : k_pin_types) {
    open(pin(type) + k_arm, hinge(R"({"speed": 2, "force_max": 100000})"));
    run(k_second / 2);
    EXPECT_NEAR(joint().values[0], 1, 0.05);
    EXPECT_NEAR(body(1).angular_velocity.z, 2, 0.05);
    const double inertia = 80 * (4 + 0.04) / 12 + 80;  // of the arm's 80 kg, about its end
    open(pin(type) + k_arm, hinge(R"({"speed": -50, "force_max": 200})"));
    run(k_second / 2);
    EXPECT_NEAR(body(1).angular_velocity.z, -200 * 0.5 / inertia, 0.05);
  }
}

TEST_P(PeerTest, a_limit_holds_on_its_own_side) {
  for (const char* type : k_pin_types) {
    open(pin(type) + k_arm, hinge(R"({"limited": true, "lower": -0.5, "upper": 1, "speed": 1, "force_max": 50})"));
    run(3 * k_second);
    EXPECT_NEAR(joint().values[0], 1, 0.1);
    open(pin(type) + k_arm, hinge(R"({"limited": true, "lower": -0.5, "upper": 1, "speed": -1, "force_max": 50})"));
    run(3 * k_second);
    EXPECT_NEAR(joint().values[0], -0.5, 0.1);
  }
}

TEST_P(PeerTest, a_spring_comes_to_its_target) {
  for (const char* type : k_pin_types) {
    open(pin(type) + k_arm, hinge(R"({"frequency": 1, "damping_ratio": 1, "target": 0.4})"));
    run(8 * k_second);
    EXPECT_NEAR(joint().values[0], 0.4, 0.02);
  }
}

TEST_P(PeerTest, a_slider_drives_along_its_axis_up_to_its_limit) {
  for (const char* type : k_pin_types) {
    open(pin(type) + R"({"name": "sledge", "position": [0, 3, 0], "shape": {"type": "sphere", "radius": 0.2}})",
         R"(, "joints": [{"type": "slider", "a": "pin", "b": "sledge", "point": [0, 3, 0], "axis":
       {"limited": true, "lower": -1, "upper": 1.5, "speed": 1, "force_max": 10000}}])");
    run(k_second);
    EXPECT_NEAR(joint().values[0], 1, 0.05);
    EXPECT_LT(joint().gap, 0.01);
    run(k_second);
    EXPECT_NEAR(joint().values[0], 1.5, 0.05);
  }
}

TEST_P(PeerTest, friction_stops_a_box_and_a_rebound_keeps_its_share) {
  open(std::string(k_ground) + R"({"position": [0, 0.2, 0], "linear_velocity": [3, 0, 0], "material": {"friction": 0.4},
    "shape": {"type": "box", "half_extents": [0.5, 0.2, 0.5]}},
    {"position": [0, 2.2, 5], "shape": {"type": "sphere", "radius": 0.2}, "material": {"restitution": 0.5}})");
  double top = 0;
  run(45);  // it fell for 38 ticks
  for (int i = 0; i < 40; ++i) {
    run(1);
    top = fmax(top, body(2).position.y - 0.2);
  }
  EXPECT_NEAR(top, 0.5, 0.1);
  run(k_second);
  EXPECT_NEAR(body(1).position.x, 9 / (2 * k_gravity * sqrt(0.4 * 0.6)), 0.1);
}

TEST_P(PeerTest, a_light_ball_is_slowed_by_its_rolling_resistance) {
  // Of few newtons: Bullet's is bounded by more than the force.
  open(std::string(k_ground) +
       R"({"position": [0, 0.1, 0], "linear_velocity": [2, 0, 0], "angular_velocity": [0, 0, -20], "mass": 0.1,
    "shape": {"type": "sphere", "radius": 0.1}, "material": {"rolling_resistance": 0.05}})");
  run(2 * k_second);
  EXPECT_NEAR(body(1).linear_velocity.x, 2 - 2 * 0.05 * k_gravity / 1.4, 0.15);
}

TEST_P(PeerTest, a_platform_carries_a_box_and_a_damped_body_slows) {
  open(R"({"type": "kinematic", "linear_velocity": [1, 0, 0], "shape": {"type": "box", "half_extents": [1, 0.1, 1]}},
    {"position": [0, 0.3, 0], "shape": {"type": "box", "half_extents": [0.2, 0.2, 0.2]}},
    {"position": [0, 5, 5], "linear_velocity": [0, 0, 2], "linear_damping": 1, "gravity_scale": 0,
     "shape": {"type": "sphere", "radius": 0.2}},
    {"position": [0, 5, 9], "gravity_scale": 0.5, "shape": {"type": "sphere", "radius": 0.2}})");
  run(k_second);
  EXPECT_NEAR(body(0).position.x, 1, 1e-6);
  EXPECT_NEAR(body(1).position.x, 1, 0.1);
  EXPECT_NEAR(body(2).linear_velocity.z, 2 * exp(-1), 0.05);
  EXPECT_NEAR(body(3).linear_velocity.y, -k_gravity / 2, 0.05);
}

TEST_P(PeerTest, calls_reach_it) {
  open(R"({"name": "puck", "position": [1, 2, 3], "gravity_scale": 0, "mass": 2,
    "shape": {"type": "box", "half_extents": [0.3, 0.3, 0.3]}})",
       R"(, "actions": [{"tick": 3, "call": "apply_impulse", "body": "puck", "impulse": [4, 0, 0], "arm": [0, 0.3, 0]},
    {"tick": 30, "call": "set_velocity", "body": "puck", "linear_velocity": [0, 1, 0], "angular_velocity": [0, 0, 0]}])");
  run(20);
  EXPECT_NEAR(body(0).linear_velocity.x, 2, 1e-3);
  EXPECT_NEAR(body(0).angular_velocity.z, -4 * 0.3 / (2 * 0.36 / 6), 0.1);
  run(20);
  EXPECT_NEAR(body(0).linear_velocity.y, 1, 1e-3);
}

TEST_P(PeerTest, says_what_it_cannot_express) {
  std::string problem;
  EXPECT_EQ(GetParam().open(scene_of(pin() + k_arm, R"(, "joints": [{"type": "distance", "a": "pin",
    "b": "arm", "axis": {"limited": true, "upper": 1}}])"),
                            Ground::own, problem),
            nullptr);
  EXPECT_EQ(problem, is("ode") ? "rope" : "distance joint");
}

/// How far a second later the balls are from lying on a ground that is 8 m wide in the scene: 90 and 110 m out.
std::array<double, 2> heights_above(const Engine& engine, Ground ground) {
  std::string problem;
  const std::unique_ptr<Play> play = engine.open(
      scene_of(R"({"type": "fixed", "position": [0, 3, 0], "shape": {"type": "box", "half_extents": [4, 1, 4]}},
               {"position": [90, 4.3, 0], "shape": {"type": "sphere", "radius": 0.2}},
               {"position": [110, 4.3, 0], "shape": {"type": "sphere", "radius": 0.2}})"),
      ground, problem);
  EXPECT_EQ(problem, "");
  for (uint32_t i = 0; i < k_second && play != nullptr; ++i) play->step();
  const Frame frame = play->frame();
  return {fabs(frame.bodies.at(1).position.y - 4.2), fabs(frame.bodies.at(2).position.y - 4.2)};
}

TEST(ground, is_a_half_space_or_a_box_of_200_m_of_the_same_height_in_every_engine) {
  std::vector<Engine> engines = all_engines();
  for (const Engine& peer : all_peers()) engines.push_back(peer);
  for (const Engine& engine : engines) {
    const auto own = heights_above(engine, Ground::own), infinite = heights_above(engine, Ground::half_space),
               box = heights_above(engine, Ground::box);
    EXPECT_GT(own[0], 1) << engine.config;
    EXPECT_GT(own[1], 1) << engine.config;
    EXPECT_LT(infinite[0], 0.02) << engine.config;
    EXPECT_LT(infinite[1], 0.02) << engine.config;
    EXPECT_LT(box[0], 0.02) << engine.config;
    EXPECT_GT(box[1], 1) << engine.config;
  }
}

TEST(ground, is_level_wide_thick_and_alone) {
  const auto has = [](const std::string& bodies) { return has_ground(scene_of(bodies)); };
  const std::string wide = R"({"type": "fixed", "shape": {"type": "box", "half_extents": [4, 1, 4]})";
  EXPECT_TRUE(has(wide + "}"));
  EXPECT_TRUE(has(R"({"type": "fixed", "shape": {"type": "half_space"}})"));
  EXPECT_FALSE(has(wide + "}, " + wide + "}"));
  EXPECT_FALSE(has(wide + R"(, "rotation": {"axis": [0, 0, 1], "degrees": 5}})"));
  EXPECT_FALSE(has(R"({"type": "fixed", "shape": {"type": "box", "half_extents": [4, 0.1, 4]}})"));
  EXPECT_FALSE(has(R"({"type": "fixed", "shape": {"type": "box", "half_extents": [4, 1, 0.5]}})"));
  EXPECT_FALSE(has(R"({"type": "kinematic", "shape": {"type": "box", "half_extents": [4, 1, 4]}})"));
}

TEST(peers, are_both_there) {
  if (all_peers().size() < 2) GTEST_SKIP() << "this build goes without a peer (Debian: libbullet-dev libode-dev)";
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(PeerTest);

INSTANTIATE_TEST_SUITE_P(, PeerTest, testing::ValuesIn(all_peers()),
                         [](const testing::TestParamInfo<Engine>& peer) { return std::string(peer.param.config); });

}  // namespace
}  // namespace detent_zoo
