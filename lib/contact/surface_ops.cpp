#include "contact/surface_ops.h"

#include "contact/body_convex.h"
#include "shape/shape_traits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

void collide_surface(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach,
                     const AssetTable& assets, SurfaceContacts& contacts) {
  const CollisionBody& body = is_surface(b.traits) ? a : b;
  contacts.count = contacts.dropped = 0;
  contacts.capped = false;
  if (is_ground(body.traits)) return;
  Convex part;
  contacts.capped = !body_convex(body.traits, assets, part);
  if (!contacts.capped) collide_part_with_surface(a, b, part, {0, 0, 0}, reach, assets, contacts);
}

void collide_part_with_surface(const CollisionBody& a, const CollisionBody& b, const Convex& part, const Vec64& middle,
                               const ContactReach& reach, const AssetTable& assets, SurfaceContacts& contacts) {
  const bool swapped = is_surface(b.traits);
  const CollisionBody &ground = swapped ? b : a, &body = swapped ? a : b;
  contacts.count = contacts.dropped = 0;
  contacts.capped = !is_in(assets, ground.traits.asset);
  if (contacts.capped) return;
  collide_mesh(surface_of(ground.traits, assets), ground, body, part, middle, reach, contacts);
  for (uint32_t i = 0; swapped && i < contacts.count; ++i) swap_bodies(contacts.contact[i].geometry);
}

const SurfaceOps k_surface_ops = {read_surface,  collide_surface,  collide_part_with_surface,
                                  visit_surface, surface_convex,   place_on_surface,
                                  surface_view,  surface_triangle, cast_ray_on_surface};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
