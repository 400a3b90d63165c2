#include "shape/terrain.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The position of the byte in which the magics of meshes and of height fields differ.
constexpr uint32_t k_letter_at = 3;

}  // namespace

Vec32 normal_of(const Vec32& a, const Vec32& b, const Vec32& c) {
  return unit_vector_raw(scaled_to_30_bits(area_vector(a, b, c)));
}

EdgeKind edge_kind(const Vec32& a, const Vec32& b, const Vec32& c, const Vec32& d) {
  // The cosine of k_flat_angle, computed as 1 - angle^2 / 2, Q60. The error of a normal is below 2^-28.
  constexpr int64_t k_flat_cosine = (int64_t{1} << 60) - (int64_t{1} << 47);
  if (dot(normal_of(a, b, c), normal_of(b, a, d)) >= k_flat_cosine) return EdgeKind::flat;
  return sign_of(dot(area_vector(a, b, c), subtract(d, a))) > 0 ? EdgeKind::concave : EdgeKind::convex;
}

Terrain terrain_view(const uint8_t* bytes) {
  Terrain terrain;
  terrain.is_mesh = bytes[k_letter_at] == k_mesh_magic[k_letter_at];
  if (terrain.is_mesh)
    terrain.mesh = mesh_view(bytes);
  else
    terrain.field = height_field_view(bytes);
  return terrain;
}

TerrainTriangle terrain_triangle(const Terrain& terrain, uint32_t index) { return terrain.triangle(index); }

Status read_terrain(const Asset& asset, Terrain& terrain) {
  Terrain read;
  read.is_mesh =
      asset.bytes != nullptr && asset.byte_count > k_letter_at && asset.bytes[k_letter_at] == k_mesh_magic[k_letter_at];
  const Status status = read.is_mesh ? read_mesh(asset, read.mesh) : read_height_field(asset, read.field);
  if (status == Status::ok) terrain = read;
  return status;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
