#pragma once
#include <functional>
#include <string>

#include "tests/bench/world/engine.h"

namespace detent_bench {

using detent_stress::States;

/// Ticks of a scene that make a row: from `first` on, before `end`.
struct Window {
  std::string row;
  uint32_t first, end;
};

/// A scene of tests/campaigns/stress as it is timed. The ticks outside of its windows are made and not timed.
struct WorldScene {
  std::string name;  ///< by which --scenes asks for it
  std::string text;
  std::function<Stage()> stage;
  std::vector<Window> windows;  ///< in the order of time; of a study one
};

const std::vector<WorldScene>& world_scenes();

/// The pit of S4 with so many bodies: as wide as they need to lie as deep as 1,000 in S4.
WorldScene growth_scene(uint32_t bodies);

}  // namespace detent_bench
