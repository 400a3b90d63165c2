#include "contact/collide_mesh.h"

#include "contact/collide_convex.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Returns a feature name that does not depend on which triangle is touched. For a contact on the triangle's face, the
/// name consists of the shape's feature alone. For a contact at a corner or edge of the triangle, the name also
/// contains a hash of the positions of the corners. `corner`: TerrainTouch::corner_name.
uint32_t feature_of(uint32_t feature, const uint32_t (&corner)[3]) {
  const uint32_t kind = feature >> 10 & 3, index = feature & 0x3ff, kept = feature & 0xfffc00u;
  if (kind == static_cast<uint32_t>(FeatureType::face)) return kept;
  // edge_index() numbers the edges of a triangle by their ends: edge 0 has the corners 0 and 1, edge 1 has 0 and 2,
  // edge 2 has 1 and 2.
  const uint32_t name = kind == static_cast<uint32_t>(FeatureType::vertex) ? corner[index % 3]
                        : index == 0                                       ? corner[0] + corner[1]
                        : index == 1                                       ? corner[0] + corner[2]
                                                                           : corner[1] + corner[2];
  return kept | (name & 0x3ff) | (name >> 10 & 0xff) << 24;
}

/// Returns k: normals of triangles count as the same normal if they are at most 2^-k rad apart. The angle 2^-k is about
/// 1/32 of the ratio of the shape's half thickness to its core radius. So at the ends of a long shape, the triangles of
/// one manifold differ from a common plane by about a 32nd of the half thickness.
int same_power_of(const Convex& shape, int64_t half_thickness) {
  constexpr int k_least = 5, k_most = 12;
  const int power = k_least + shape.exponent - raw_exponent_above(half_thickness);
  return power < k_least ? k_least : power > k_most ? k_most : power;
}

}  // namespace

void collide_mesh(const Terrain& terrain, const CollisionBody& ground, const CollisionBody& body, const Convex& shape,
                  const Vec64& middle, const ContactMargins& margin, TerrainContacts& contacts) {
  contacts.count = 0;
  contacts.dropped = 0;
  contacts.seam = false;
  contacts.capped = true;
  TerrainPlace place;
  ContactRules rules;
  if (!make_rules(margin, ManifoldReduction::projected_extremes, rules) ||
      place_on_terrain({ground.pose.position, ground.pose.rotation}, {body.pose.position, body.pose.rotation}, place) !=
          Status::ok) {
    return;
  }
  place.middle = rotate(place.rotation, middle);
  const TerrainPair pair(terrain, place, shape, rules);
  TerrainManifolds found(pair.half_thickness(), same_power_of(shape, pair.half_thickness()));
  terrain.walk([&](const GridBox& box) { return meet(box, pair.box()); },
               [&](uint32_t triangle) {
                 TerrainTouch touch;
                 const bool touches = pair.touch(triangle, touch);
                 contacts.seam = contacts.seam || touch.seam;
                 if (!touches) return;
                 for (uint32_t i = 0; i < touch.manifold.count; ++i) {
                   uint32_t& feature = touch.manifold.point[i].feature;
                   feature = feature_of(feature, touch.corner_name);
                 }
                 found.add(touch);
               });
  contacts.count = found.finish();
  contacts.dropped = found.dropped();
  contacts.capped = found.capped();
  for (uint32_t i = 0; i < contacts.count; ++i)
    put_contact(found.manifold(i), place.terrain, ground, body, contacts.contact[i]);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
