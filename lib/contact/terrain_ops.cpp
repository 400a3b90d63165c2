#include "contact/terrain_ops.h"

#include "contact/body_convex.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

void collide_terrain(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                     const AssetTable& assets, TerrainContacts& contacts) {
  const CollisionBody& body = is_terrain(b.properties) ? a : b;
  contacts.count = contacts.dropped = 0;
  contacts.capped = false;
  if (is_ground(body.properties)) return;
  Convex part;
  contacts.capped = !body_convex(body.properties, assets, part);
  if (!contacts.capped) collide_part_with_terrain(a, b, part, {0, 0, 0}, margin, assets, contacts);
}

void collide_part_with_terrain(const CollisionBody& a, const CollisionBody& b, const Convex& part, const Vec64& middle,
                               const ContactMargins& margin, const AssetTable& assets, TerrainContacts& contacts) {
  const bool swapped = is_terrain(b.properties);
  const CollisionBody &ground = swapped ? b : a, &body = swapped ? a : b;
  contacts.count = contacts.dropped = 0;
  contacts.capped = !is_in(assets, ground.properties.asset);
  if (contacts.capped) return;
  collide_mesh(terrain_of(ground.properties, assets), ground, body, part, middle, margin, contacts);
  for (uint32_t i = 0; swapped && i < contacts.count; ++i) swap_bodies(contacts.contact[i].geometry);
}

const TerrainOps k_terrain_ops = {read_terrain,  collide_terrain,  collide_part_with_terrain,
                                  visit_terrain, terrain_convex,   place_on_terrain,
                                  terrain_view,  terrain_triangle, cast_ray_on_terrain};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
