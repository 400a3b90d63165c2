#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The sweep of the tick of each of `slots`, from its start to where the substeps brought it. Returns the number of
/// components that were clamped.
uint32_t make_sweeps(Span<const uint32_t> slots, Span<const BodyTraits> traits, Span<const BodyWork> work,
                     Span<const BodyPose> poses, Span<BodySweep> sweeps);

/// What of a body's sweep is left when it begins.
inline Sweep rest_of_tick(const BodySweep& sweep) {
  const Sweep whole = {sweep.displacement, sweep.turn};
  return sweep.from.raw == 0 ? whole : sweep_part(whole, k_whole_step - sweep.from);
}

/// Ends the tick of a body that may have moved: its pose is that of the end of its sweep, and its velocities are held
/// to their range. Returns the number of components that were clamped.
uint32_t finalise(const BodyTraits& traits, const BodySweep& sweep, BodyPose& pose, BodyMotion& motion);

/// Holds velocity to k_speed_max, momentum to k_spin_work_max and spin to k_spin_max. Returns the number of components
/// clamped.
uint32_t hold_speeds(const BodyTraits& traits, const Quat& rotation, BodyMotion& motion);

/// Puts the contacts of this tick, with their manifolds if there are any, in the place of those of the last one that
/// are listed in `awake`; all are sorted, and the others, which sleep, stay. There were `before` in all: places no
/// longer needed become zero. `awake` then lists the new ones, and must have room for them.
void store_contacts(Span<const ContactWork> work, Span<const ManifoldState> manifold_work, uint32_t awake_count,
                    uint32_t before, Span<ContactState> contacts, Span<ManifoldState> manifolds, Span<uint32_t> awake);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
