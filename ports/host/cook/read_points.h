#pragma once
#include <string_view>

#include "cook.h"

namespace detent_cook {

struct PointsRead {
  std::vector<Point> points{};
  std::string problem{};  ///< one line, with the line's number where there is one; empty if all is well
};

/// The three numbers of an OBJ's vertex, off its line; or the problem with them.
std::string read_vertex(std::string_view& line, Point& point);

/// The vertices of a Wavefront OBJ: lines of `v` and three numbers or more. All other lines are passed over.
PointsRead read_obj(std::string_view text);

/// One of the clouds in a file of them: a uint32 point count, then that many float32 x, y, z, little-endian; repeated
/// to the end of the file. `index` counts from 0.
PointsRead read_clouds(std::string_view bytes, uint32_t index);

/// By the name's end: `.bin` holds clouds, all else is an OBJ.
PointsRead read_points(const std::string& path, std::string_view bytes, uint32_t index);

}  // namespace detent_cook
