#include "broad_phase/broadphase.h"

#include "base/radix_sort.h"
#include "broad_phase/bounds_integer.h"
#include "contact/collide_half_space.h"
#include "math/bits.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A grid along one axis. divide() makes the size of a cell a power of two, so that at most 2^bits cells cover all
/// bodies with finite bounds.
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
bool is_nowhere(const Bounds& bounds) { return bounds.upper.x < bounds.lower.x; }

/// Two coordinates of 15 bits are packed in one word, each with a guard bit above it. If the guard bits are set in a
/// word of upper bounds, and a word of lower bounds is subtracted, a guard bit becomes 0 if the upper bound is below
/// the lower bound.
constexpr uint32_t k_across_bits = 15, k_across_guards = 0x80008000;

uint32_t across(uint32_t first, uint32_t second) { return first << (k_across_bits + 1) | second; }

bool are_apart(const BoundsKey& a, const BoundsKey& b) {
  const uint32_t left = ((a.across_upper | k_across_guards) - b.across_lower) &
                        ((b.across_upper | k_across_guards) - a.across_lower) & k_across_guards;
  return left != k_across_guards;
}

bool is_dynamic_type(const BodyProperties& properties) {
  return properties.type == static_cast<uint32_t>(BodyType::dynamic);
}

/// Converts a length, m, to the integer unit of integer_from(): 2^-k_coord_bits m.
int64_t integer_length(Real length) {
#if DETENT_FIXED
  return length.raw >> (Real::k_frac - Coord::k_frac);
#else
  bool saturated = false;
#if defined(DETENT_F64)
  return integer_from_float(length, 20, saturated);
#else
  return integer_from_float(length, Coord::k_frac, saturated);
#endif
#endif
}

/// The depth of the lowest corner of `box` below the surface of a half-space, in units of 2^-k_coord_bits m; 0 if the
/// corner is above the surface.
uint64_t depth_within(const BodyPose& half_space, const Bounds& box) {
  const Vec3<Unit> up = matrix_from(half_space.rotation).column[1];
  const Unit zero = 0.0;
  const Position lowest = {up.x > zero ? box.lower.x : box.upper.x, up.y > zero ? box.lower.y : box.upper.y,
                           up.z > zero ? box.lower.z : box.upper.z};
  const int64_t height = integer_length(distance_along(half_space.position, lowest, up));
  return height < 0 ? static_cast<uint64_t>(-height) : 0;
}

}  // namespace

uint64_t DeeperPair::depth(uint64_t key) const {
  const uint32_t low = pair_low(key), high = pair_high(key);
  if (is_half_space(properties[low])) return depth_within(poses[low], bounds[high]);
  if (is_half_space(properties[high])) return depth_within(poses[high], bounds[low]);
  const Bounds &a = bounds[low], &b = bounds[high];
  uint64_t least = UINT64_MAX;
  for (const auto axis : k_axes) {
    const int64_t upper_a = integer_from(a.upper.*axis), upper_b = integer_from(b.upper.*axis);
    const int64_t lower_a = integer_from(a.lower.*axis), lower_b = integer_from(b.lower.*axis);
    const int64_t upper = upper_a < upper_b ? upper_a : upper_b, lower = lower_a > lower_b ? lower_a : lower_b;
    const uint64_t along = static_cast<uint64_t>(upper) - static_cast<uint64_t>(lower);
    least = along < least ? along : least;
  }
  return least;
}

bool DeeperPair::operator()(uint64_t a, uint64_t b) const {
  const uint64_t depth_a = depth(a), depth_b = depth(b);
  return depth_a > depth_b || (depth_a == depth_b && a < b);
}

namespace {

bool takes_pair(const PairPool& pool, uint32_t a, uint32_t b) {
  if (!is_dynamic_type(pool.properties[a]) && !is_dynamic_type(pool.properties[b])) return false;
  return overlap(pool.bounds[a], pool.bounds[b]) && pool.filter.allows(a, b);
}

void add_pair(uint64_t key, PairPool& pool) {
  uint64_t lost;
  if (pool.found.add(key, lost) && pool.overflow != nullptr)
    pool.overflow->add(CapacityEventType::pair, pair_low(lost), pair_high(lost));
}

}  // namespace

