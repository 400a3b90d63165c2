#pragma once
#include <detent/world.h>

#include "tests/common/support/stage_time.h"
#include "tests/common/support/thread_clock.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The profile of a world by the thread's clock, less the time of reading it. It must outlive the world's steps.
class StageProfile {
 public:
  StageProfile() {
    profile_.now = [](void*) { return detent_test::thread_ns(); };
  }
  StageProfile(const StageProfile&) = delete;
  StageProfile& operator=(const StageProfile&) = delete;

  void attach(World& world) {
    overhead_ = detent_test::thread_clock_overhead();
    world.hooks.profile = &profile_;
  }
  detent_test::StageTimes times() const {
    detent_test::StageTimes times;
    for (uint32_t i = 0; i < k_step_stage_count; ++i) {
      const uint64_t all = profile_.ticks[i], read = profile_.steps * overhead_;
      times.push_back({stage_name(static_cast<StepStage>(i)), all > read ? all - read : 0});
    }
    return times;
  }

 private:
  Profile profile_;
  uint64_t overhead_ = 0;  ///< ns
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
