#pragma once
#include <string_view>

#include "cook_height_field.h"

namespace detent_cook {

struct HeightsRead {
  HeightFieldSource field{};
  std::string problem{};  ///< one line; empty if there is none
};

/// Reads the picture of a PGM (P2 or P5, of 8 or 16 bits): one sample per pixel, rows from north (-z) to south. Black
/// is height 0, and the brightest possible pixel is `height`, m. The picture's middle lies at the origin; `spacing`:
/// distance of the pixels, m.
HeightsRead read_pgm(std::string_view bytes, double spacing, double height);

}  // namespace detent_cook
