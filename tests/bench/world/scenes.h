#pragma once
#include "tests/bench/world/engine.h"

namespace detent_bench {

/// Ticks of a scene that make a row: from `first` on, before `end`.
struct Window {
  const char* row;
  uint32_t first, end;
};

/// A scene of tests/campaigns/stress as it is timed. The ticks outside of its windows are made and not timed.
struct WorldScene {
  const char* name;  ///< by which --scenes asks for it
  const char* text;
  Stage (*stage)();
  std::vector<Window> windows;
};

const std::vector<WorldScene>& world_scenes();

}  // namespace detent_bench
