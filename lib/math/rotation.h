#pragma once
#include "math/root.h"
#include "math/trig.h"

/// Rotations. After normalise(), the length of a Quat is 1 within k_normalise_quat_error.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Quat k_identity = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)};

/// The product a b: the rotation b followed by the rotation a. Rounding: each component once (float: each operation).
Quat multiply(const Quat& a, const Quat& b);
/// The product of q and the rotation about coordinate axis `axis` that has these `sine` and `cosine` of half its angle.
/// Rounding: as multiply().
Quat multiply_about(const Quat& q, int axis, Unit sine, Unit cosine);
constexpr Quat conjugate(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }
/// Scales q to length 1. Range: | |q|^2 - 1 | < 2^-8.
Quat normalise(const Quat& q);
/// Scales q to length 1. Range: |q| in [1/2, 2).
Quat normalise_any(const Quat& q);
/// Normalises a rotation given by the user. If | |q| - 1 | > 2^-10, returns false and leaves `out` unchanged.
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

/// The product m v.
template <class T>
DETENT_SHARED constexpr Vec3<T> multiply(const Matrix3& m, const Vec3<T>& v) {
  const Vec3<Unit>* c = m.column;
  return {dot(v, Vec3<Unit>{c[0].x, c[1].x, c[2].x}), dot(v, Vec3<Unit>{c[0].y, c[1].y, c[2].y}),
          dot(v, Vec3<Unit>{c[0].z, c[1].z, c[2].z})};
}
/// The product of the transpose of m and v: v rotated by the inverse of m.
template <class T>
DETENT_SHARED constexpr Vec3<T> multiply_transposed(const Matrix3& m, const Vec3<T>& v) {
  return {dot(v, m.column[0]), dot(v, m.column[1]), dot(v, m.column[2])};
}

/// The rotation by `angle` about a unit axis. The angle is first reduced to [-1/2, 1/2) turn (f64: not reduced).
Quat rotation_about(const Vec3<Unit>& axis, Angle angle);
/// The rotation by |theta| rad about the direction of theta. If theta is 0, exactly the identity.
/// Range: |theta| <= 2^16.
Quat rotation_from_vector(const Vec3<Real>& theta);
/// The rotation vector of q, rad. Its length is in [0, pi], and it is the same for q and -q.
Vec3<Real> rotation_vector_from(const Quat& q);

// Largest errors, in steps (k_unit_step). A quaternion or axis whose length is not exactly 1 causes further errors.
/// Error of |q| after normalise(), if | |q|^2 - 1 | < 2^-10 before.
inline constexpr double k_normalise_quat_error = 4.0;
/// Error of a component of a rotated vector v, |v| <= 1. For a Real vector of any length, the unit of this error is
/// 2^-46 in fixed point, and a step times the least power of two above |v| in float.
inline constexpr double k_rotate_error = 4.0;
/// Error of a component of the result of rotation_from_vector(). In float, the error is this times (1 + |theta|).
inline constexpr double k_rotation_error = 4.0;
inline constexpr double k_rotation_vector_error = 10.0;  ///< error of a component of rotation_vector_from()

}  // namespace DETENT_NAMESPACE
}  // namespace detent
