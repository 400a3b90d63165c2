#include <detent/recording.h>
#include <detent/world.h>

#include <algorithm>

#include "tests/bench/scaling/impacts.h"
#include "tests/bench/scaling/rays.h"
#include "tests/bench/scaling/recorded.h"
#include "tests/bench/scaling/settled.h"
#include "tests/bench/timer.h"
#include "threads/thread_pool.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_bench;

ScalingRow measure(const ScalingScene& scene, const std::vector<uint32_t>& threads) {
  ScalingRow row;
  row.config = stress_engine().config;
  row.scene = scene.name;
  Settled alone(scene);
  Recorded recorded;
  alone.world().hooks.tasks = recorded.tasks();
  for (uint32_t i = 0; i < scene.ticks; ++i) {
    recorded.tick = {};
    const uint64_t start = monotonic_ns();
    row.contacts = step(alone.world()).contacts.count;
    recorded.tick.ns = static_cast<double>(monotonic_ns() - start);
    row.ticks.push_back(recorded.tick);
  }
  for (const uint32_t count : threads) {
    detent_host::ThreadPool pool(count);
    Settled shared(scene);
    if (count > 1) shared.world().hooks.tasks = pool.tasks<Tasks>();
    std::vector<double> ns;
    for (uint32_t i = 0; i < scene.ticks; ++i) {
      const uint64_t start = monotonic_ns();
      step(shared.world());
      ns.push_back(static_cast<double>(monotonic_ns() - start));
    }
    std::sort(ns.begin(), ns.end());
    row.measured.push_back(ns[ns.size() / 2]);
    row.same = row.same && digest(shared.world()) == digest(alone.world());
  }
  return row;
}

}  // namespace

void add_scaling_engine(ScalingEngineList& engines) {
  engines.push_back({stress_engine().config, measure, measure_rays, measure_impacts});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
