#pragma once
#include <functional>

#include "cook.h"

namespace detent_cook {

/// The triangles of a terrain. The corners of a triangle are counter-clockwise, seen from its front side.
struct MeshSource {
  struct Triangle {
    std::array<uint32_t, 3> vertex{};
    uint8_t material = 0;
  };
  std::vector<Point> vertices{};  ///< m
  std::vector<Triangle> triangles{};
};

struct MeshOptions {
  /// m; a vertex this near to a kept vertex is replaced by the kept vertex. 0: only vertices that are equal after
  /// rounding are replaced.
  double weld = 0;
  bool one_sided = false;
};

struct MeshResult {
  std::vector<uint8_t> bytes{};  ///< of the .mesh (docs/mesh.md); empty if refused
  std::string reason{};          ///< why it is refused, in one line; empty if not
  uint32_t vertex_count = 0, triangle_count = 0;
  uint32_t welded = 0;      ///< number of vertices replaced by another vertex
  uint32_t degenerate = 0;  ///< triangles left out: two equal corners, or all corners on a line
  uint32_t repeated = 0;    ///< triangles left out: equal to another triangle
  uint32_t open_edges = 0;  ///< edges at which no two triangles are neighbours
  /// Open edges that more than two triangles share, or that two triangles pass in the same direction.
  uint32_t forked_edges = 0;
  double step = 0;  ///< m; of the grid of the vertices
};

/// Called with the amount of work done and the total.
using CookProgress = std::function<void(uint64_t done, uint64_t total)>;

/// Cooks a mesh, or gives the reason why it is refused: no triangles left, an index or coordinate out of range, more
/// than 2^20 triangles, an extent of more than 16 km. Gives the same bytes on every host. Precision: vertices are
/// rounded to the nearest multiple of MeshResult::step, which is 2^-30 of the least power of two above all coordinates.
MeshResult cook_mesh(const MeshSource& source, const MeshOptions& options = {}, const CookProgress& progress = {});

}  // namespace detent_cook
