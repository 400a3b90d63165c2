#pragma once
#include <detent/world.h>

#include "tests/common/support/stage_time.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The profile of a world by a clock of the caller's. It must outlive the world's steps.
class StageProfile {
 public:
  explicit StageProfile(uint64_t (*now)(void* user)) { profile_.now = now; }
  StageProfile(const StageProfile&) = delete;
  StageProfile& operator=(const StageProfile&) = delete;

  void attach(World& world) { world.hooks.profile = &profile_; }
  detent_test::StageTimes times() const {
    detent_test::StageTimes times;
    for (uint32_t i = 0; i < k_step_stage_count; ++i)
      times.push_back({stage_name(static_cast<StepStage>(i)), profile_.ticks[i]});
    return times;
  }

 private:
  Profile profile_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
