#pragma once
#include <detent/contact.h>
#include <detent/detail/shared.h>
#include <detent/detail/state.h>

#include "math/arithmetic.h"
#include "math/scaled.h"
#include "shape/shape_properties.h"

/// The valid ranges of values from outside: from calls and from snapshots. NaN is outside every range.
namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_SHARED inline bool is_zero(const uint8_t* bytes, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    if (bytes[i] != 0) return false;
  }
  return true;
}
template <class T>
bool is_zero(const T& value) {
  return is_zero(reinterpret_cast<const uint8_t*>(&value), sizeof value);
}

DETENT_SHARED inline bool within(Real value, Real low, Real high) { return value >= low && value <= high; }
DETENT_SHARED inline bool within(const Vec3<Real>& v, Real limit) {
  return within(v.x, -limit, limit) && within(v.y, -limit, limit) && within(v.z, -limit, limit);
}

#if DETENT_FIXED
/// Whether the value is canonical (its mantissa is normalised; zero has exponent 0), and its exponent is so small that
/// the product of two values does not overflow.
DETENT_SHARED inline bool is_number(Scaled value) {
  if (value.mantissa == 0) return value.exponent == 0;
  const uint32_t magnitude = magnitude_32(value.mantissa);
  return magnitude >= (1u << 30) && magnitude < (1u << 31) && value.exponent >= -130 && value.exponent <= 70;
}
inline bool is_position(const Position&) { return true; }
#else
inline bool is_number(Scaled value) { return value >= Scaled(-0x1p100) && value <= Scaled(0x1p100); }
#if defined(DETENT_F64)
inline bool is_position(const Position& p) { return within({p.x, p.y, p.z}, k_coord_max); }
#else
inline bool is_position(const Position&) { return true; }
#endif
#endif
DETENT_SHARED inline bool is_number(const Vec3<Scaled>& v) {
  return is_number(v.x) && is_number(v.y) && is_number(v.z);
}
DETENT_SHARED inline bool is_between(Scaled value, Scaled low, Scaled high) {
  return is_number(value) && !less(value, low) && !less(high, value);
}
DETENT_SHARED inline bool is_mass(Scaled value) { return is_between(value, Scaled(0x1p-60), Scaled(0x1p60)); }

/// Whether the value is a valid inverse inertia per unit mass of a dynamic body. No solid has a value below 1.
inline bool is_inverse_inertia(Scaled value) { return is_between(value, Scaled(1.0), k_inverse_inertia_max); }

DETENT_SHARED inline bool are_inverse_inertias(const BodyProperties& properties) {
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const bool locked = (properties.rotation_locks >> axis & 1) != 0;
    if (locked ? !(properties.inverse_inertia[axis] == Scaled(0.0))
               : !is_inverse_inertia(properties.inverse_inertia[axis]))
      return false;
  }
  return true;
}

inline bool is_type(BodyType type) {
  return type == BodyType::fixed || type == BodyType::kinematic || type == BodyType::dynamic;
}

inline bool is_rule(RestitutionRule rule) {
  return rule == RestitutionRule::larger || rule == RestitutionRule::smaller;
}

inline bool is_stabilisation(Stabilisation stabilisation) {
  return stabilisation == Stabilisation::soft || stabilisation == Stabilisation::post;
}

inline bool is_reduction(ManifoldReduction reduction) {
  return reduction == ManifoldReduction::projected_extremes || reduction == ManifoldReduction::deepest_area;
}

inline constexpr Real k_friction_max = 16.0;  ///< limit of friction and of rolling resistance
inline constexpr Real k_damping_max = 1024.0;
inline constexpr Real k_gravity_max = 1024.0;
inline constexpr Real k_gravity_scale_max = 1024.0;

/// Whether the settings of a world are within the ranges documented in WorldDef.
DETENT_SHARED inline bool are_settings(const Vec3<Real>& gravity, Real tick, uint32_t substeps, uint32_t substeps_max,
                                       uint32_t iterations, uint32_t convergence, Real relaxation,
                                       Real contact_frequency, Real damping_ratio, Real restitution_threshold,
                                       Real contact_margin, Real contact_recycle_distance, Real resting_penetration) {
  return within(gravity, k_gravity_max) && within(tick, Real(0x1p-14), Real(0.25)) && substeps <= 64 &&
         substeps_max >= 1 && substeps_max <= 64 && iterations >= 1 && iterations <= 64 && convergence <= 30 &&
         within(relaxation, Real(0.25), Real(1.75)) && within(contact_frequency, Real(0x1p-6), Real(0.25)) &&
         within(damping_ratio, Real(0.0), Real(64.0)) && within(restitution_threshold, Real(0.0), Real(64.0)) &&
         within(contact_margin, Real(0x1p-10), Real(0x1p-4)) &&
         within(contact_recycle_distance, Real(0.0), Real(0x1p-6)) &&
         within(resting_penetration, Real(0x1p-12), Real(0x1p-3));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
