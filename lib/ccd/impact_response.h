#pragma once
#include <detent/detail/scratch.h>

#include "contact/collide.h"
#include "solver/contact_rows.h"

/// The response of two bodies to an impact.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Scales the rotation of a sweep down until each component is within the range of angular velocities,
/// k_angular_velocity_max. The sweep of a slender body can leave that range. Returns 1 if the rotation was scaled, else
/// 0.
uint32_t clamp_rotation(const BodyProperties& properties, Real tick_time, BodySweep& sweep);

/// The velocity and angular momentum of a body that moves along its sweep. The `angular_momentum` of a kinematic body
/// is its angular velocity, as in its state. `tick_rate`: ticks per second.
BodyMotion motion_of_sweep(const BodyProperties& properties, const Quat& rotation, const BodySweep& sweep,
                           Scaled tick_rate);

/// The angular momentum of a body after its sweep has rotated it from one rotation to another. It stays constant in
/// world axes, unless the body's energy of rotation would then rise by more than 2^-16 of its value. The energy can
/// rise because the sweep of a tumbling body, with its constant angular velocity, differs from the free motion. In that
/// case, if the body is slender or the energy would rise by more than a quarter, the angular momentum stays constant in
/// the body's axes, as on the sweep. Otherwise it is scaled so that the energy does not change.
Vec3<Real> carried_angular_momentum(const BodyProperties& properties, const Quat& from, const Quat& to,
                                    const Vec3<Real>& angular_momentum);

/// Adds to the sweep the displacement and the rotation that the change of the velocities from `before` to `after`
/// causes in a whole tick. Returns the number of components that were clamped.
uint32_t add_to_sweep(const BodyProperties& properties, const Quat& rotation, const BodyMotion& before,
                      const BodyMotion& after, Real tick_time, BodySweep& sweep);

/// Clamps the angular velocity to k_angular_velocity_max in each component, in the body's axes. Values may be far
/// beyond that range, because an impulse on the edge of a rod can cause them. Returns 1 if a component was clamped,
/// else 0.
uint32_t clamp_angular_velocity(const BodyProperties& properties, const Quat& rotation, BodyMotion& motion);

/// One of the two bodies of an impact. resolve_impact() changes `motion`.
struct ImpactBody {
  const BodyProperties& properties;
  const Quat& rotation;
  BodyMotion& motion;
};

/// Separates the bodies at the points of the contact. Points that approach at least at the speed `contact.rebound_min`
/// rebound by Newton's law of impact along the normal. Friction follows Coulomb's law. The impulses are computed by a
/// limited number of passes over the `count` points, so that each point separates at `parting`, m/s, or faster.
/// `approach` becomes the largest closing speed before the impulse, m/s. Returns false, with the motions unchanged, if
/// no point closes faster than `least`, m/s.
bool resolve_impact(const ContactWork& contact, uint32_t count, Real least, Real parting, const ImpactBody& a,
                    const ImpactBody& b, Real& approach);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
