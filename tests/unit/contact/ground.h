#pragma once
#include <detent/distance.h>

#include "contact/body_convex.h"
#include "contact/collide_mesh.h"
#include "contact/terrain_query.h"
#include "tests/unit/contact/pairs.h"
#include "tests/unit/shape/hull_bytes.h"
#include "tests/unit/shape/terrains.h"

/// A terrain for collision tests, and the contacts of bodies with it.
namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_terrains::Bytes;
using detent_terrains::Source;

inline const Asset k_assets[] = {{detent_hulls::k_prism, sizeof detent_hulls::k_prism}};
inline const AssetTable k_table = {k_assets, 1};
inline constexpr double k_reach = 0.05;

/// A terrain, its bytes and its pose.
struct Ground {
  Bytes bytes;
  Terrain terrain;
  Pose pose = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};

  explicit Ground(const Bytes& from) : bytes(from) { EXPECT_OK(read_terrain({bytes.data(), bytes.count()}, terrain)); }
  explicit Ground(const Source& source, bool one_sided = false) : Ground(detent_terrains::cooked(source, one_sided)) {}
};

inline OracleBody body_of(const Shape& shape) {
  OracleBody body;
  EXPECT_OK(set_shape_properties(shape, body.properties, k_table));
  body.properties.type = static_cast<uint32_t>(BodyType::dynamic);
  return body;
}

inline TerrainContacts contacts_of(const Ground& ground, const OracleBody& body, double distance_max = k_reach) {
  const Matrix3 rotation = matrix_from(body.pose.rotation);
  TerrainContacts contacts;
  BodyProperties properties{};
  properties.size_exponent = 15;
  BodyPose pose{};
  pose.position = ground.pose.position;
  pose.rotation = ground.pose.rotation;
  const CollisionBody terrain_body = {pose, properties, matrix_from(pose.rotation)};
  Convex shape;
  EXPECT_TRUE(body_convex(body.properties, k_table, shape));
  collide_mesh(ground.terrain, terrain_body, {body.pose, body.properties, rotation}, shape, {0, 0, 0},
               real_near(distance_max), contacts);
  return contacts;
}

inline double deepest_of(const TerrainContacts& contacts) {
  double least = 1e9;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    const ContactGeometry& geometry = contacts.contact[i].geometry;
    for (uint32_t k = 0; k < geometry.count; ++k) least = fmin(least, real_to_host(geometry.point[k].separation));
  }
  return least;
}

/// The distance between the body and the triangles whose bounds come within `range`, m, of the body's centre in each
/// axis, and the normal from the nearest one. The terrain is not rotated.
inline double distance_from(const Ground& ground, const OracleBody& body, Vector& normal, double range = 1e4) {
  Convex shape;
  EXPECT_TRUE(body_convex(body.properties, k_table, shape));
  double least = 1e9;
  const Vector at = difference(body.pose.position, ground.pose.position);
  const auto raw = [](double metres) { return static_cast<int64_t>(ldexp(metres, k_metre_bits)); };
  const GridBox all = grid_box(ground.terrain, {raw(at[0] - range), raw(at[1] - range), raw(at[2] - range)},
                               {raw(at[0] + range), raw(at[1] + range), raw(at[2] + range)});
  ground.terrain.walk(
      [&](const GridBox& box) { return meet(box, all); },
      [&](uint32_t i) {
        Convex triangle;
        Pose placed;
        EXPECT_OK(terrain_convex(ground.terrain, ground.pose, i, placed, triangle));
        Closest closest;
        EXPECT_OK(closest_points(triangle, placed, shape, {body.pose.position, body.pose.rotation}, closest));
        if (real_to_host(closest.distance) >= least) return;
        least = real_to_host(closest.distance);
        normal = host(closest.normal);
      });
  return least;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
