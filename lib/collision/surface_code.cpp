#include "collision/surface_code.h"

#include "geometry/shape_traits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

void collide_surface(const CollisionBody& a, const CollisionBody& b, Real reach, const AssetTable& assets,
                     SurfaceContacts& contacts) {
  const bool swapped = is_surface(b.traits);
  const CollisionBody &ground = swapped ? b : a, &body = swapped ? a : b;
  contacts.count = contacts.dropped = 0;
  contacts.capped = !is_in(assets, ground.traits.asset);
  if (contacts.capped || is_ground(body.traits)) return;
  collide_mesh(surface_of(ground.traits, assets), ground, body, reach, assets, contacts);
  for (uint32_t i = 0; swapped && i < contacts.count; ++i) swap_bodies(contacts.contact[i].geometry);
}

const SurfaceCode k_surface_code = {read_surface, collide_surface, visit_surface, surface_convex};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
