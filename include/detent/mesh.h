#pragma once
#include <detent/asset.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a cooked triangle mesh (docs/mesh.md) says of itself. The same in every configuration.
struct MeshInfo {
  uint32_t vertex_count = 0;    ///< vertices
  uint32_t triangle_count = 0;  ///< triangles
  uint32_t node_count = 0;      ///< nodes of its tree
  int32_t exponent = 0;         ///< of its unit of length, 2^exponent m; coordinates are in 2^-30 of it
  bool one_sided = false;       ///< met from the side alone that sees the corners counter-clockwise
  int32_t low[3] = {};          ///< least coordinates of the vertices
  int32_t high[3] = {};         ///< greatest
};

/// Describes a cooked mesh, after every check. Errors: buffer_misaligned (8), not_detent, format_unknown, truncated,
/// corrupt, out_of_range (the exponent).
Status mesh_info(const Asset& asset, MeshInfo& info);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
