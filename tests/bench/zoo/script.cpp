#include "tests/bench/zoo/script.h"

#include <algorithm>

namespace detent_zoo {

double pair_friction(const Properties& a, const Properties& b) { return sqrt(a.friction * b.friction); }

double pair_restitution(const Properties& a, const Properties& b) {
  return a.damps || b.damps ? std::min(a.restitution, b.restitution) : std::max(a.restitution, b.restitution);
}

double pair_rolling_arm(const Properties& a, const Properties& b) {
  return std::max(a.rolling_resistance, b.rolling_resistance) * std::min(a.half_width, b.half_width);
}

bool pair_touches(const Properties& a, const Properties& b) {
  if (a.group != 0 && a.group == b.group) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

}  // namespace detent_zoo
