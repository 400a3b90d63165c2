#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Computes the sweep of each body in `slots` over the tick, from its pose at the start of the tick to its pose after
/// the substeps. Returns the number of bodies whose rotation vector was clamped.
uint32_t make_sweeps(Span<const uint32_t> slots, Span<const BodyProperties> properties, Span<const BodyWork> work,
                     Span<const BodyPose> poses, Span<BodySweep> sweeps);

/// Returns the part of a body's sweep from sweep.from to the end of the tick.
inline Sweep rest_of_tick(const BodySweep& sweep) {
  const Sweep whole = {sweep.displacement, sweep.rotation_vector};
  return sweep.from.raw == 0 ? whole : sweep_part(whole, k_whole_step - sweep.from);
}

/// Ends the tick of a body that may have moved. The pose becomes the pose at the end of the sweep. A dynamic body loses
/// the angular momentum about its locked axes, and clamp_speeds() clamps its velocities. Returns a count of clamped
/// values: the coordinates of the position that were clamped, plus the result of clamp_speeds().
uint32_t finalise_body(const BodyProperties& properties, const BodySweep& sweep, BodyPose& pose, BodyMotion& motion);

/// Clamps each component of the velocity to k_speed_max and of the angular momentum to k_angular_velocity_work_max.
/// Then scales the angular momentum down until each component of the angular velocity is within k_angular_velocity_max.
/// Returns the number of components that were clamped plus the number of times that the momentum was scaled.
uint32_t clamp_speeds(const BodyProperties& properties, const Quat& rotation, BodyMotion& motion);

/// In `contacts`, replaces the contacts of the last tick that `awake` lists with the contacts of this tick, `work`.
/// Does the same with the manifolds, if the world stores them. All lists are sorted. The contacts that `awake` does not
/// list belong to sleeping bodies and stay. `awake_count`: the number of indices in `awake` before the call. `before`:
/// the total number of contacts before the call. Elements that are no longer needed become zero. After the call,
/// `awake` lists the contacts of this tick; it must have room for them.
void store_contacts(Span<const ContactWork> work, Span<const ManifoldState> manifold_work, uint32_t awake_count,
                    uint32_t before, Span<ContactState> contacts, Span<ManifoldState> manifolds, Span<uint32_t> awake);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
