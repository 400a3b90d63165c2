#pragma once
#include <stdint.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/campaigns/stress/stage.h"

/// What the benchmark of threads asks of a configuration.
namespace detent_bench {

/// A loop that threads share: the time of each of its parts, ns.
struct SharedLoop {
  std::vector<double> parts;
};

/// One tick on one thread.
struct TickRecord {
  double ns = 0;        ///< the whole tick
  uint32_t groups = 0;  ///< calls of Tasks::run
  std::vector<SharedLoop> loops;
};

struct ScalingScene {
  std::string name;
  std::function<detent_stress::Stage()> stage;
  uint32_t settling, ticks;  ///< ticks before the measurement, and measured
};

struct ScalingRow {
  std::string config, scene;
  uint32_t contacts = 0;          ///< in the last tick
  std::vector<TickRecord> ticks;  ///< recorded on one thread
  std::vector<double> measured;   ///< median ns of a tick, for each of the numbers of threads that were asked for
  bool same = true;               ///< whether all digests were equal
};

/// Rays through the world of a scene.
struct RayRow {
  std::string config, scene;
  bool asleep = false;           ///< whether the bodies sleep
  uint32_t rays = 0;             ///< number of rays
  double single_ns = 0;          ///< least ns of all rays, one call for each
  std::vector<double> batch_ns;  ///< least ns of one batch, for each of the numbers of threads that were asked for
  bool same = true;              ///< whether all answers were equal
};

/// The stage `advance` of a scene with impacts, in one order of the impacts.
struct ImpactRow {
  std::string config, scene, order;
  uint32_t impacts = 0;           ///< in all ticks
  std::vector<TickRecord> ticks;  ///< the stage alone, in the ticks with an impact, recorded on one thread
  std::vector<double> measured;   ///< mean ns of the stage in these ticks, for each of the numbers of threads
  uint32_t warp_ticks = 0, speculations = 0, rollbacks = 0, rounds = 0, returns = 0;  ///< WarpCount
  uint64_t last = 0;                                                                  ///< last digest
  bool same = true;  ///< whether all digests were equal
};

/// What sharing costs on this machine, ns.
struct SharingCost {
  double loop = 0;   ///< a loop of two parts on two threads takes so much longer than one part
  double group = 0;  ///< from a call of Tasks::run until the second thread works
};

struct ScalingEngine {
  std::string config;
  std::function<ScalingRow(const ScalingScene& scene, const std::vector<uint32_t>& threads)> measure;
  /// With the scene's bodies awake, and put to sleep; with few rays and with many.
  std::function<std::vector<RayRow>(const ScalingScene& scene, const std::vector<uint32_t>& threads)> measure_rays;
  /// A scene of k_impact_scenes in each order.
  std::function<std::vector<ImpactRow>(const std::string& scene, const std::vector<uint32_t>& threads)> measure_impacts;
};
inline constexpr const char* k_impact_scenes[] = {"break-1000", "impacts-S8", "fast-5000", "fast-5000-sparse",
                                                  "rocks-300"};
using ScalingEngineList = std::vector<ScalingEngine>;

/// Every configuration of this build.
ScalingEngineList all_scaling_engines();
SharingCost measure_sharing_cost();

}  // namespace detent_bench
