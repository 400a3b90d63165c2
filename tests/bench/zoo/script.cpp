#include "tests/bench/zoo/script.h"

#include <algorithm>

namespace detent_zoo {

double pair_friction(const Traits& a, const Traits& b) { return sqrt(a.friction * b.friction); }

double pair_restitution(const Traits& a, const Traits& b) {
  return a.damps || b.damps ? std::min(a.restitution, b.restitution) : std::max(a.restitution, b.restitution);
}

double pair_rolling_arm(const Traits& a, const Traits& b) {
  return std::max(a.rolling_resistance, b.rolling_resistance) * std::min(a.half_width, b.half_width);
}

bool pair_touches(const Traits& a, const Traits& b) {
  if (a.group != 0 && a.group == b.group) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

}  // namespace detent_zoo
