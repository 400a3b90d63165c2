#pragma once
#include <detent/detail/scratch.h>

#include "math/arithmetic.h"
#include "math/scaled.h"

/// How the two bodies of a contact move along a row, and what an impulse along it does to them. All in m/s.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Relative velocity of B to A along `direction` at the row's point.
inline Real row_velocity(const ContactRow& row, const Vec3<Unit>& direction, const BodyMotion& a, const BodyMotion& b) {
  return dot(b.velocity - a.velocity, direction) + (scale_by_power(dot(b.momentum, row.response_b), row.exponent_b) -
                                                    scale_by_power(dot(a.momentum, row.response_a), row.exponent_a));
}

/// Relative spin of B to A about a row's axis, in the pair's unit of length.
inline Real row_spin(const AngularRow& row, const BodyMotion& a, const BodyMotion& b) {
  return scale_by_power(dot(b.momentum, row.response_b), row.exponent_b) -
         scale_by_power(dot(a.momentum, row.response_a), row.exponent_a);
}

inline bool takes_impulses(Scaled share) { return is_positive(share); }

/// impulse x share; the lighter body's share is 1, and most pairs are of a body and the ground, or of equals.
inline Real shared(Real impulse, Scaled share) { return share == Scaled(1.0) ? impulse : multiply(impulse, share); }

/// Applies `impulse` to B along `direction`, and its opposite to A.
inline void apply_impulse(const ContactWork& contact, const ContactRow& row, const Vec3<Unit>& direction, Real impulse,
                          BodyMotion& a, BodyMotion& b) {
  if (takes_impulses(contact.share_a)) {
    const Real part = shared(impulse, contact.share_a);
    a.velocity -= direction * part;
    a.momentum -= row.arm_a * part;
  }
  if (takes_impulses(contact.share_b)) {
    const Real part = shared(impulse, contact.share_b);
    b.velocity += direction * part;
    b.momentum += row.arm_b * part;
  }
}

/// Applies an angular impulse about `axis` to B, and its opposite to A.
inline void apply_angular_impulse(const ContactWork& contact, const Vec3<Unit>& axis, Real impulse, BodyMotion& a,
                                  BodyMotion& b) {
  if (takes_impulses(contact.share_a)) {
    a.momentum -= axis * scale_by_power(shared(impulse, contact.share_a), contact.shift_a);
  }
  if (takes_impulses(contact.share_b)) {
    b.momentum += axis * scale_by_power(shared(impulse, contact.share_b), contact.shift_b);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
