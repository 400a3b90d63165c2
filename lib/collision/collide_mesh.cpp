#include "collision/collide_mesh.h"

#include "collision/contact_arm.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void put_contact(const SurfaceManifold& manifold, const Matrix32& rotation, const CollisionBody& ground,
                 const CollisionBody& body, SurfaceContact& contact) {
  const Position &from = ground.pose.position, &to = body.pose.position;
  const Vec3<Real> offset = {real_difference(to.x, from.x), real_difference(to.y, from.y),
                             real_difference(to.z, from.z)};
  contact.key = manifold.key;
  contact.triangle = manifold.triangle;
  contact.material = manifold.material;
  contact.geometry = {};
  contact.geometry.normal = units_from_raw(round_shift(multiply(rotation, manifold.normal), 30));
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const SurfaceManifold::Point& point = manifold.point[i];
    const Vec64 way = rotate(rotation, point.from_shape);
    const Vec3<Real> from_body = {real_from_raw(way.x), real_from_raw(way.y), real_from_raw(way.z)};
    contact.geometry.point[contact.geometry.count++] = {arm_of_way(offset + from_body, ground.traits.size_exponent),
                                                        arm_of_way(from_body, body.traits.size_exponent),
                                                        real_from_raw(point.separation), point.feature};
  }
}

}  // namespace

void collide_mesh(const Surface& surface, const CollisionBody& ground, const CollisionBody& body, const Convex& shape,
                  const Vec64& middle, Real reach, SurfaceContacts& contacts) {
  contacts.count = 0;
  contacts.dropped = 0;
  contacts.capped = true;
  SurfacePlace place;
  Vec64 raw;
  if (!raw_from_real({reach, Real(0.0), Real(0.0)}, raw) ||
      place_on_surface({ground.pose.position, ground.pose.rotation}, {body.pose.position, body.pose.rotation}, place) !=
          Status::ok) {
    return;
  }
  place.middle = rotate(place.rotation, middle);
  const SurfacePair pair(surface, place, shape, raw.x);
  SurfaceManifolds found(pair.half_thickness());
  surface.walk([&](const GridBox& box) { return meet(box, pair.box()); },
               [&](uint32_t triangle) {
                 SurfaceTouch touch;
                 if (pair.touch(triangle, touch)) found.add(touch);
               });
  SurfaceManifold manifold[k_surface_manifolds_max];
  contacts.count = found.finish(manifold);
  contacts.dropped = found.dropped();
  contacts.capped = found.capped();
  for (uint32_t i = 0; i < contacts.count; ++i)
    put_contact(manifold[i], place.surface, ground, body, contacts.contact[i]);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
