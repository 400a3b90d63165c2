#include "tests/bench/world/scenes.h"

#include <math.h>

#include "tests/campaigns/stress/scenes.h"

namespace detent_bench {

namespace {

constexpr uint64_t k_pit_seed = 1;

Stage stage_1() { return detent_stress::pyramid(20); }
Stage stage_4() { return detent_stress::pit(1000, k_pit_seed); }
Stage stage_6() { return detent_stress::chain(30, 100); }
Stage stage_8() { return detent_stress::dominoes(200); }
Stage stage_10() { return detent_stress::sleep_stacks(1000, 5, false); }
Stage stage_10_asleep() { return detent_stress::sleep_stacks(1000, 5, true); }
/// And a ball that rolls along the middle aisle and never stops.
Stage stage_10_one_awake() {
  Stage stage = stage_10_asleep();
  detent_stress::StageBody ball;
  ball.solid = detent_stress::Solid::sphere;
  ball.size[0] = ball.position[1] = 0.25;
  ball.position[0] = -46;
  ball.linear_velocity[0] = 2;
  ball.angular_velocity[2] = -8;
  stage.bodies.push_back(ball);
  return stage;
}

}  // namespace

const std::vector<WorldScene>& world_scenes() {
  static const std::vector<WorldScene> scenes = {
      {"S1", "pyramid of 210 boxes", stage_1, {{"S1", 60, 600}}},
      {"S4", "pit of 1,000 mixed shapes", stage_4, {{"S4-falling", 0, 300}, {"S4", 450, 600}}},
      {"S6", "chain of 30 links, a weight of 100 at its end", stage_6, {{"S6", 0, 1800}}},
      {"S8", "200 dominoes", stage_8, {{"S8", 0, 1800}}},
      {"S10", "5,000 boxes in stacks, awake", stage_10, {{"S10", 150, 180}}},
      {"S10-asleep", "the same, with sleeping on", stage_10_asleep, {{"S10-asleep", 150, 180}}},
      {"S10-one-awake",
       "the same, and a ball that rolls between the stacks",
       stage_10_one_awake,
       {{"S10-one-awake", 150, 180}}},
  };
  return scenes;
}

WorldScene growth_scene(uint32_t bodies) {
  constexpr double k_layers = 1000.0 / (8 * 8);
  const auto side = static_cast<uint32_t>(lround(sqrt(bodies / k_layers)));
  const std::string name = "S4-" + std::to_string(bodies);
  return {name,
          "pit of " + std::to_string(bodies) + " mixed shapes, " + std::to_string(side) + " a row",
          [bodies, side] { return detent_stress::pit(bodies, k_pit_seed, side); },
          {{name + "-falling", 0, 120}, {name, 240, 270}}};
}

}  // namespace detent_bench
