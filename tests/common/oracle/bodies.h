#pragma once
#include <detent/detail/state.h>
#include <detent/numbers.h>

#include "math/arithmetic.h"
#include "shape/shape_properties.h"
#include "tests/common/oracle/convex.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/support/test.h"
#include "tests/unit/math/samples.h"

/// The library's bodies, read into the references without rounding.
namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_oracle::Quaternion;
using detent_oracle::Solid;
using detent_oracle::Vector;

inline double host(Unit value) { return unit_to_host(value); }
inline Vector host(const Vec3<Unit>& v) { return {{unit_to_host(v.x), unit_to_host(v.y), unit_to_host(v.z)}}; }
#if DETENT_FIXED
inline Vector host(const Vec3<Real>& v) { return {{real_to_host(v.x), real_to_host(v.y), real_to_host(v.z)}}; }
#endif
inline Quaternion host(const Quat& q) {
  return {unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)};
}
inline double unit_of(const BodyProperties& properties) { return ldexp(1.0, properties.size_exponent); }

/// b - a, m: the exact difference, to the nearest double.
inline Vector difference(const Position& b, const Position& a) {
#if defined(DETENT_F64)
  return {{b.x - a.x, b.y - a.y, b.z - a.z}};
#else
  const auto one = [](Coord p, Coord q) { return ldexp(static_cast<double>(p.raw - q.raw), -Coord::k_frac); };
  return {{one(b.x, a.x), one(b.y, a.y), one(b.z, a.z)}};
#endif
}

struct OracleBody {
  BodyPose pose{};
  BodyProperties properties{};
};

/// The body as a solid, in world axes around `origin`.
inline Solid solid_of(const OracleBody& body, const Position& origin) {
  Solid solid;
  const ShapeType type = static_cast<ShapeType>(body.properties.shape);
  solid.kind = type == ShapeType::half_space ? detent_oracle::Kind::half_space
               : type == ShapeType::box      ? detent_oracle::Kind::box
                                             : detent_oracle::Kind::round;
  solid.centre = difference(body.pose.position, origin);
  for (int i = 0; i < 3; ++i) solid.axis[i] = detent_oracle::axis_of(host(body.pose.rotation), i);
  solid.size = host(body.properties.size) * unit_of(body.properties);
  return solid;
}

inline double uniform(Samples& samples, double low, double high) {
  return low + (high - low) * ldexp(static_cast<double>(samples.bits() >> 11), -53);
}
inline Vector any_direction(Samples& samples) {
  for (;;) {
    const Vector v = {{uniform(samples, -1, 1), uniform(samples, -1, 1), uniform(samples, -1, 1)}};
    const double size = length(v);
    if (size > 0.1 && size < 1) return v * (1 / size);
  }
}
inline Quaternion any_rotation(Samples& samples) {
  // Drawn one by one: as arguments every compiler would take them in an order of its own.
  const double angle = uniform(samples, 0, 3.14159265358979);
  return detent_oracle::rotation_by(any_direction(samples) * angle);
}

inline Real real_near(double value) {
  Real result{};
  EXPECT_OK(real_from_host(value, result));
  return result;
}
inline Vec3<Real> reals_near(const Vector& v) { return {real_near(v[0]), real_near(v[1]), real_near(v[2])}; }
inline Quat rotation_near(const Quaternion& q) {
  Quat result{};
  EXPECT_OK(unit_from_host(q.x, result.x));
  EXPECT_OK(unit_from_host(q.y, result.y));
  EXPECT_OK(unit_from_host(q.z, result.z));
  EXPECT_OK(unit_from_host(q.w, result.w));
  return result;
}
inline Position position_near(const Vector& v) {
  Position result{};
  EXPECT_OK(coord_from_host(v[0], result.x));
  EXPECT_OK(coord_from_host(v[1], result.y));
  EXPECT_OK(coord_from_host(v[2], result.z));
  return result;
}
inline BodyProperties properties_of(const Shape& shape) {
  BodyProperties properties{};
  properties.type = static_cast<uint32_t>(BodyType::dynamic);
  EXPECT_OK(set_shape_properties(shape, properties));
  return properties;
}
inline BodyProperties sphere_properties(double radius) { return properties_of(sphere(real_near(radius))); }
inline BodyProperties capsule_properties(double radius, double half_length) {
  return properties_of(capsule(real_near(radius), real_near(half_length)));
}
inline BodyProperties box_properties(const Vector& half) { return properties_of(box(reals_near(half))); }

/// `count` steps of a Unit near 1.
inline double unit_steps(double count) { return ldexp(count, k_unit_step); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
