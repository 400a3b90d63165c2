#pragma once
#include <string>

#include "tests/tool/cook/solids.h"

namespace detent_cook_test {

struct QhullAnswer {
  std::string problem{};
  double volume = 0;
  std::vector<size_t> vertices{};  ///< indices of points
};

/// The hull as Qhull sees it: another's code, in floating point.
QhullAnswer qhull(const Cloud& cloud);

}  // namespace detent_cook_test
