#pragma once
#include <detent/numbers.h>
#include <detent/toi.h>

#include "tests/common/oracle/vectors.h"
#include "tests/common/support/test.h"
#include "tests/unit/math/samples.h"

/// Poses and motions for the tests of lib/distance and lib/toi: doubles with the values that a configuration stores.
namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_oracle::Quaternion;
using detent_oracle::Vector;

/// The smallest step of a world coordinate, m; in f64, near the origin.
inline constexpr double k_position_step = k_config == Config::fx32  ? 0x1p-16
                                          : k_config == Config::f64 ? 0x1p-48
                                                                    : 0x1p-32;
/// The relative error of a rotation and of a length after conversion to the library and back.
inline constexpr double k_number_error = k_config == Config::f32 ? 0x1p-22 : 0x1p-29;

inline Real real(double value) {
  Real result = 0.0;
  EXPECT_OK(real_from_host(value, result));
  return result;
}
inline double host(Real value) { return real_to_host(value); }
inline Vec3<Real> reals(const Vector& v) { return {real(v[0]), real(v[1]), real(v[2])}; }
inline Vector host(const Vec3<Real>& v) { return {{host(v.x), host(v.y), host(v.z)}}; }
inline Vector host_units(const Vec3<Unit>& v) { return {{unit_to_host(v.x), unit_to_host(v.y), unit_to_host(v.z)}}; }

/// A pose, and its motion over a step of length 1.
struct BodyAt {
  Vector position = {{0, 0, 0}};
  Quaternion rotation = {0, 0, 0, 1};
  Vector displacement = {{0, 0, 0}};
  Vector rotation_vector = {{0, 0, 0}};

  BodyAt at(double time) const {
    return {position + displacement * time, rotation_by(rotation_vector * time) * rotation, displacement,
            rotation_vector};
  }
  Vector to_world(const Vector& local) const {
    return position + axis_of(rotation, 0) * local[0] + axis_of(rotation, 1) * local[1] +
           axis_of(rotation, 2) * local[2];
  }
  Vector to_local(const Vector& world) const {
    const Vector v = world - position;
    return {{dot(v, axis_of(rotation, 0)), dot(v, axis_of(rotation, 1)), dot(v, axis_of(rotation, 2))}};
  }
};

inline Pose pose_of(const BodyAt& body) {
  Pose pose;
  const Quaternion q = normalised(body.rotation);
  EXPECT_OK(coord_from_host(body.position[0], pose.position.x));
  EXPECT_OK(coord_from_host(body.position[1], pose.position.y));
  EXPECT_OK(coord_from_host(body.position[2], pose.position.z));
  EXPECT_OK(unit_from_host(q.x, pose.rotation.x));
  EXPECT_OK(unit_from_host(q.y, pose.rotation.y));
  EXPECT_OK(unit_from_host(q.z, pose.rotation.z));
  EXPECT_OK(unit_from_host(q.w, pose.rotation.w));
  return pose;
}
inline Motion motion_of(const BodyAt& body) {
  return {pose_of(body), reals(body.displacement), reals(body.rotation_vector)};
}

/// The same body with each number as the configuration holds it.
inline BodyAt held(const BodyAt& body) {
  const Motion motion = motion_of(body);
  const Position& p = motion.start.position;
  const Quat& q = motion.start.rotation;
  return {{{coord_to_host(p.x), coord_to_host(p.y), coord_to_host(p.z)}},
          normalised(Quaternion{unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)}),
          host(motion.displacement),
          host(motion.rotation_vector)};
}

inline double uniform(Samples& samples, double low, double high) {
  return low + (high - low) * static_cast<double>(samples.bits() >> 11) * 0x1p-53;
}
/// Uniform on the sphere (Marsaglia 1972).
inline Vector random_direction(Samples& samples) {
  for (;;) {
    const double a = uniform(samples, -1, 1), b = uniform(samples, -1, 1), s = a * a + b * b;
    if (s >= 1) continue;
    return {{2 * a * sqrt(1 - s), 2 * b * sqrt(1 - s), 1 - 2 * s}};
  }
}
inline Quaternion random_quaternion(Samples& samples) {
  for (;;) {
    const Quaternion q = {uniform(samples, -1, 1), uniform(samples, -1, 1), uniform(samples, -1, 1),
                          uniform(samples, -1, 1)};
    const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (square < 1 && square > 0.01) return normalised(q);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
