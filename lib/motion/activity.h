#pragma once
#include <detent/detail/scratch.h>
#include <detent/event.h>
#include <detent/features.h>

#include "base/bit_set.h"
#include "motion/spin.h"
#include "motion/step_settings.h"

/// Which bodies take part in a step, and when an island rests.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint16_t k_still_ticks = 30;  ///< at rest before an island falls asleep

inline bool is_awake(const BodyTraits& traits, const BodyActivity& activity) {
  return is_dynamic(traits) && activity.asleep == 0;
}

/// A body that moves, or may be moved, in this step: an awake dynamic one, or a kinematic one that has a velocity.
bool is_moving(const BodyTraits& traits, const BodyMotion& motion, const BodyActivity& activity);

/// Wakes all bodies that fell asleep with the one in `slot`, sets their bits in `visits`, and leaves word of
/// it. Returns how many.
uint32_t wake_all_with(uint32_t slot, Span<BodyActivity> activities, BitSet visits);

/// Counts the ticks that each body has been at rest, and puts islands of which all bodies have been for k_still_ticks
/// to sleep: they stop. Returns how many bodies fell asleep.
/// At rest is a point of the body's rim slower than a 64th of the speed of a fall by its smallest diameter, by its
/// velocity and by its way in this tick: what is pushed out of another body, or towards its joint, moves without one.
uint32_t fall_asleep(const StepSettings& settings, Span<const BodyTraits> traits, Span<const BodyPose> poses,
                     Span<const BodySweep> sweeps, Span<const Island> islands, Span<const uint32_t> bodies,
                     Span<BodyMotion> motions, Span<BodyActivity> activities);

/// For a feature table.
struct SleepingOps {
  decltype(&fall_asleep) end_step;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
