#pragma once
#include <stdint.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "tests/campaigns/stress/stage.h"

namespace detent_stress {

/// Settings that differ from the library's defaults.
struct Settings {
  std::optional<uint32_t> substeps, iterations;
  std::optional<double> contact_recycle_distance, resting_penetration;
  std::optional<uint32_t> reduction;  ///< a ManifoldReduction
  bool continuous = true;
};

/// Counts of a step, from its report.
struct Counts {
  uint32_t contacts = 0;
  uint32_t contact_points = 0;
  uint32_t substeps_max = 0;  ///< greatest of any island; 0 if the report has no count
  uint32_t awake = 0;         ///< awake bodies; all movable bodies if the report has no count
  uint32_t lost = 0;          ///< pairs and contacts beyond their pools
  uint32_t saturations = 0;
  double lost_time = 0;  ///< of continuous collision, ticks
};

/// A stage in an engine's world.
class Run {
 public:
  virtual ~Run() = default;
  virtual Counts step() = 0;
  /// The states of all bodies, in the stage's order.
  virtual States states() const = 0;
  virtual uint64_t digest() const = 0;
  /// The digest of the poses and velocities only, with positions as exact differences to the first body's.
  virtual uint64_t relative_digest() const = 0;
  virtual uint32_t bytes() const = 0;  ///< of the world's block
};

/// Makes the stage's world. Returns null, with a line in `problem`, if the engine refuses a part of it.
using Maker = std::function<std::unique_ptr<Run>(const Stage& stage, const Settings& settings, std::string& problem)>;

struct Engine {
  std::string config;
  Maker make;
};

}  // namespace detent_stress
