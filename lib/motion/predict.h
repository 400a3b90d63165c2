#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Starts the tick of a body that has not moved yet. Returns the sum of the magnitudes of its angular velocity's
/// components, m/s; 0 for a non-colliding body.
Real start_body(const StepSettings& settings, const BodyProperties& properties, const BodyPose& pose,
                const BodyMotion& motion, BodyWork& work);

/// Computes the velocity changes by gravity, forces and damping in a substep, for the bodies of an island. Clears the
/// pending forces.
void predict(const StepSettings& settings, Span<const BodyProperties> properties, Span<const uint32_t> bodies,
             Span<BodyMotion> motions, Span<BodyWork> work);

/// Starts the tick of bodies, and computes their bounds over their predicted motion in this tick. The margin is the
/// contact margin: WorldDef::contact_margin times the smallest diameter. A non-colliding body gets empty bounds.
void bound(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
           Span<const BodyMotion> motions, Span<const uint32_t> bodies, Span<BodyWork> work, Span<Bounds> bounds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
