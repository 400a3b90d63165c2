#pragma once
#include <string_view>

#include "cook.h"

namespace detent_cook {

struct PointsRead {
  std::vector<Point> points{};
  std::string problem{};  ///< one line, with the line number if known; empty if there is none
};

/// Reads the three numbers of an OBJ vertex, and removes them from the line. Returns the problem; empty if none.
std::string read_vertex(std::string_view& line, Point& point);

/// Reads the vertices of a Wavefront OBJ: lines of `v` and three or more numbers. Skips all other lines.
PointsRead read_obj(std::string_view text);

/// Reads one cloud of a file with several. Each cloud is a uint32 point count and that many float32 x, y, z,
/// little-endian. `index` counts from 0.
PointsRead read_clouds(std::string_view bytes, uint32_t index);

/// Reads points by the file's suffix: `.bin` contains clouds, any other file is an OBJ.
PointsRead read_points(const std::string& path, std::string_view bytes, uint32_t index);

}  // namespace detent_cook
