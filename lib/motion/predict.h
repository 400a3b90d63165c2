#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "math/arithmetic.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Starts the tick of a body: initialises its BodyWork. Returns the sum of the magnitudes of the components of its
/// angular velocity, in m/s at the radius 2^size_exponent m.
Real start_body(const StepSettings& settings, const BodyProperties& properties, const BodyPose& pose,
                const BodyMotion& motion, BodyWork& work);

/// The speculative distance of a pair, m: contact points are found up to this separation. It is the contact margin plus
/// the distance by which the bodies can approach each other in the tick. `extent`: BodyWork::extent of the smaller
/// body, m. `speed`: the sum of both BodyWork::speed, m/s. The distance of approach counts at most as a quarter of the
/// extent; if a body of the pair has joints, at most as twice the extent, because impacts do not stop jointed bodies
/// (ccd/impact.h).
inline Real speculative_distance(const StepSettings& settings, Real extent, Real speed, bool jointed) {
  return extent * settings.contact_margin + min(scale_by_power(extent, jointed ? 1 : -2), speed * settings.tick_time);
}

/// Computes the changes of velocity and angular momentum by gravity, forces, torques and damping in a substep, for each
/// of `bodies`. Clears the pending forces and torques.
void predict(const StepSettings& settings, Span<const BodyProperties> properties, Span<const uint32_t> bodies,
             Span<BodyMotion> motions, Span<BodyWork> work);

/// Starts the tick of the given bodies (start_body()). Sets the bounds of each body so that they contain it on its
/// predicted motion in this tick, enlarged by WorldDef::contact_margin times bounds_extent(). A non-colliding body gets
/// empty bounds, a half-space unbounded bounds.
void bound(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
           Span<const BodyMotion> motions, Span<const uint32_t> bodies, Span<BodyWork> work, Span<Bounds> bounds);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
