#pragma once
#include <math.h>

#include "tests/common/queries/query.h"

namespace detent_queries {

using Rotation = std::array<double, 4>;

inline Triple operator+(const Triple& a, const Triple& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Triple operator-(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Triple operator*(const Triple& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Triple& a) { return sqrt(dot(a, a)); }

/// The nearest float. Not inlined: GCC 12 drops the rounding of a pair of numbers that it makes one vector of (x86-64,
/// -O2).
[[gnu::noinline]] inline double to_float(double value) { return static_cast<double>(static_cast<float>(value)); }
inline Triple to_float(const Triple& a) { return {to_float(a[0]), to_float(a[1]), to_float(a[2])}; }

/// The rotation, normalised, of a vector.
inline Triple rotate(const Rotation& q, const Triple& v) {
  const Triple u = {q[0], q[1], q[2]};
  const double scale = 2 / (dot(u, u) + q[3] * q[3]);
  return v + (cross(u, v) * q[3] + cross(u, cross(u, v))) * scale;
}

}  // namespace detent_queries
