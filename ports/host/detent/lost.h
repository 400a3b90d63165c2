#pragma once
#include <detent/world.h>

/// What a step drops for lack of room or leaves undecided. `detent shrink` and the zoo both use this definition.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct LostCounter {
  const char* name;  ///< the field of StepReport
  uint32_t (*count)(const StepReport& report);
};
inline constexpr LostCounter k_lost_counters[] = {
    {"lost.pairs", [](const StepReport& report) { return report.lost.pairs; }},
    {"lost.contacts", [](const StepReport& report) { return report.lost.contacts; }},
    {"contacts.capped", [](const StepReport& report) { return report.contacts.capped; }},
    {"saturations", [](const StepReport& report) { return report.saturations; }},
    {"ccd.bodies_stopped", [](const StepReport& report) { return report.ccd.bodies_stopped; }},
    {"lost.sensed", [](const StepReport& report) { return report.lost.sensed; }},
    {"joints.undecided", [](const StepReport& report) { return report.joints.undecided; }},
    {"ccd.undecided", [](const StepReport& report) { return report.ccd.undecided; }},
    {"lost.impacts", [](const StepReport& report) { return report.lost.impacts; }},
};

/// The sum of all counters.
inline uint64_t count_lost(const StepReport& report) {
  uint64_t sum = 0;
  for (const LostCounter& counter : k_lost_counters) sum += counter.count(report);
  return sum;
}

/// The name of the greatest counter.
inline const char* greatest_loss(const StepReport& report) {
  const LostCounter* greatest = k_lost_counters;
  for (const LostCounter& counter : k_lost_counters) {
    if (counter.count(report) > greatest->count(report)) greatest = &counter;
  }
  return greatest->name;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
