#pragma once
#include "cook.h"

namespace detent_cook {

/// Heights above a grid in x and z.
struct HeightFieldSource {
  uint32_t columns = 0, rows = 0;       ///< cells along x and z
  std::vector<double> heights{};        ///< m; (columns + 1) (rows + 1) of them, x first
  std::vector<uint8_t> cells{};         ///< columns x rows of them, docs/height_field.md; empty: all of material 0
  Point origin{};                       ///< m; of the first sample, at height 0
  double spacing_x = 1, spacing_z = 1;  ///< m
  bool one_sided = true;
};

struct HeightFieldResult {
  std::vector<uint8_t> bytes{};  ///< docs/height_field.md; empty if refused
  std::string reason{};          ///< why it is refused, in one line; empty if not
  double step = 0;               ///< m; of the grid of the spacing
  double height_step = 0;        ///< m; of the grid of the heights
};

/// Cooks a height field, or gives the reason why it is refused: inconsistent numbers of elements, more than 4096 cells
/// along a side, an extent of more than 16 km. Gives the same bytes on every host.
HeightFieldResult cook_height_field(const HeightFieldSource& source);

}  // namespace detent_cook
