#pragma once
#include <functional>

#include "cook.h"

namespace detent_cook {

/// Triangles of a level: corners counter-clockwise seen from the side that counts.
struct MeshSource {
  struct Triangle {
    std::array<uint32_t, 3> vertex{};
    uint8_t material = 0;
  };
  std::vector<Point> vertices{};  ///< m
  std::vector<Triangle> triangles{};
};

struct MeshOptions {
  double weld = 0;  ///< m; vertices this near to one that is kept become it. 0: only those that are equal once rounded
  bool one_sided = false;
};

struct MeshResult {
  std::vector<uint8_t> bytes{};  ///< of the .mesh (docs/mesh.md); empty if it is refused
  std::string reason{};          ///< why it is refused: one line
  uint32_t vertex_count = 0, triangle_count = 0;
  uint32_t welded = 0;        ///< vertices that became another one
  uint32_t degenerate = 0;    ///< triangles left out: two corners the same, or all on a line
  uint32_t repeated = 0;      ///< triangles left out: the same as another one
  uint32_t open_edges = 0;    ///< edges with no neighbour
  uint32_t forked_edges = 0;  ///< of those, edges that more than two triangles share or that two pass the same way
  double step = 0;            ///< m; of the grid that vertices are rounded to
};

/// Is told of work done, of a total.
using CookProgress = std::function<void(uint64_t done, uint64_t total)>;

/// The cooked mesh, or the reason why there is none: no triangles left, an index or coordinate out of range, more than
/// 2^20 triangles, an extent of more than 16 km. The same bytes on every host.
/// Precision: vertices to nearest, `step`, which is 2^-30 of the least power of two above all coordinates.
MeshResult cook_mesh(const MeshSource& source, const MeshOptions& options = {}, const CookProgress& progress = {});

}  // namespace detent_cook
