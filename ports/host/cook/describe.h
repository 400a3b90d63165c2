#pragma once
#include <stdint.h>

#include <array>
#include <string>
#include <vector>

namespace detent_cook {

/// The content of a .hull, as the library reads it.
struct HullDescription {
  std::string problem{};  ///< why the library refuses it; empty if it accepts it
  uint32_t vertex_count = 0, face_count = 0, edge_count = 0;
  bool principal = true;
  int32_t exponent = 0;                           ///< of the unit of length, 2^exponent m
  double radius = 0;                              ///< m; greatest distance of a vertex from the origin
  double volume = 0;                              ///< m^3
  std::array<double, 3> origin{};                 ///< m; the body's origin in the source frame
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< x, y, z, w: from the body to the source frame
};

/// Describes the bytes of a file after all checks of the library.
HullDescription describe_hull(const std::vector<uint8_t>& bytes);

/// The content of a .compound, as the library reads it.
struct CompoundDescription {
  std::string problem{};  ///< why the library refuses it; empty if it accepts it
  uint32_t child_count = 0, hull_count = 0;
  double radius = 0;                              ///< m; greatest distance of its surface from the origin
  double thickness = 0;                           ///< m; of the thinnest child
  double volume = 0;                              ///< m^3; the mass at density 1
  std::array<double, 3> origin{};                 ///< m; the body's origin in the source frame
  std::array<double, 4> rotation = {0, 0, 0, 1};  ///< x, y, z, w: from the body to the source frame
};

/// Describes the bytes of a file after all checks of the library.
CompoundDescription describe_compound(const std::vector<uint8_t>& bytes);

/// The content of a .mesh or a .field, as the library reads it.
struct TerrainDescription {
  std::string problem{};  ///< why the library refuses it; empty if it accepts it
  bool is_mesh = true;    ///< otherwise a height field
  uint32_t vertex_count = 0, triangle_count = 0;
  uint32_t node_count = 0;          ///< of a mesh
  uint32_t columns = 0, rows = 0;   ///< of a height field
  std::array<uint32_t, 4> edges{};  ///< of a mesh: flat, convex, concave and open sides of triangles
  bool one_sided = false;
  double step = 0;                      ///< m; of the grid
  std::array<double, 3> low{}, high{};  ///< m
};

/// Describes the bytes of a file after all checks of the library.
TerrainDescription describe_terrain(const std::vector<uint8_t>& bytes);

}  // namespace detent_cook