#if DETENT_TASKS
bool PairPool::takes(uint32_t a, uint32_t b) const { return takes_pair(*this, a, b); }
void PairPool::add(uint64_t key) { add_pair(key, *this); }
#endif

void PairPool::consider(uint32_t a, uint32_t b) {
  if (takes_pair(*this, a, b)) add_pair(key_of_pair(a, b), *this);
}

/// A radix sort by the higher slot and then, stably, by the lower slot. Its digits are bytes; it uses only as many of
/// them as slot numbers have.
void PairPool::sort() {
  const int bytes = properties.count <= 256 ? 1 : properties.count <= 65536 ? 2 : 3;
  radix_sort(
      found.storage.first(found.count), spare,
      [bytes](uint64_t pair, int digit) {
        return static_cast<uint32_t>(pair >> (digit < bytes ? 8 * digit : 32 + 8 * (digit - bytes))) & 255;
      },
      2 * bytes);
}

void PairPool::go_on() {
  if (found.count == found.storage.count) heap_make(found.storage, found.less);
}

void find_resting_near(uint32_t slot, const RestingTree& resting, PairFinder& finder) {
  resting.for_each_near(resting.bounds[slot], [&](uint32_t other) { finder.consider(slot, other); });
}

void add_moving_pairs(Span<const uint32_t> moving, const RestingTree& resting, Span<BoundsKey> keys,
                      Span<BoundsKey> spare, PairPool& pool) {
  const Span<const Bounds> bounds = pool.bounds;
  Grid grid[3];
  for (int i = 0; i < 3; ++i) grid[i].axis = k_axes[i];
  for (const uint32_t slot : moving) {
    if (is_everywhere(bounds[slot]) || is_nowhere(bounds[slot])) continue;
    for (Grid& axis : grid) axis.include(bounds[slot]);
  }
  int widest = 0;
  for (int i = 1; i < 3; ++i) widest = grid[i].span() > grid[widest].span() ? i : widest;
  const Grid swap = grid[0];
  grid[0] = grid[widest];
  grid[widest] = swap;
  grid[0].divide(32);
  for (int i = 1; i < 3; ++i) grid[i].divide(k_across_bits);

  if (pool.team != nullptr) {
    share(pool.team, moving, k_bodies_shared, [&](Span<const uint32_t> part) {
      PairFinder shared(pool);
      for (const uint32_t slot : part) {
        if (!is_nowhere(bounds[slot])) find_resting_near(slot, resting, shared);
      }
    });
  }
  PairFinder finder(pool);
  uint32_t count = 0, everywhere = 0;
  for (const uint32_t slot : moving) {
    if (is_nowhere(bounds[slot])) continue;
    if (pool.team == nullptr) find_resting_near(slot, resting, finder);
    if (is_everywhere(bounds[slot])) {
      spare[everywhere++].slot = slot;
      continue;
    }
    const Bounds& at = bounds[slot];
    BoundsKey& key = keys[count++];
    key = {grid[0].cell_of(at.lower.*grid[0].axis),
           grid[0].cell_of(at.upper.*grid[0].axis),
           slot,
           is_dynamic_type(pool.properties[slot]) ? 1u : 0u,
           across(grid[1].cell_of(at.lower.*grid[1].axis), grid[2].cell_of(at.lower.*grid[2].axis)),
           across(grid[1].cell_of(at.upper.*grid[1].axis), grid[2].cell_of(at.upper.*grid[2].axis))};
  }

  for (uint32_t i = 0; i < everywhere; ++i) {
    for (const BoundsKey& other : keys.first(count)) pool.consider(spare[i].slot, other.slot);
    for (uint32_t k = i + 1; k < everywhere; ++k) pool.consider(spare[i].slot, spare[k].slot);
  }
  radix_sort(
      keys.first(count), spare, [](const BoundsKey& key, int digit) { return key.lower >> (8 * digit) & 255; }, 4);
  share(pool.team, count, k_bodies_shared, [&](uint32_t first, uint32_t last) {
    PairFinder shared(pool);
    for (uint32_t i = first; i < last; ++i) {
      const BoundsKey& a = keys[i];
      for (uint32_t k = i + 1; k < count && keys[k].lower <= a.upper; ++k) {
        const BoundsKey& b = keys[k];
        if ((a.is_dynamic | b.is_dynamic) == 0 || are_apart(a, b)) continue;
        shared.consider(a.slot, b.slot);
      }
    }
  });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
