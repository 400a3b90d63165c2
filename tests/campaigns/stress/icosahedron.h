#pragma once
#include <stdint.h>

#include <array>
#include <vector>

namespace detent_stress {

/// A cooked icosahedron, aligned to 8.
struct CookedIcosahedron {
  std::vector<uint64_t> words;
  uint32_t byte_count = 0;
  /// x, y, z, w: from the cooked axes, which are the principal axes, to the stage's.
  std::array<double, 4> rotation = {0, 0, 0, 1};
};
CookedIcosahedron cook_icosahedron(double radius);

}  // namespace detent_stress
