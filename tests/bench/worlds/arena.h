#pragma once
#include <detent/recording.h>

#include <memory>

#include "tests/bench/worlds/engine.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_bench::WorldsScene;

/// A world of the benchmark, in memory of its own. Empty at first.
class Arena {
 public:
  explicit Arena(const WorldsScene& scene);
  Arena(Arena&&) = default;

  static Capacity capacity(const WorldsScene& scene);
  /// The walls, boxes and players.
  static void build(Recorder& recorder, const WorldsScene& scene);
  /// The calls of one tick, without the step. What the players do depends on the seed and the world's tick alone; they
  /// do nothing in the first k_worlds_settling ticks.
  static void act(Recorder& recorder, const WorldsScene& scene, uint64_t seed);

  void build();
  /// Returns the number of bodies that took part in a step, summed over the steps.
  uint64_t play(uint64_t seed, uint32_t ticks);

  World world;

 private:
  const WorldsScene* scene_;
  std::unique_ptr<uint64_t[]> block_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
