#pragma once
#include "tests/bench/world/scenes.h"

namespace detent_bench {

/// A scene whose exact motion is known, or can be computed by much shorter steps: for time against error.
struct WorldStudy {
  WorldScene scene;
  /// The states at that time, s; null: those of the library in f64 with a 64th of the tick.
  States (*exact)(const Stage& stage, double seconds);
  uint32_t compared_until;  ///< the tick from which on the motion is compared no more, because small errors grow in it
  /// Measures that are 0 in the exact motion, beside `error`.
  std::vector<const char*> errors;
};

const std::vector<WorldStudy>& world_studies();

/// The root mean square, over the bodies that move, of the distance between the points of a body in both states: six
/// points on its axes, which stand for its rotation.
double state_error(const Stage& stage, const States& states, const States& exact);

}  // namespace detent_bench
