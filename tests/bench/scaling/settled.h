#pragma once
#include "tests/bench/scaling/engine.h"
#include "tests/campaigns/stress/run_detent.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A run of a scene up to its measured ticks.
struct Settled {
  std::unique_ptr<detent_stress::Run> run;

  explicit Settled(const detent_bench::ScalingScene& scene) {
    std::string problem;
    run = stress_engine().make(scene.stage(), {}, problem);
    for (uint32_t i = 0; i < scene.settling; ++i) step(world());
  }
  World& world() { return world_of(*run); }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
