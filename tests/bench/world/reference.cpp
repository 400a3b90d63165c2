#include "tests/bench/world/reference.h"

#include <math.h>

namespace detent_bench {

namespace {

constexpr uint32_t k_parts = 64;  // of a tick

/// Of that engine with steps of a part of the tick; empty on failure.
std::vector<States> computed(Stage stage, uint32_t ticks, uint32_t parts, const WorldEngine& engine,
                             const char*& problem) {
  stage.tick /= parts;
  const std::unique_ptr<WorldRun> run(engine.make(stage, {}, problem));
  std::vector<States> all;
  for (uint32_t tick = 0; tick < ticks && run != nullptr; ++tick) {
    for (uint32_t part = 0; part < parts; ++part) run->step();
    all.emplace_back(stage.bodies.size());
    run->read(all.back().data());
  }
  return all;
}

}  // namespace

std::unique_ptr<Reference> make_reference(const WorldStudy& study, const Stage& stage, const WorldEngineList& engines,
                                          std::string& problem) {
  auto reference = std::make_unique<Reference>();
  if (study.exact != nullptr) {
    for (uint32_t tick = 1; tick <= study.compared_until; ++tick)
      reference->states.push_back(study.exact(stage, tick * stage.tick));
    return reference;
  }
  for (const WorldEngine& engine : engines) {
    if (std::string(engine.engine) != "detent" || std::string(engine.config) != "f64") continue;
    const char* why = nullptr;
    reference->states = computed(stage, study.compared_until, k_parts, engine, why);
    const std::vector<States> coarse = computed(stage, study.compared_until, k_parts / 2, engine, why);
    if (why != nullptr) {
      problem = why;
      return nullptr;
    }
    double squares = 0;
    for (size_t i = 0; i < coarse.size(); ++i) squares += pow(state_error(stage, coarse[i], reference->states[i]), 2);
    reference->uncertainty = sqrt(squares / static_cast<double>(coarse.size()));
    return reference;
  }
  problem = "the reference needs f64 (DETENT_CONFIGS)";
  return nullptr;
}

}  // namespace detent_bench
