#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "geometry/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Each body's sweep of the tick, from its start to where the substeps brought it. Returns the number of components
/// that were clamped.
uint32_t make_sweeps(Span<const BodyTraits> traits, Span<const BodyWork> work, Span<const BodyPose> poses,
                     Span<BodySweep> sweeps);

/// What of a body's sweep is left when it begins.
inline Sweep rest_of_tick(const BodySweep& sweep) {
  const Sweep whole = {sweep.displacement, sweep.turn};
  return sweep.from.raw == 0 ? whole : sweep_part(whole, k_whole_step - sweep.from);
}

/// Ends the tick: each body's pose at the end of its sweep, and its velocities held to their range. Returns the number
/// of components that were clamped.
uint32_t finalise(Span<const BodyTraits> traits, Span<const BodySweep> sweeps, Span<BodyPose> poses,
                  Span<BodyMotion> motions);

/// Holds velocity to k_speed_max and spin to k_spin_max. Returns the number of components clamped.
uint32_t hold_speeds(const BodyTraits& traits, const Quat& rotation, BodyMotion& motion);

/// Puts the contacts of this tick, and their manifolds if there are any, among those that sleep, the first `sleeping`
/// of `contacts`; both are sorted. There were `before` in the last tick: places no longer needed become zero.
void store_contacts(Span<const ContactWork> work, Span<const ManifoldState> manifold_work, uint32_t sleeping,
                    uint32_t before, Span<ContactState> contacts, Span<ManifoldState> manifolds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
