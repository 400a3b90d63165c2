#pragma once
#include "math/root.h"
#include "math/trig.h"

/// Rotations. A Quat is of length 1 within k_normalise_quat_error after normalise().
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Quat k_identity = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)};

/// The rotation b followed by a. Rounding: each component once.
Quat multiply(const Quat& a, const Quat& b);
constexpr Quat conjugate(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }
/// Brings the length back to 1. Range: | |q|^2 - 1 | < 2^-8.
Quat normalise(const Quat& q);
/// Brings the length back to 1. Range: |q| in [1/2, 2).
Quat normalise_any(const Quat& q);
/// Normalises a rotation given by the user. Returns false and leaves `out` unchanged unless | |q| - 1 | <= 2^-10.
bool normalise_input(const Quat& q, Quat& out);

/// Rotates v from local to world axes: q v q*.
Vec3<Unit> rotate(const Quat& q, const Vec3<Unit>& v);
/// Rotates v from world to local axes: q* v q.
Vec3<Unit> rotate_inverse(const Quat& q, const Vec3<Unit>& v);
#if DETENT_FIXED
/// As rotate() and rotate_inverse() above, for lengths. Range: |v| < 2^16 m.
Vec3<Real> rotate(const Quat& q, const Vec3<Real>& v);
Vec3<Real> rotate_inverse(const Quat& q, const Vec3<Real>& v);
#endif

Matrix3 matrix_from(const Quat& q);

/// m v.
template <class T>
DETENT_SHARED constexpr Vec3<T> multiply(const Matrix3& m, const Vec3<T>& v) {
  const Vec3<Unit>* c = m.column;
  return {dot(v, Vec3<Unit>{c[0].x, c[1].x, c[2].x}), dot(v, Vec3<Unit>{c[0].y, c[1].y, c[2].y}),
          dot(v, Vec3<Unit>{c[0].z, c[1].z, c[2].z})};
}
/// The transpose of m times v: the inverse rotation.
template <class T>
DETENT_SHARED constexpr Vec3<T> multiply_transposed(const Matrix3& m, const Vec3<T>& v) {
  return {dot(v, m.column[0]), dot(v, m.column[1]), dot(v, m.column[2])};
}

/// The rotation by `angle`, reduced to [-1/2, 1/2) turn, about a unit axis.
Quat rotation_about(const Vec3<Unit>& axis, Angle angle);
/// The rotation by |theta| rad about theta. Range: |theta| <= 2^16. Exactly the identity for 0.
Quat rotation_from_vector(const Vec3<Real>& theta);
/// The rotation vector, rad, of length in [0, pi]; the same for q and -q.
Vec3<Real> rotation_vector_from(const Quat& q);

// Errors of a component in steps (k_unit_step). Arguments whose length is not exactly 1 cause further errors.
inline constexpr double k_normalise_quat_error = 4.0;  ///< of |q| after normalise(), if | |q|^2 - 1 | < 2^-10 before
inline constexpr double k_rotate_error = 4.0;          ///< for |v| <= 1; Real vectors: steps of Real, any |v|
inline constexpr double k_rotation_error = 4.0;        ///< rotation_from_vector; float: times 1 + |theta|
inline constexpr double k_rotation_vector_error = 10.0;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
