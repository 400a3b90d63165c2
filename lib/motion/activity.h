#pragma once
#include <detent/detail/scratch.h>
#include <detent/event.h>
#include <detent/features.h>

#include "base/bit_set.h"
#include "motion/angular_velocity.h"
#include "motion/step_settings.h"

/// Selects the bodies that take part in a step, and puts islands at rest to sleep.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint16_t k_still_ticks = 30;  ///< number of ticks at rest in a row after which an island falls asleep

inline bool is_awake(const BodyProperties& properties, const BodyActivity& activity) {
  return is_dynamic(properties) && activity.asleep == 0;
}

/// Whether the body can move in this step: it is an awake dynamic body, or a kinematic body with a velocity.
bool is_moving(const BodyProperties& properties, const BodyMotion& motion, const BodyActivity& activity);

/// Wakes all bodies that fell asleep together with the body in `slot`, sets their bits in `active`, and records a
/// `woke` event for each. Returns the number of bodies that it wakes; 0 if the body in `slot` is awake.
uint32_t wake_all_with(uint32_t slot, Span<BodyActivity> activities, BitSet active);

/// Counts for each body the ticks in a row in which it was at rest. Puts an island to sleep, and sets its velocities to
/// zero, if all its bodies have been at rest for k_still_ticks. Returns the number of bodies that fell asleep.
///
/// A body is at rest if no point of its surface is faster than 1/32 of fall_speed() of its smallest diameter. Both the
/// velocity of the body and its mean velocity in this tick (displacement / tick) must satisfy this, because position
/// corrections of contacts and joints move a body without giving it a velocity.
uint32_t fall_asleep(const StepSettings& settings, Span<const BodyProperties> properties, Span<const BodyPose> poses,
                     Span<const BodySweep> sweeps, Span<const Island> islands, Span<const uint32_t> bodies,
                     Span<BodyMotion> motions, Span<BodyActivity> activities);

/// The function of the sleeping feature, for a feature table.
struct SleepingOps {
  decltype(&fall_asleep) end_step;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
