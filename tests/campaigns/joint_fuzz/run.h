#pragma once
#include <functional>
#include <memory>

#include "tests/campaigns/joint_fuzz/account.h"

namespace detent_joint_fuzz {

/// Counts of a step, from its report.
struct Counts {
  uint32_t substeps_max = 0, saturations = 0, joint_decisions_left = 0, contacts = 0, islands = 0;
};

/// A scene in a configuration's world.
class Run {
 public:
  virtual ~Run() = default;
  virtual Counts step() = 0;
  /// The states of all bodies, in the scene's order.
  virtual void states(States& states) const = 0;
  virtual std::vector<Inertia> inertia() const = 0;
};

/// Settings that differ from the library's defaults.
struct Settings {
  uint32_t substeps = 0;  ///< 0: the world's own choice
};

/// Makes the scene's world. Returns null, with a line in `problem`, if the library refuses a part of it.
using Maker = std::function<std::unique_ptr<Run>(const Scene& scene, const Settings& settings, std::string& problem)>;

struct Engine {
  std::string config;
  Maker make;
};

}  // namespace detent_joint_fuzz
