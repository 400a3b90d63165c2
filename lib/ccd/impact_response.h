#pragma once
#include <detent/detail/scratch.h>

#include "contact/collide.h"
#include "solver/contact_rows.h"

/// What an impact does to two bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Holds the turning of a sweep to the range of spins, k_spin_max in each component, which that of a slender body may
/// leave. Returns 1 if it did not keep it, else 0.
uint32_t hold_turn(const BodyTraits& traits, Real tick_time, BodySweep& sweep);

/// The velocity and momentum that a body has on its sweep. A kinematic body's momentum is its spin, as in its state.
BodyMotion motion_of_sweep(const BodyTraits& traits, const Quat& rotation, const BodySweep& sweep, Scaled tick_rate);

/// The momentum of a body that its sweep takes from one rotation to another. It is the same in the world, unless the
/// body would so gain energy: a sweep's spin is constant, and of a slender body that tumbles it leads elsewhere than
/// its free motion. Then it is the same in the body, as its sweep has it.
Vec3<Real> carried_momentum(const BodyTraits& traits, const Quat& from, const Quat& to, const Vec3<Real>& momentum);

/// Gives the sweep what the motion has gained over `before`. Returns the number of components that were clamped.
uint32_t add_to_sweep(const BodyTraits& traits, const Quat& rotation, const BodyMotion& before, const BodyMotion& after,
                      Real tick_time, BodySweep& sweep);

/// Holds the spin to its range, k_spin_max in each component of the body's axes, also where it is far beyond: a blow on
/// a rod's edge may ask for more. Returns the number of components clamped.
uint32_t hold_spin(const BodyTraits& traits, const Quat& rotation, BodyMotion& motion);

/// A body that meets another.
struct ImpactBody {
  const BodyTraits& traits;
  const Quat& rotation;
  BodyMotion& motion;
};

/// Lets the points of the contact part: Newton's law of impact along the normal above the pair's threshold, Coulomb's
/// friction, by sequential impulses until no point approaches, and each parts at no less than `parting`, m/s.
/// `approach` becomes the greatest closing speed of before, m/s; false, and nothing changed, if no point closes faster
/// than `least`.
bool resolve_impact(const ContactWork& contact, uint32_t count, Real least, Real parting, const ImpactBody& a,
                    const ImpactBody& b, Real& approach);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
