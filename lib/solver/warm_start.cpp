#include "solver/warm_start.h"

#include "math/scaled.h"
#include "motion/contact_motion.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Scaled scaled_dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  const auto part = [](Real x, Real y) { return multiply(scaled_from(x), scaled_from(y)); };
  return add(part(a.x, b.x), add(part(a.y, b.y), part(a.z, b.z)));
}

/// The share of the warm start that the island keeps. Range: no body of the island has a joint, and no contact has a
/// kinematic body.
Scaled share_of_warm_start(const SolverBodies& bodies, Span<const uint32_t> island) {
  Scaled own = 0.0, energy = 0.0;  // p M p and E
  for (const uint32_t slot : island) {
    const BodyProperties& properties = bodies.properties[slot];
    const BodyMotion& motion = bodies.motions[slot];
    const BodyWork& now = bodies.work[slot];
    Scaled squared = 0.0, work = 0.0;  // p M p and E per unit mass
    const auto count = [&](const Vec3<Real>& change, const Vec3<Real>& after, const Vec3<Real>& speed) {
      squared = add(squared, scaled_dot(speed, change));
      work = add(work, scaled_dot(speed, after - scale_by_power(change, -1)));
    };
    const Vec3<Real> pushed = added_by_contacts(motion.linear_velocity, now.contact_velocity);
    const Vec3<Real> turned = added_by_contacts(motion.angular_momentum, now.contact_angular_momentum);
    count(pushed, motion.linear_velocity, pushed);
    count(turned, motion.angular_momentum, world_angular_velocity(properties, now.inverse_inertia, turned, 0));
    own = add(own, multiply(properties.mass, squared));
    energy = add(energy, multiply(properties.mass, work));
  }
  if (!is_positive(energy)) return 1.0;
  return less(energy, own) ? add(Scaled(1.0), negate(divide(energy, own))) : Scaled(0.0);
}

}  // namespace

bool limit_warm_start(const SolverBodies& bodies, Span<const uint32_t> island) {
  if (bodies.work[island[0]].supports == 0) return false;
  const Scaled share = share_of_warm_start(bodies, island), change = add(share, Scaled(-1.0));
  const auto take_back = [&](Vec3<Real>& motion, Vec3<Real>& kept) {
    const Vec3<Real> back = multiply(added_by_contacts(motion, kept), change);
    motion += back;
    if (!DETENT_FIXED) kept += back;
  };
  for (const uint32_t slot : island) {
    BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    now.carried = share;
    if (share == Scaled(1.0)) continue;
    take_back(motion.linear_velocity, now.contact_velocity);
    take_back(motion.angular_momentum, now.contact_angular_momentum);
    renew_angular_velocity(bodies.properties[slot], motion, now);
  }
  return !(share == Scaled(1.0));
}

void scale_impulses(Scaled share, ContactWork& contact) {
  const auto scale = [&](Real& value) {
    bool saturated = false;
    value = multiply(value, share, saturated);
  };
  for (Real& impulse : contact.state.normal_impulse) scale(impulse);
  for (Real& impulse : contact.friction_impulse) scale(impulse);
  for (Real& impulse : contact.angular_impulse) scale(impulse);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
