#include "tests/bench/cooked.h"

#include <string.h>

#include <map>

#include "ports/host/cook/cook.h"

namespace detent_bench {

namespace {

std::map<std::vector<detent_queries::Triple>, CookedHull>& all_cooked() {
  static std::map<std::vector<detent_queries::Triple>, CookedHull> all;
  return all;
}

}  // namespace

const CookedHull& cooked_hull(const std::vector<detent_queries::Triple>& points) {
  const auto found = all_cooked().find(points);
  if (found != all_cooked().end()) return found->second;
  detent_cook::CookOptions options;
  options.frame = detent_cook::Frame::source;
  const detent_cook::CookResult result = detent_cook::cook_hull(points, options);
  CookedHull& cooked = all_cooked()[points];
  cooked.byte_count = static_cast<uint32_t>(result.bytes.size());
  cooked.words.resize((result.bytes.size() + 7) / 8);
  if (!result.bytes.empty()) memcpy(cooked.words.data(), result.bytes.data(), result.bytes.size());
  return cooked;
}

void forget_cooked() { all_cooked().clear(); }

}  // namespace detent_bench
