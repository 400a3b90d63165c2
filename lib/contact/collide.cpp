#include "contact/collide.h"

#include "contact/collide_convex.h"
#include "contact/collide_half_space.h"
#include "contact/collide_shapes.h"
#include "contact/contact_arm.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

ShapeType type_of(const CollisionBody& body) { return static_cast<ShapeType>(body.traits.shape); }

/// The order in which the pair functions take their shapes: half-space, box, round shape.
int rank_of(ShapeType type) { return type == ShapeType::half_space ? 0 : type == ShapeType::box ? 1 : 2; }

/// Whether there are specialised functions for this shape and every other simple shape.
bool is_simple(const BodyTraits& traits) {
  const ShapeType type = static_cast<ShapeType>(traits.shape);
  return type == ShapeType::sphere || type == ShapeType::capsule || type == ShapeType::half_space ||
         (type == ShapeType::box && traits.rounding == Unit(0.0));
}

PairShape shape_in(const CollisionBody& body, int exponent) {
  return {type_of(body),
          {0.0, 0.0, 0.0},
          body.rotation,
          scale_by_power(body.traits.size, body.traits.size_exponent - exponent)};
}

/// False if the centres are so far apart that the pair cannot touch.
bool make_frame(const CollisionBody& first, const CollisionBody& second, Real reach, PairFrame& frame) {
  const Position& from = first.pose.position;
  const Position& to = second.pose.position;
  const Real radii = real_from_unit(first.traits.bounding_radius, first.traits.size_exponent) +
                     real_from_unit(second.traits.bounding_radius, second.traits.size_exponent);
  const Real dx = real_difference(to.x, from.x), dy = real_difference(to.y, from.y), dz = real_difference(to.z, from.z);
  if (max(abs(dx), max(abs(dy), abs(dz))) > radii + reach) return false;
  frame.exponent = exponent_above(abs(dx) + abs(dy) + abs(dz) + radii + reach);
  frame.reach = unit_from_real(reach, frame.exponent);
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

void collide_ordered(const CollisionBody& first, const CollisionBody& second, const ContactReach& reach,
                     ManifoldReduction reduction, const FeatureTable& features, ContactGeometry& contact) {
  PairFrame frame;
  frame.reduction = reduction;
  if (!make_frame(first, second, reach.distance, frame)) return;
  frame.sunk = unit_from_real(min(reach.sunk, real_from_unit(Unit(1.0), frame.exponent)), frame.exponent);
  frame.smooth_seams = reach.smooth_seams;
  PairManifold manifold;
  ops_of(features, frame).collide(frame, manifold);

  contact.normal = manifold.normal;
  contact.seam = manifold.seam;
  contact.turns = manifold.turns;
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const PairPoint& point = manifold.point[i];
    contact.point[contact.count++] = {
        arm_of_point(point.point, frame.exponent - first.traits.size_exponent),
        arm_of_point(point.point - frame.b.centre, frame.exponent - second.traits.size_exponent),
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

void collide(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach, ContactGeometry& contact,
             const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features) {
  contact.count = 0;
  contact.seam = contact.turns = false;
  contact.capped = false;
  if (!is_simple(a.traits) || !is_simple(b.traits)) {
    features.convex->collide(a, b, reach, assets, reduction, contact);
    return;
  }
  const bool swapped = rank_of(type_of(b)) < rank_of(type_of(a));
  const CollisionBody& first = swapped ? b : a;
  const CollisionBody& second = swapped ? a : b;
  if (type_of(first) == ShapeType::half_space)
    features.half_space->collide(first, second, reach.distance, contact);
  else
    collide_ordered(first, second, reach, reduction, features, contact);
  if (swapped && contact.count != 0) swap_bodies(contact);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
