#include "contact/collide.h"

#include "contact/collide_convex.h"
#include "contact/collide_half_space.h"
#include "contact/collide_shapes.h"
#include "contact/contact_arm.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

ShapeType type_of(const CollisionBody& body) { return static_cast<ShapeType>(body.properties.shape); }

/// Returns the rank of a shape: 0 for a half-space, 1 for a box, 2 for a sphere or capsule. The specialised pair
/// functions take the shape of lower rank as A.
int rank_of(ShapeType type) { return type == ShapeType::half_space ? 0 : type == ShapeType::box ? 1 : 2; }

/// Whether the specialised pair functions accept the shape: sphere, capsule, half-space or unrounded box.
bool is_simple(const BodyProperties& properties) {
  const ShapeType type = static_cast<ShapeType>(properties.shape);
  return type == ShapeType::sphere || type == ShapeType::capsule || type == ShapeType::half_space ||
         (type == ShapeType::box && properties.rounding == Unit(0.0));
}

PairShape shape_in(const CollisionBody& body, int exponent) {
  return {type_of(body),
          {0.0, 0.0, 0.0},
          body.rotation,
          scale_by_power(body.properties.size, body.properties.size_exponent - exponent)};
}

/// Whether the bounding spheres of two bodies are farther apart than `margin`, m. The test only saves time: it returns
/// false if the answer is not certain, for half-spaces, and in all builds optimised for size.
bool are_spheres_apart([[maybe_unused]] const CollisionBody& a, [[maybe_unused]] const CollisionBody& b,
                       [[maybe_unused]] Real margin) {
#if defined(__OPTIMIZE_SIZE__)
  return false;
#else
  if (type_of(a) == ShapeType::half_space || type_of(b) == ShapeType::half_space) return false;
  constexpr Real k_reach_max = 128.0;  // m; with this limit the sum of squares fits a Real
  const Real touching = bounding_radius_of(a.properties) + bounding_radius_of(b.properties) + margin;
  const Real reach = touching + scale_by_power(touching, -10);  // more than all rounding errors
  const Vec3<Real> offset = real_difference(b.pose.position, a.pose.position);
  const Real far = greatest(offset);
  if (far > reach || reach > k_reach_max) return far > reach;
  return dot(offset, offset) > reach * reach;
#endif
}

/// Sets the frame of a pair: its unit of length, the contact margin and the two shapes. Returns false if the centres
/// are so far apart that the shapes cannot be within the margin (m).
bool make_frame(const CollisionBody& first, const CollisionBody& second, Real margin, PairFrame& frame) {
  const Position& from = first.pose.position;
  const Position& to = second.pose.position;
  const Real radii = real_from_unit(first.properties.bounding_radius, first.properties.size_exponent) +
                     real_from_unit(second.properties.bounding_radius, second.properties.size_exponent);
  const Real dx = real_difference(to.x, from.x), dy = real_difference(to.y, from.y), dz = real_difference(to.z, from.z);
  if (max(abs(dx), max(abs(dy), abs(dz))) > radii + margin) return false;
  frame.exponent = exponent_above(abs(dx) + abs(dy) + abs(dz) + radii + margin);
  frame.margin = unit_from_real(margin, frame.exponent);
  frame.a = shape_in(first, frame.exponent);
  frame.b = shape_in(second, frame.exponent);
  frame.b.centre = {unit_difference(to.x, from.x, frame.exponent), unit_difference(to.y, from.y, frame.exponent),
                    unit_difference(to.z, from.z, frame.exponent)};
  return true;
}

const PairOps& ops_of(const FeatureTable& features, const PairFrame& frame) {
  if (frame.b.type == ShapeType::box) return *features.box_pair;
  return frame.a.type == ShapeType::box ? *features.box_round_pair : *features.round_pair;
}

void collide_ordered(const CollisionBody& first, const CollisionBody& second, const ContactMargins& margin,
                     ManifoldReduction reduction, const FeatureTable& features, ContactGeometry& contact) {
  PairFrame frame;
  frame.reduction = reduction;
  if (!make_frame(first, second, margin.distance, frame)) return;
  frame.sunk = unit_from_real(min(margin.sunk, real_from_unit(Unit(1.0), frame.exponent)), frame.exponent);
  frame.smooth_seams = margin.smooth_seams;
  PairManifold manifold;
  ops_of(features, frame).collide(frame, manifold);

  contact.normal = manifold.normal;
  contact.seam = manifold.seam;
  contact.turns = manifold.turns;
  contact.near = manifold.near;
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const PairPoint& point = manifold.point[i];
    contact.point[contact.count++] = {
        arm_of_point(point.point, frame.exponent - first.properties.size_exponent),
        arm_of_point(point.point - frame.b.centre, frame.exponent - second.properties.size_exponent),
        real_from_unit(point.separation, frame.exponent), point.feature};
  }
}

}  // namespace

void swap_bodies(ContactGeometry& contact) {
  contact.normal = -contact.normal;
  for (uint32_t i = 0; i < contact.count; ++i) {
    const Vec3<Unit> arm = contact.point[i].arm_a;
    contact.point[i].arm_a = contact.point[i].arm_b;
    contact.point[i].arm_b = arm;
  }
}

void collide(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin, ContactGeometry& contact,
             const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features) {
  contact.count = 0;
  contact.seam = contact.turns = contact.near = false;
  contact.capped = false;
  if (are_spheres_apart(a, b, margin.distance)) return;
  if (!is_simple(a.properties) || !is_simple(b.properties)) {
    features.convex->collide(a, b, margin, assets, reduction, contact);
    return;
  }
  const bool swapped = rank_of(type_of(b)) < rank_of(type_of(a));
  const CollisionBody& first = swapped ? b : a;
  const CollisionBody& second = swapped ? a : b;
  if (type_of(first) == ShapeType::half_space)
    features.half_space->collide(first, second, margin.distance, contact);
  else
    collide_ordered(first, second, margin, reduction, features, contact);
  if (swapped && contact.count != 0) swap_bodies(contact);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
