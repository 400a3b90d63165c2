#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Ends the tick: each body's sweep from its start to where the substeps brought it, its pose at the sweep's end, and
/// its velocities held to their range. Returns the number of components that were clamped.
uint32_t finalise(Span<const BodyTraits> traits, Span<const BodyWork> work, Span<BodyPose> poses,
                  Span<BodyMotion> motions);

/// Holds velocity to k_speed_max and spin to k_spin_max. Returns the number of components clamped.
uint32_t hold_speeds(const BodyTraits& traits, const Quat& rotation, BodyMotion& motion);

/// Puts the contacts of this tick in place of those of the last one, whose count was `before`.
void store_contacts(Span<const ContactWork> work, Span<ContactState> contacts, uint32_t before);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
