#pragma once
#include <detent/asset.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The properties of a cooked triangle mesh (docs/mesh.md). The same in every configuration.
struct MeshInfo {
  uint32_t vertex_count = 0;    ///< vertices
  uint32_t triangle_count = 0;  ///< triangles
  uint32_t node_count = 0;      ///< nodes of its tree
  int32_t exponent = 0;         ///< the unit of length is 2^exponent m; coordinates are in 2^-30 of it
  bool one_sided = false;       ///< bodies collide only with the side on which the corners are counter-clockwise
  int32_t low[3] = {};          ///< least coordinates of the vertices
  int32_t high[3] = {};         ///< greatest coordinates of the vertices
};

/// Checks a cooked mesh in full and describes it. Errors: buffer_misaligned (to 8 bytes), not_detent, format_unknown,
/// truncated, corrupt, out_of_range (the exponent).
Status mesh_info(const Asset& asset, MeshInfo& info);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
