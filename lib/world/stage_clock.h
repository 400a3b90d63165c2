#pragma once
#include <detent/profile.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Gives the time since it was last asked to a stage, if anybody wants to know.
class StageClock {
 public:
  explicit StageClock(Profile* profile) : profile_(profile != nullptr && profile->now != nullptr ? profile : nullptr) {
    if (profile_ == nullptr) return;
    ++profile_->steps;
    last_ = profile_->now(profile_->user);
  }
  void end(StepStage stage) {
    if (profile_ == nullptr) return;
    const uint64_t now = profile_->now(profile_->user);
    profile_->ticks[static_cast<uint32_t>(stage)] += now - last_;
    last_ = now;
  }

 private:
  Profile* profile_;
  uint64_t last_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
