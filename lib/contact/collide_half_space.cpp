#include "contact/collide_half_space.h"

#include "base/cycle.h"
#include "contact/contact_arm.h"
#include "math/arithmetic.h"
#include "math/wide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED
Real distance_along(const Position& from, const Position& to, const Vec3<Unit>& direction) {
  // Multiplies each coordinate separately, because the difference of two 64-bit coordinates may not fit 64 bits.
  const auto term = [](Coord a, Coord b, Unit d) {
    return Int128::product_narrow(b.raw, d.raw) - Int128::product_narrow(a.raw, d.raw);
  };
  const Int128 sum =
      term(from.x, to.x, direction.x) + term(from.y, to.y, direction.y) + term(from.z, to.z, direction.z);
  constexpr int k_shift = Coord::k_frac + Unit::k_frac - Real::k_frac;
  constexpr int k_lift = k_shift < 1 ? 1 - k_shift : 0;  // fx32: k_shift is 0, but round_shift() needs at least 1
  const Int128 lifted = sum.shift_left(k_lift);
  const Int128 limit = Int128::from(INT64_MAX).shift_left(k_shift + k_lift);
  if (limit < lifted) return k_real_max;
  if (lifted < -limit) return -k_real_max;
  return Real::from_raw(lifted.round_shift(k_shift + k_lift));
}
#else
Real distance_along(const Position& from, const Position& to, const Vec3<Unit>& direction) {
  return real_difference(to.x, from.x) * direction.x + real_difference(to.y, from.y) * direction.y +
         real_difference(to.z, from.z) * direction.z;
}
#endif

namespace {

/// Adds those points of a body to `contact` that lie at most `margin` above the plane. Points are relative to the
/// body's centre, in world axes, in the body's unit of length.
struct Collector {
  Vec3<Unit> normal;
  Real height;  ///< height of the body's centre above the plane, m
  Real margin;
  int exponent;
  ContactGeometry& contact;

  void add(const Vec3<Unit>& offset, uint32_t feature) {
    const Real separation = height + real_from_unit(dot(normal, offset), exponent);
    if (separation > margin) return;
    // The depth is clamped only to compute the arm. The separation is not clamped: a body far below the plane is still
    // in contact.
    const Real unit = real_from_unit(Unit(1.0), exponent);
    const Unit half = unit_from_real(scale_by_power(max(separation, -unit), -1), exponent);
    contact.point[contact.count++] = {{0.0, 0.0, 0.0}, arm_of_point(offset - normal * half, 0), separation, feature};
  }
};

/// Adds the four corners of the face whose outward normal points most directly at the plane.
void collide_box(const BodyProperties& properties, const Matrix3& rotation, Collector& collector) {
  const Unit half[3] = {properties.size.x, properties.size.y, properties.size.z};
  int face = 0;
  Unit facing = -1.0;
  for (int i = 0; i < 3; ++i) {
    const Unit along = abs(dot(collector.normal, rotation.column[i]));
    if (along > facing) {
      facing = along;
      face = i;
    }
  }
  const bool upper = dot(collector.normal, rotation.column[face]) < Unit(0.0);
  const Vec3<Unit> outward = rotation.column[face] * half[face];
  const Vec3<Unit> middle = upper ? outward : -outward;
  const Vec3<Unit> u = rotation.column[next_of_three(face)] * half[next_of_three(face)];
  const Vec3<Unit> v = rotation.column[previous_of_three(face)] * half[previous_of_three(face)];
  const uint32_t base = 1 + 4 * (2 * static_cast<uint32_t>(face) + (upper ? 1u : 0u));
  collector.add(middle + u + v, base);
  collector.add(middle - u + v, base + 1);
  collector.add(middle - u - v, base + 2);
  collector.add(middle + u - v, base + 3);
}

}  // namespace

void collide_half_space(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact) {
  contact.normal = plane.rotation.column[1];
  const BodyProperties& properties = body.properties;
  Collector collector = {contact.normal, distance_along(plane.pose.position, body.pose.position, contact.normal),
                         margin, properties.size_exponent, contact};
  switch (static_cast<ShapeType>(properties.shape)) {
    case ShapeType::sphere:
      collector.add(-(contact.normal * properties.size.x), 1);
      break;
    case ShapeType::capsule: {
      const Vec3<Unit> axis = body.rotation.column[1] * properties.size.y;
      const Vec3<Unit> down = contact.normal * properties.size.x;
      collector.add(axis - down, 1);
      collector.add(-axis - down, 2);
      break;
    }
    case ShapeType::box:
      collide_box(properties, body.rotation, collector);
      break;
    default:
      break;
  }
}

const HalfSpaceOps k_half_space_ops = {collide_half_space};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
