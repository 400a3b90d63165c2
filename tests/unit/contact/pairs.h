#pragma once
#include "contact/collide.h"
#include "contact/contact_arm.h"
#include "math/root.h"
#include "tests/common/oracle/bodies.h"

/// Random pairs of bodies at a chosen separation, and the contacts that the library finds.
namespace detent {
inline namespace DETENT_NAMESPACE {

enum class Form { half_space, box, capsule, sphere };

inline const char* name_of(Form form) {
  constexpr const char* k_names[] = {"half-space", "box", "capsule", "sphere"};
  return k_names[static_cast<int>(form)];
}

/// A shape whose smallest radius or half extent is `size`, m, or up to three times that.
inline BodyProperties random_properties(Samples& samples, Form form, double size) {
  const auto some = [&] { return size * uniform(samples, 1, 3); };
  switch (form) {
    case Form::half_space:
      return properties_of(half_space());
    case Form::box:
      return box_properties({{some(), some(), some()}});
    case Form::capsule:
      return capsule_properties(some(), some());
    default:
      return sphere_properties(some());
  }
}

struct OraclePair {
  OracleBody a, b;
};

inline ContactGeometry contact_of(const OracleBody& a, const OracleBody& b, double distance_max) {
  const Matrix3 rotation_a = matrix_from(a.pose.rotation), rotation_b = matrix_from(b.pose.rotation);
  ContactGeometry contact;
  collide({a.pose, a.properties, rotation_a}, {b.pose, b.properties, rotation_b}, real_near(distance_max), contact);
  return contact;
}

/// Checks that the arms are not longer than the range of the solver.
inline void expect_arms_held(const ContactGeometryPoint& point) {
  const double most = host(k_arm_max) + unit_steps(4);
  EXPECT_LE(length(host(point.arm_a)), most);
  EXPECT_LE(length(host(point.arm_b)), most);
}

inline double extent_of(const OraclePair& pair) {
  return fmin(real_to_host(shape_extent(pair.a.properties)), real_to_host(shape_extent(pair.b.properties)));
}

/// The length of one step of a Unit in this pair, m: in the unit of the larger body. A half-space has no size.
inline double step_of(const OraclePair& pair) {
  const bool plane = static_cast<ShapeType>(pair.a.properties.shape) == ShapeType::half_space;
  const double unit = plane ? unit_of(pair.b.properties) : fmax(unit_of(pair.a.properties), unit_of(pair.b.properties));
  return unit * unit_steps(1);
}

/// Places B along `displacement` as near to A as leaves a gap of `gap`, m.
inline void place(OraclePair& pair, const Vector& start, const Vector& displacement, double gap) {
  pair.a.pose.position = position_near(start);
  double near = 0, far = 4 * (unit_of(pair.a.properties) + unit_of(pair.b.properties));
  Solid a = solid_of(pair.a, pair.a.pose.position), b = solid_of(pair.b, pair.a.pose.position);
  if (a.kind == detent_oracle::Kind::half_space) {
    b.centre = displacement * 0;
    far = (gap - gap_along(a, b, a.axis[1])) / dot(displacement, a.axis[1]);
    near = far;
  }
  for (int i = 0; i < 24 && near != far; ++i) {
    const double middle = (near + far) / 2;
    b.centre = displacement * middle;
    (separation_of(a, b).value < gap ? near : far) = middle;
  }
  pair.b.pose.position = position_near(start + displacement * far);
}

/// A random pair with the given types (A of no later type than B), separated by about `gap` times the size of the
/// smaller body.
inline OraclePair random_pair(Samples& samples, Form form_a, Form form_b, double size_a, double size_b, double gap) {
  OraclePair pair;
  pair.a.properties = random_properties(samples, form_a, size_a);
  pair.b.properties = random_properties(samples, form_b, size_b);
  pair.a.pose.rotation = rotation_near(any_rotation(samples));
  pair.b.pose.rotation = rotation_near(any_rotation(samples));
  const double place_size = sizeof(Coord) == 4 ? 8192 : 1e6;
  const Vector start = any_direction(samples) * uniform(samples, 0, place_size);
  Vector displacement = any_direction(samples);
  if (form_a == Form::half_space) {
    const Vector up = solid_of(pair.a, pair.a.pose.position).axis[1];
    displacement = normalised(
        displacement + up * (1.5 - fmin(dot(displacement, up), 0)));  // above the plane, and away from its origin
  }
  place(pair, start, displacement, gap * extent_of(pair));
  return pair;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
