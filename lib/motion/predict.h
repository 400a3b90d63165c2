#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Starts the tick of a body: initialises its BodyWork. Returns the sum of the magnitudes of the components of its
/// angular velocity, m/s; 0 for a non-colliding body.
Real start_body(const StepSettings& settings, const BodyProperties& properties, const BodyPose& pose,
                const BodyMotion& motion, BodyWork& work);

/// Computes the changes of velocity by gravity, forces and damping in a substep, for each of `bodies`. Clears the
/// pending forces.
void predict(const StepSettings& settings, Span<const BodyProperties> properties, Span<const uint32_t> bodies,
             Span<BodyMotion> motions, Span<BodyWork> work);

/// Starts the tick of bodies. Computes bounds that contain each body on its predicted motion in this tick, enlarged by
/// WorldDef::contact_margin times its smallest diameter. A non-colliding body gets empty bounds.
void bound(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
           Span<const BodyMotion> motions, Span<const uint32_t> bodies, Span<BodyWork> work, Span<Bounds> bounds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
