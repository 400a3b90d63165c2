#pragma once
#include <string_view>

#include "cook_height_field.h"

namespace detent_cook {

struct HeightsRead {
  HeightFieldSource field{};
  std::string problem{};  ///< one line; empty if there is none
};

/// Reads a PGM picture (P2 or P5, of 8 or 16 bits): one sample per pixel, rows from north (-z) to south. A black pixel
/// has the height 0, the brightest possible pixel has the height `height`, m. The middle of the picture lies at the
/// origin. `spacing`: distance of the pixels, m.
HeightsRead read_pgm(std::string_view bytes, double spacing, double height);

}  // namespace detent_cook
