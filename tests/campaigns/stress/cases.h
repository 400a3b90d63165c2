#pragma once
#include <functional>
#include <string>
#include <vector>

#include "tests/campaigns/stress/run.h"

/// Runs and measures the scenes.
namespace detent_stress {

/// The part of a scene that is run.
enum class Effort : uint32_t {
  tiny,   ///< for emulators
  brief,  ///< for daily runs
  full,   ///< with the scene's full length and size
};

struct Trial {
  Engine engine;
  Settings settings;
  double scale = 1;
  uint64_t seed = 0;
  Effort effort = Effort::full;

  uint32_t pick(uint32_t full, uint32_t brief, uint32_t tiny) const {
    return effort == Effort::full ? full : effort == Effort::brief ? brief : tiny;
  }
};

struct Measured {
  std::string name;
  double value = 0;  ///< lengths in the scene's unit, speeds in its square root
};

struct Outcome {
  std::string problem;  ///< why nothing was measured
  std::vector<Measured> measured;
  uint64_t digest = 0;  ///< of the last state
  uint64_t ticks = 0;
  double step_seconds = 0;  ///< total time in steps

  void add(const std::string& name, double value) { measured.push_back({name, value}); }
};

struct Case {
  std::string group;  ///< S1 to S12
  std::string name;
  bool extra = false;  ///< has no target: measured only on demand
  std::function<void(const Trial& trial, Outcome& outcome)> run;
};

const std::vector<Case>& all_cases();
Outcome run_case(const Case& which, const Trial& trial);

}  // namespace detent_stress
