#pragma once
#include <detent/contact.h>
#include <detent/toi.h>

#include "tests/common/support/random.h"

/// Seeded pairs of convex shapes whose numbers are exact in each configuration: an integer below 2^24 times a power of
/// two no finer than fx32's positions. Rotations are exact too, until the library normalises them.
namespace detent_lockstep {

using namespace detent;

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t bits() { return detent_test::split_mix(state_); }
  /// In [0, count).
  int32_t below(int32_t count);
  /// In [-limit, limit].
  int32_t within(int32_t limit) { return below(2 * limit + 1) - limit; }
  bool one_in(int32_t count) { return below(count) == 0; }

 private:
  uint64_t state_;
};

/// The cooked hulls, prepared once: the checks of their bytes take longer than a query.
struct Hulls {
  static constexpr int k_count = 3;
  Convex sharp[k_count], round[k_count];
};
/// Panics if the library refuses a hull.
void make_hulls(Hulls& hulls);

struct Pair {
  Convex a, b;
  Motion motion_a, motion_b;  ///< relative to A's, B's displacement is mostly towards A
  Vec3<Real> offset;          ///< from A's position to B's, m
  Vec3<Real> displacement;    ///< B's displacement relative to A, m
  Real distance_max;          ///< m
};
/// All types, rounded and not, in all rotations or along the axes; some touch exactly, some are far from the origin.
void make_pair(Random& random, const Hulls& hulls, Pair& pair);
/// As make_pair(), with boxes, hulls and triangles only, none rounded.
void make_polytopes(Random& random, const Hulls& hulls, Pair& pair);

}  // namespace detent_lockstep
