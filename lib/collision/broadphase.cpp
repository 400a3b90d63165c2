#include "collision/broadphase.h"

#include "base/heap.h"
#include "base/radix_sort.h"
#include "geometry/bounds.h"
#include "math/bits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A coordinate as an integer that rises with it.
int64_t integer_from(Coord x) {
#if defined(DETENT_F64)
  bool saturated = false;
  return integer_from_float(x, 20, saturated);
#else
  return x.raw;
#endif
}

constexpr Coord Position::*k_axes[] = {&Position::x, &Position::y, &Position::z};

/// Cells of a power of two, no more than 2^bits of them over all that is not everywhere.
struct Grid {
  Coord Position::*axis = nullptr;
  int64_t from = INT64_MAX, to = INT64_MIN;
  int shift = 0;

  void include(const Bounds& bounds) {
    const int64_t low = integer_from(bounds.lower.*axis), high = integer_from(bounds.upper.*axis);
    from = low < from ? low : from;
    to = high > to ? high : to;
  }
  uint64_t span() const { return to < from ? 0 : static_cast<uint64_t>(to) - static_cast<uint64_t>(from); }
  void divide(int bits) {
    const int length = bit_length_64(span());
    shift = length > bits ? length - bits : 0;
  }
  uint32_t cell_of(Coord x) const {
    const int64_t at = integer_from(x);
    if (at <= from) return 0;
    return static_cast<uint32_t>((static_cast<uint64_t>(at < to ? at : to) - static_cast<uint64_t>(from)) >> shift);
  }
};

bool is_everywhere(const Bounds& bounds) { return bounds.lower.x == -k_coord_limit && bounds.upper.x == k_coord_limit; }

bool are_apart(const BoundsKey& a, const BoundsKey& b) {
  return a.across_upper[0] < b.across_lower[0] || b.across_upper[0] < a.across_lower[0] ||
         a.across_upper[1] < b.across_lower[1] || b.across_upper[1] < a.across_lower[1];
}

bool less(uint64_t a, uint64_t b) { return a < b; }

}  // namespace

PairCount find_pairs(Span<const BodyTraits> traits, Span<const Bounds> bounds, Span<BoundsKey> keys,
                     Span<BoundsKey> spare, Span<uint64_t> pair_spare, Span<uint64_t> pairs) {
  Grid grid[3];
  for (int i = 0; i < 3; ++i) grid[i].axis = k_axes[i];
  for (uint32_t slot = 0; slot < traits.count; ++slot) {
    if (traits[slot].type == 0 || is_everywhere(bounds[slot])) continue;
    for (Grid& axis : grid) axis.include(bounds[slot]);
  }
  int widest = 0;
  for (int i = 1; i < 3; ++i) widest = grid[i].span() > grid[widest].span() ? i : widest;
  const Grid swap = grid[0];
  grid[0] = grid[widest];
  grid[widest] = swap;
  grid[0].divide(32);
  for (int i = 1; i < 3; ++i) grid[i].divide(16);

  uint32_t count = 0, everywhere = 0;
  for (uint32_t slot = 0; slot < traits.count; ++slot) {
    if (traits[slot].type == 0) continue;
    if (is_everywhere(bounds[slot])) {
      spare[everywhere++].slot = slot;
      continue;
    }
    const Bounds& at = bounds[slot];
    BoundsKey& key = keys[count++];
    key = {grid[0].cell_of(at.lower.*grid[0].axis),
           grid[0].cell_of(at.upper.*grid[0].axis),
           slot,
           traits[slot].type == static_cast<uint32_t>(BodyType::dynamic) ? 1u : 0u,
           {},
           {}};
    for (int i = 0; i < 2; ++i) {
      const Grid& across = grid[i + 1];
      key.across_lower[i] = static_cast<uint16_t>(across.cell_of(at.lower.*across.axis));
      key.across_upper[i] = static_cast<uint16_t>(across.cell_of(at.upper.*across.axis));
    }
  }

  SmallestOf<uint64_t, decltype(&less)> found = {pairs, &less};
  const auto consider = [&](uint32_t a, uint32_t b) {
    if (overlap(bounds[a], bounds[b])) found.add(a < b ? pair_key(a, b) : pair_key(b, a));
  };
  const auto is_dynamic_slot = [&](uint32_t slot) {
    return traits[slot].type == static_cast<uint32_t>(BodyType::dynamic);
  };
  for (uint32_t i = 0; i < everywhere; ++i) {
    const uint32_t slot = spare[i].slot;
    for (const BoundsKey& other : keys.first(count)) {
      if (other.is_dynamic != 0 || is_dynamic_slot(slot)) consider(slot, other.slot);
    }
    for (uint32_t k = i + 1; k < everywhere; ++k) {
      if (is_dynamic_slot(slot) || is_dynamic_slot(spare[k].slot)) consider(slot, spare[k].slot);
    }
  }
  radix_sort(
      keys.first(count), spare, [](const BoundsKey& key, int digit) { return key.lower >> (8 * digit) & 255; }, 4);
  for (uint32_t i = 0; i < count; ++i) {
    const BoundsKey& a = keys[i];
    for (uint32_t k = i + 1; k < count && keys[k].lower <= a.upper; ++k) {
      const BoundsKey& b = keys[k];
      if ((a.is_dynamic | b.is_dynamic) == 0 || are_apart(a, b)) continue;
      consider(a.slot, b.slot);
    }
  }

  // By the higher slot, then by the lower one: only as many digits as slots have.
  const int bytes = traits.count <= 256 ? 1 : traits.count <= 65536 ? 2 : 3;
  radix_sort(
      pairs.first(found.count), pair_spare,
      [bytes](uint64_t pair, int digit) {
        return static_cast<uint32_t>(pair >> (digit < bytes ? 8 * digit : 32 + 8 * (digit - bytes))) & 255;
      },
      2 * bytes);
  return {found.count, found.dropped};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
