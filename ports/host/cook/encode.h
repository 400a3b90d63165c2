#pragma once
#include "faces.h"
#include "mass.h"

namespace detent_cook {

/// What goes into the header.
struct HullHeader {
  int32_t exponent = 0;
  bool principal = true;
  double volume = 0;                      ///< in unit^3
  std::array<double, 3> gyration{};       ///< m unit^2 / I
  std::array<double, 3> origin{};         ///< m, in the source frame
  GridRotation rotation = k_no_rotation;  ///< from the body to the source frame
};

/// The bytes of a .hull (docs/hull.md). `vertices` are all of the hull's, ascending; `faces` are joined faces of it.
std::vector<uint8_t> encode_hull(const std::vector<GridPoint>& vertices, const std::vector<PolygonFace>& faces,
                                 const HullHeader& header);

}  // namespace detent_cook
