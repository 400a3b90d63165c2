#include "shape/surface.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The formats differ in this byte of the magic.
constexpr uint32_t k_letter_at = 3;

}  // namespace

Vec32 normal_of(const Vec32& a, const Vec32& b, const Vec32& c) {
  return unit_vector_raw(scaled_to_30_bits(area_vector(a, b, c)));
}

EdgeKind edge_kind(const Vec32& a, const Vec32& b, const Vec32& c, const Vec32& d) {
  // 1 - angle^2 / 2, Q60; a normal errs by less than 2^-28.
  constexpr int64_t k_flat_cosine = (int64_t{1} << 60) - (int64_t{1} << 47);
  if (dot(normal_of(a, b, c), normal_of(b, a, d)) >= k_flat_cosine) return EdgeKind::flat;
  return sign_of(dot(area_vector(a, b, c), subtract(d, a))) > 0 ? EdgeKind::concave : EdgeKind::convex;
}

Surface surface_view(const uint8_t* bytes) {
  Surface surface;
  surface.is_mesh = bytes[k_letter_at] == k_mesh_magic[k_letter_at];
  if (surface.is_mesh)
    surface.mesh = mesh_view(bytes);
  else
    surface.field = height_field_view(bytes);
  return surface;
}

SurfaceTriangle surface_triangle(const Surface& surface, uint32_t index) { return surface.triangle(index); }

Status read_surface(const Asset& asset, Surface& surface) {
  Surface read;
  read.is_mesh =
      asset.bytes != nullptr && asset.byte_count > k_letter_at && asset.bytes[k_letter_at] == k_mesh_magic[k_letter_at];
  const Status status = read.is_mesh ? read_mesh(asset, read.mesh) : read_height_field(asset, read.field);
  if (status == Status::ok) surface = read;
  return status;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
