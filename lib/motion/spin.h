#pragma once
#include <detent/detail/scratch.h>

#include "math/arithmetic.h"
#include "math/rotation.h"
#include "math/scaled.h"
#include "shape/body.h"

/// Rotation of a body from its angular momentum. Momentum and spin are in speeds: momentum = L / (m u) and
/// spin = w u, where u = 2^size_exponent m, so that spin = gyration x momentum whatever the mass and the scale.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Real k_speed_max = 16384.0;  ///< m/s, of state: each component of velocity
inline constexpr Real k_spin_max = 32768.0;   ///< m/s, of state: likewise of spin; the rim moves at half of it or more
inline constexpr Real k_speed_work_max = 32768.0;  ///< m/s, of velocity within a solve
inline constexpr Real k_spin_work_max = 65536.0;   ///< m/s, of momentum within a solve; no gyration is below 1

/// Clamps to +-limit; returns how many components that changed.
inline uint32_t clamp_component(Real& value, Real limit) {
  const Real clamped = clamp(value, -limit, limit);
  const bool changed = !(clamped == value);
  value = clamped;
  return changed ? 1 : 0;
}
inline uint32_t clamp_vector(Vec3<Real>& v, Real limit) {
  return clamp_component(v.x, limit) + clamp_component(v.y, limit) + clamp_component(v.z, limit);
}

inline bool is_at_rest(const BodySweep& sweep) {
  return sweep.displacement == k_zero_vector && sweep.turn == k_zero_vector;
}

inline bool is_isotropic(const BodyTraits& traits) {
  return traits.gyration[0] == traits.gyration[1] && traits.gyration[1] == traits.gyration[2];
}

/// An arc, m, at radius 2^exponent m, as an angle, rad; `clamped` is set if it had to be held to 2^15 rad.
inline Real angle_of(Real arc, int exponent, bool& clamped) {
  const Real limit = real_from_unit(Unit(1.0), exponent > 1 ? 16 : 15 + exponent);
  const Real held = clamp(arc, -limit, limit);
  clamped = clamped || !(held == arc);
  return scale_by_power(held, -exponent);
}

/// gyration x v, in the body's axes.
inline Vec3<Real> gyrate(const BodyTraits& traits, const Vec3<Real>& v) {
  return {multiply(v.x, traits.gyration[0]), multiply(v.y, traits.gyration[1]), multiply(v.z, traits.gyration[2])};
}

/// gyration (world) x `momentum`; for a kinematic body the momentum is the spin. m/s, world.
inline Vec3<Real> spin_of(const BodyTraits& traits, const Quat& rotation, const Vec3<Real>& momentum) {
  if (!is_dynamic(traits)) return momentum;
  if (is_isotropic(traits)) return gyrate(traits, momentum);
  return rotate(rotation, gyrate(traits, rotate_inverse(rotation, momentum)));
}

/// 1 / gyration about a body axis: its share of the spin as momentum; 0 if it is locked.
inline Scaled inertia_about(const BodyTraits& traits, int axis) {
  return is_positive(traits.gyration[axis]) ? divide(Scaled(1.0), traits.gyration[axis]) : Scaled(0.0);
}

/// The momentum that has this spin: the inverse of spin_of().
inline Vec3<Real> momentum_of(const BodyTraits& traits, const Quat& rotation, const Vec3<Real>& spin) {
  if (!is_dynamic(traits)) return spin;
  const Vec3<Real> local = is_isotropic(traits) ? spin : rotate_inverse(rotation, spin);
  const Vec3<Real> momentum = {multiply(local.x, inertia_about(traits, 0)), multiply(local.y, inertia_about(traits, 1)),
                               multiply(local.z, inertia_about(traits, 2))};
  return is_isotropic(traits) ? momentum : rotate(rotation, momentum);
}

/// What the turn locks leave of a momentum: contacts push about a locked axis too, and nothing comes of it.
inline Vec3<Real> without_locked(const BodyTraits& traits, const Quat& rotation, const Vec3<Real>& momentum) {
  if (traits.turn_locks == 0 || !is_dynamic(traits)) return momentum;
  const Real zero = 0.0;
  if (traits.turn_locks == k_turn_locks_all) return {zero, zero, zero};
  const Vec3<Real> local = rotate_inverse(rotation, momentum);
  return rotate(rotation, Vec3<Real>{(traits.turn_locks & k_turn_lock_x) != 0 ? zero : local.x,
                                     (traits.turn_locks & k_turn_lock_y) != 0 ? zero : local.y,
                                     (traits.turn_locks & k_turn_lock_z) != 0 ? zero : local.z});
}

/// Turns `rotation` for `time`, s, by the free motion of a body of this momentum. With 1/I of two axes, b and c, near
/// each other and that of the third, a, apart, the energy is |L|^2 / 2I_b, whose motion is a turn about L, and the
/// rest: (1/I_a - 1/I_b) L_a^2 / 2 and (1/I_c - 1/I_b) L_c^2 / 2, whose motions are turns about those axes. Each is
/// exact; the last is split in two halves about the other (Strang), so the momentum is kept exactly and the energy to
/// second order in 1/I_c - 1/I_b: a symmetric body, however slender, moves exactly. `spin` becomes spin_of at the
/// start. Returns false if an angle was clamped, to 2^15 rad. Source: Dullweber, Leimkuhler, McLachlan, "Symplectic
/// splitting methods for rigid body molecular dynamics", 1997.
bool turn_freely(const BodyTraits& traits, const FreeTurn& free, const Vec3<Real>& momentum, Real time, int halvings,
                 Quat& rotation, Vec3<Real>& spin);

FreeTurn free_turn_of(const BodyTraits& traits);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
