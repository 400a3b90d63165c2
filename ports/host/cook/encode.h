#pragma once
#include "faces.h"
#include "mass.h"

namespace detent_cook {

/// The values in the header of a .hull.
struct HullHeader {
  int32_t exponent = 0;
  bool principal = true;
  double volume = 0;                        ///< in unit^3
  std::array<double, 3> inverse_inertia{};  ///< inverse inertia per unit mass: m unit^2 / I
  std::array<double, 3> origin{};           ///< m, in the source frame
  GridRotation rotation = k_no_rotation;    ///< from the body to the source frame
};

/// The bytes of a .hull (docs/hull.md). `vertices`: all vertices of the hull, ascending; `faces`: its joined faces.
std::vector<uint8_t> encode_hull(const std::vector<GridPoint>& vertices, const std::vector<PolygonFace>& faces,
                                 const HullHeader& header);

}  // namespace detent_cook
