#pragma once
#include <math.h>

/// Vectors in double, for the references. They share nothing with the library's own.
namespace detent_oracle {

struct Vector {
  double v[3];
  double& operator[](int i) { return v[i]; }
  double operator[](int i) const { return v[i]; }
};
inline Vector operator+(const Vector& a, const Vector& b) { return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
inline Vector operator*(const Vector& a, double s) { return {{a[0] * s, a[1] * s, a[2] * s}}; }
inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}
inline double length(const Vector& a) { return sqrt(dot(a, a)); }
inline Vector normalised(const Vector& a) { return a * (1 / length(a)); }

/// x, y, z, w.
struct Quaternion {
  double x, y, z, w;
};
inline Quaternion normalised(const Quaternion& q) {
  const double s = 1 / sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x * s, q.y * s, q.z * s, q.w * s};
}
/// The rotation b followed by a.
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
/// The rotation by |theta| rad about theta.
inline Quaternion rotation_by(const Vector& theta) {
  const double angle = length(theta);
  if (angle == 0) return {0, 0, 0, 1};
  const Vector v = theta * (sin(angle / 2) / angle);
  return {v[0], v[1], v[2], cos(angle / 2)};
}
/// The image of local axis `i`, of a rotation of any length but 0.
inline Vector axis_of(const Quaternion& rotation, int i) {
  const Quaternion q = normalised(rotation);
  switch (i) {
    case 0:
      return {{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)}};
    case 1:
      return {{2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)}};
    default:
      return {{2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}};
  }
}

}  // namespace detent_oracle
