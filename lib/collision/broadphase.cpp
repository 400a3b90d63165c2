#include "collision/broadphase.h"

#include "base/heap.h"
#include "geometry/bounds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

PairCount find_pairs(Span<const BodyTraits> traits, Span<const Bounds> bounds, Span<uint32_t> order,
                     Span<uint64_t> pairs) {
  uint32_t count = 0;
  for (uint32_t slot = 0; slot < traits.count; ++slot) {
    if (traits[slot].type != 0) order[count++] = slot;
  }
  heap_sort(order.first(count), [&](uint32_t a, uint32_t b) {
    const Coord x_a = bounds[a].lower.x, x_b = bounds[b].lower.x;
    return x_a < x_b || (x_a == x_b && a < b);
  });
  const auto less = [](uint64_t a, uint64_t b) { return a < b; };
  SmallestOf<uint64_t, decltype(less)> found = {pairs, less};
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t a = order[i];
    const bool dynamic_a = traits[a].type == static_cast<uint32_t>(BodyType::dynamic);
    for (uint32_t j = i + 1; j < count; ++j) {
      const uint32_t b = order[j];
      if (bounds[b].lower.x > bounds[a].upper.x) break;
      if (!dynamic_a && traits[b].type != static_cast<uint32_t>(BodyType::dynamic)) continue;
      if (!overlap(bounds[a], bounds[b])) continue;
      found.add(a < b ? pair_key(a, b) : pair_key(b, a));
    }
  }
  heap_sort(pairs.first(found.count), less);
  return {found.count, found.dropped};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
