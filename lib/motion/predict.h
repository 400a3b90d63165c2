#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Starts the tick of a body: it has not moved yet. Returns the sum of its spin's components, m/s; 0 for one that
/// nobody may touch.
Real start_body(const StepSettings& settings, const BodyTraits& traits, const BodyPose& pose, const BodyMotion& motion,
                BodyWork& work);

/// What gravity, forces and damping do to the bodies of an island in a substep. The forces are taken over and cleared.
void predict(const StepSettings& settings, Span<const BodyTraits> traits, Span<const uint32_t> bodies,
             Span<BodyMotion> motions, Span<BodyWork> work);

/// Starts the tick of bodies, and takes their bounds over their predicted motion of this tick, with a margin of 1/64 of
/// their smallest diameter; nowhere for those that nobody may touch.
void bound(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyTraits> traits,
           Span<const BodyMotion> motions, Span<const uint32_t> bodies, Span<BodyWork> work, Span<Bounds> bounds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
