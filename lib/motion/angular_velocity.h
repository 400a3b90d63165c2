#pragma once
#include <detent/detail/scratch.h>

#include "math/arithmetic.h"
#include "math/rotation.h"
#include "math/scaled.h"
#include "shape/body.h"

/// Rotation of a body from its angular momentum. The library stores angular quantities as speeds, m/s. With the body's
/// unit of length u = 2^size_exponent m, mass m, angular momentum L, angular velocity w and inertia I, the stored
/// values are:
///
///     momentum = L / (m u);  angular velocity = w u;  inverse inertia = m u^2 / I (inverse inertia per unit mass)
///
/// So angular velocity = inverse inertia x momentum, for any mass and unit.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Real k_speed_max = 16384.0;  ///< limit of each component of a stored velocity, m/s
/// Limit of each component of a stored angular velocity w u, m/s. The bounding radius is at least u / 2. So if |w u| is
/// at this limit, a point at the bounding radius from the axis of rotation moves with at least half the limit.
inline constexpr Real k_angular_velocity_max = 32768.0;
inline constexpr Real k_speed_work_max = 32768.0;  ///< limit of each component of a velocity during a solve, m/s
/// Limit of each component of the stored momentum L / (m u) during a solve, m/s. The stored inverse inertia m u^2 / I
/// is at least 1 about each axis that is not locked. Therefore |w u| is at least |L / (m u)| for an L without
/// components about locked axes.
inline constexpr Real k_angular_velocity_work_max = 65536.0;

/// Clamps each component to +-limit. Returns the number of components that changed.
inline uint32_t clamp_component(Real& value, Real limit) {
  const Real clamped = clamp(value, -limit, limit);
  const bool changed = !(clamped == value);
  value = clamped;
  return changed ? 1 : 0;
}
inline uint32_t clamp_vector(Vec3<Real>& v, Real limit) {
  if (!DETENT_FIXED && abs(v.x) <= limit && abs(v.y) <= limit && abs(v.z) <= limit) return 0;
  return clamp_component(v.x, limit) + clamp_component(v.y, limit) + clamp_component(v.z, limit);
}

inline bool is_at_rest(const BodySweep& sweep) {
  return sweep.displacement == k_zero_vector && sweep.rotation_vector == k_zero_vector;
}

inline bool is_isotropic(const BodyProperties& properties) {
  return properties.inverse_inertia[0] == properties.inverse_inertia[1] &&
         properties.inverse_inertia[1] == properties.inverse_inertia[2];
}

/// Converts an arc, m, at radius 2^exponent m, to an angle, rad. Overflow: clamps the arc to +-2^16 m and the angle to
/// +-2^15 rad, and sets `clamped`.
inline Real angle_of(Real arc, int exponent, bool& clamped) {
  const Real limit = real_from_unit(Unit(1.0), exponent > 1 ? 16 : 15 + exponent);
  const Real held = clamp(arc, -limit, limit);
  clamped = clamped || !(held == arc);
  return scale_by_power(held, -exponent);
}

/// Twice the kinetic energy of rotation per unit mass, m^2/s^2. `local`: the angular momentum as in BodyMotion, but in
/// the body's axes.
Scaled rotational_energy(const BodyProperties& properties, const Vec3<Real>& local);

/// Inverse inertia times v, in the body's axes.
inline Vec3<Real> gyrate(const BodyProperties& properties, const Vec3<Real>& v) {
  return {multiply(v.x, properties.inverse_inertia[0]), multiply(v.y, properties.inverse_inertia[1]),
          multiply(v.z, properties.inverse_inertia[2])};
}

/// The angular velocity, m/s, world: inverse inertia times `angular_momentum`. For a kinematic body, `angular_momentum`
/// already is the angular velocity.
DETENT_SHARED inline Vec3<Real> angular_velocity_of(const BodyProperties& properties, const Quat& rotation,
                                                    const Vec3<Real>& angular_momentum) {
  if (!is_dynamic(properties)) return angular_momentum;
  if (is_isotropic(properties)) return gyrate(properties, angular_momentum);
  return rotate(rotation, gyrate(properties, rotate_inverse(rotation, angular_momentum)));
}

/// Inertia per unit mass about a body axis: 1 / inverse inertia; 0 if the axis is locked.
inline Scaled inertia_about(const BodyProperties& properties, int axis) {
  return is_positive(properties.inverse_inertia[axis]) ? divide(Scaled(1.0), properties.inverse_inertia[axis])
                                                       : Scaled(0.0);
}

/// The angular momentum for this angular velocity: the inverse of angular_velocity_of().
inline Vec3<Real> angular_momentum_of(const BodyProperties& properties, const Quat& rotation,
                                      const Vec3<Real>& angular_velocity) {
  if (!is_dynamic(properties)) return angular_velocity;
  const Vec3<Real> local = is_isotropic(properties) ? angular_velocity : rotate_inverse(rotation, angular_velocity);
  const Vec3<Real> angular_momentum = {multiply(local.x, inertia_about(properties, 0)),
                                       multiply(local.y, inertia_about(properties, 1)),
                                       multiply(local.z, inertia_about(properties, 2))};
  return is_isotropic(properties) ? angular_momentum : rotate(rotation, angular_momentum);
}

/// Returns the angular momentum without its components about locked axes. Contacts can add such components, but they
/// must have no effect.
DETENT_SHARED inline Vec3<Real> without_locked(const BodyProperties& properties, const Quat& rotation,
                                               const Vec3<Real>& angular_momentum) {
  if (properties.rotation_locks == 0 || !is_dynamic(properties)) return angular_momentum;
  const Real zero = 0.0;
  if (properties.rotation_locks == k_rotation_locks_all) return {zero, zero, zero};
  const Vec3<Real> local = rotate_inverse(rotation, angular_momentum);
  return rotate(rotation, Vec3<Real>{(properties.rotation_locks & k_rotation_lock_x) != 0 ? zero : local.x,
                                     (properties.rotation_locks & k_rotation_lock_y) != 0 ? zero : local.y,
                                     (properties.rotation_locks & k_rotation_lock_z) != 0 ? zero : local.z});
}

/// Rotates `rotation` by the torque-free motion over `time`, s, of a body with the angular momentum L. Let b and c be
/// the two body axes with the closest inverse inertias, a the third axis, and I_a, I_b, I_c the inertias. The kinetic
/// energy is split into three terms:
///
///     |L|^2 / 2 I_b + (1/I_a - 1/I_b) L_a^2 / 2 + (1/I_c - 1/I_b) L_c^2 / 2
///
/// The motion of each term is an exact rotation: about L, about a, and about c. In each of 2^halvings steps, the
/// rotation about c is done in two halves, before and after the rotation about a (Strang splitting). This conserves the
/// angular momentum exactly. The error of the energy is proportional to 1/I_c - 1/I_b and to the square of the step's
/// length. The motion of a symmetric body is exact, even if it is slender. `free`: the result of free_rotation_of().
/// Sets `angular_velocity` to the angular velocity at the start, as angular_velocity_of() returns it. Returns false if
/// an angle was clamped by angle_of(), or an angular velocity to the range of Real. Source: Dullweber, Leimkuhler,
/// McLachlan, "Symplectic splitting methods for rigid body molecular dynamics", 1997.
bool rotate_freely(const BodyProperties& properties, const FreeRotation& free, const Vec3<Real>& angular_momentum,
                   Real time, int halvings, Quat& rotation, Vec3<Real>& angular_velocity);

FreeRotation free_rotation_of(const BodyProperties& properties);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
