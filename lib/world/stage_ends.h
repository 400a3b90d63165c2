#pragma once
#include <detent/world.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Reports the end of each stage of a step: adds the duration of the stage to the profile, and calls the observer.
class StageEnds {
 public:
  explicit StageEnds(const World& world)
      : world_(world),
        profile_(world.hooks.profile != nullptr && world.hooks.profile->now != nullptr ? world.hooks.profile : nullptr),
        observer_(world.hooks.observer != nullptr && world.hooks.observer->stage_ended != nullptr ? world.hooks.observer
                                                                                                  : nullptr) {
    if (profile_ == nullptr) return;
    ++profile_->steps;
    last_ = profile_->now(profile_->user);
  }
  /// `contacts`: number of contacts found so far in this step.
  void end(StepStage stage, uint32_t contacts) {
    if (profile_ != nullptr) {
      const uint64_t now = profile_->now(profile_->user);
      profile_->ticks[static_cast<uint32_t>(stage)] += now - last_;
      last_ = now;
    }
    if (observer_ != nullptr) observer_->stage_ended(observer_->context, world_, stage, contacts);
  }

 private:
  const World& world_;
  Profile* profile_;
  const StepObserver* observer_;
  uint64_t last_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
