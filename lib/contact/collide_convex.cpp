#include "contact/collide_convex.h"

#include <detent/contact.h>

#include "contact/body_convex.h"
#include "contact/collide_half_space.h"
#include "contact/contact_arm.h"
#include "math/arithmetic.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void add_points(const CollisionBody& a, const CollisionBody& b, const ContactManifold& manifold,
                ContactGeometry& contact) {
  contact.normal = manifold.normal;
  contact.capped = manifold.capped;
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.point[i];
    contact.point[contact.count++] = {arm_of_offset(point.from_a, a.properties.size_exponent),
                                      arm_of_offset(point.from_b, b.properties.size_exponent), point.separation,
                                      point.feature};
  }
}

/// Finds the contact of a half-space and a convex shape. The plane's origin may be too far away for contact_points().
/// The origin is therefore moved to the point of the plane that is nearest to the body. This point is rounded to
/// coordinates, which changes the body's height above the plane. The change, `height_error`, is added back to the
/// separations.
Status meet_half_space(const CollisionBody& plane, const CollisionBody& body, const Convex& convex, bool plane_is_a,
                       Real margin, ManifoldReduction reduction, ContactManifold& manifold) {
  const Vec3<Unit>& up = plane.rotation.column[1];
  const Real height = distance_along(plane.pose.position, body.pose.position, up);
  const Real radius = bounding_radius_of(body.properties);
  if (height > radius + margin) return Status::ok;
  // The depth is clamped to two bounding radii: at this depth, the body is already completely below the plane.
  const Real down = clamp(height, scale_by_power(-radius, 1), radius + margin);
  const Position centre = {0.0, 0.0, 0.0};
  Position foot = centre;
  bool saturated = false;  // never set: the displacement is of the size of a body
  foot.x = coord_advance(foot.x, -(down * up.x), saturated);
  foot.y = coord_advance(foot.y, -(down * up.y), saturated);
  foot.z = coord_advance(foot.z, -(down * up.z), saturated);
  const Real height_error = height - distance_along(foot, centre, up);
  Convex ground;
  ground.type = ShapeType::half_space;
  const Pose pose_ground = {foot, plane.pose.rotation}, pose_body = {centre, body.pose.rotation};
  const Real asked = max(margin - height_error, Real(0.0));
  const Status status =
      plane_is_a ? contact_points(ground, pose_ground, convex, pose_body, asked, manifold, nullptr, reduction)
                 : contact_points(convex, pose_body, ground, pose_ground, asked, manifold, nullptr, reduction);
  for (uint32_t i = 0; i < manifold.count; ++i) {
    ManifoldPoint& point = manifold.point[i];
    point.separation += height_error;
    (plane_is_a ? point.from_a : point.from_b) = {0.0, 0.0, 0.0};  // the arm of a plane has no effect
  }
  return status;
}

}  // namespace

bool make_rules(const ContactMargins& margin, ManifoldReduction reduction, ContactRules& rules) {
  Vec64 raw;
  if (!raw_from_real({margin.distance, margin.sunk, Real(0.0)}, raw) || raw.x < 0) return false;
  rules = {raw.x, raw.y, reduction, true, margin.smooth_seams};
  return true;
}

void collide_convexes(const CollisionBody& a, const Convex& convex_a, const CollisionBody& b, const Convex& convex_b,
                      const ContactMargins& margin, ManifoldReduction reduction, ContactGeometry& contact) {
  ContactManifold manifold;
  ContactKind kind;
  const auto meet = [&] {
    if (is_half_space(a.properties)) return meet_half_space(a, b, convex_b, true, margin.distance, reduction, manifold);
    if (is_half_space(b.properties))
      return meet_half_space(b, a, convex_a, false, margin.distance, reduction, manifold);
    ContactRules rules;
    if (!make_rules(margin, reduction, rules)) return Status::out_of_range;
    return contact_points_by(rules, convex_a, {a.pose.position, a.pose.rotation}, convex_b,
                             {b.pose.position, b.pose.rotation}, nullptr, manifold, kind);
  };
  const Status status = meet();
  contact.seam = kind.seam;
  contact.turns = kind.turns;
  add_points(a, b, manifold, contact);
  contact.capped = contact.capped || status != Status::ok;
}

void collide_convex(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                    const AssetTable& assets, ManifoldReduction reduction, ContactGeometry& contact) {
  Convex convex_a, convex_b;
  contact.capped = !body_convex(a.properties, assets, convex_a) || !body_convex(b.properties, assets, convex_b);
  if (!contact.capped) collide_convexes(a, convex_a, b, convex_b, margin, reduction, contact);
}

const ConvexOps k_convex_ops = {collide_convex};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
