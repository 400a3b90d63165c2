#include "collision/broadphase.h"

#include <algorithm>
#include <vector>

#include "geometry/bounds.h"
#include "tests/oracle/bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Crowd {
  std::vector<BodyTraits> traits;
  std::vector<Bounds> bounds;
};

/// Boxes of mixed sizes in a room of `room` m, some of them fixed, some everywhere, some slots empty, some edges equal.
Crowd random_crowd(Samples& samples, uint32_t count, double room) {
  Crowd crowd;
  for (uint32_t i = 0; i < count; ++i) {
    BodyTraits traits{};
    traits.type = samples.below(8) == 0 ? 0 : samples.below(4) == 0 ? 1 + samples.below(2) : 3;
    const auto edge = [&] { return floor(uniform(samples, -room, room) * 4) / 4; };
    const Vector low = {{edge(), edge(), edge()}};
    const double size = floor(exp2(uniform(samples, 0, 4))) / 4;
    Bounds bounds = {position_near(low), position_near(low + Vector{{size, size / 2, size * 2}})};
    if (samples.below(50) == 0) bounds = k_everywhere;
    crowd.traits.push_back(traits);
    crowd.bounds.push_back(bounds);
  }
  return crowd;
}

bool meet(const Bounds& a, const Bounds& b) {
  const auto along = [](Coord a_low, Coord a_high, Coord b_low, Coord b_high) {
    return !(a_high < b_low || b_high < a_low);
  };
  return along(a.lower.x, a.upper.x, b.lower.x, b.upper.x) && along(a.lower.y, a.upper.y, b.lower.y, b.upper.y) &&
         along(a.lower.z, a.upper.z, b.lower.z, b.upper.z);
}

/// Every pair tried, in the order of the keys.
std::vector<uint64_t> all_pairs(const Crowd& crowd) {
  std::vector<uint64_t> keys;
  for (uint32_t a = 0; a < crowd.traits.size(); ++a) {
    for (uint32_t b = a + 1; b < crowd.traits.size(); ++b) {
      if (crowd.traits[a].type == 0 || crowd.traits[b].type == 0) continue;
      if (crowd.traits[a].type != 3 && crowd.traits[b].type != 3) continue;
      if (meet(crowd.bounds[a], crowd.bounds[b])) keys.push_back(uint64_t{a} << 32 | b);
    }
  }
  return keys;
}

struct Found {
  std::vector<uint64_t> keys;
  uint32_t dropped;
};

Found found_in(const Crowd& crowd, uint32_t capacity) {
  const uint32_t count = static_cast<uint32_t>(crowd.traits.size());
  std::vector<BoundsKey> bounds_keys(count), bounds_spare(count);
  std::vector<uint64_t> keys(capacity + 1, 77), spare(capacity);
  const PairCount pairs =
      find_pairs({crowd.traits.data(), count}, {crowd.bounds.data(), count}, {bounds_keys.data(), count},
                 {bounds_spare.data(), count}, {spare.data(), capacity}, {keys.data(), capacity});
  EXPECT_EQ(keys[capacity], 77u) << "written beyond the buffer";
  keys.resize(pairs.kept);
  return {keys, pairs.dropped};
}

DETENT_TEST(broadphase, finds_what_trying_every_pair_finds) {
  Samples samples = {41};
  uint64_t total = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(40); ++round) {
    const Crowd crowd = random_crowd(samples, 1 + samples.below(200), exp2(uniform(samples, 0, 5)));
    const std::vector<uint64_t> right = all_pairs(crowd);
    const Found found = found_in(crowd, 20000);
    EXPECT_EQ(found.keys, right);
    EXPECT_EQ(found.dropped, 0u);
    total += right.size();
  }
  EXPECT_GT(total, 1000u);
}

DETENT_TEST(broadphase, a_buffer_too_small_keeps_the_smallest_keys_and_counts_the_rest) {
  Samples samples = {42};
  for (uint32_t round = 0; round < detent_oracle::rounds(40); ++round) {
    const Crowd crowd = random_crowd(samples, 150, 4);
    std::vector<uint64_t> right = all_pairs(crowd);
    const uint32_t total = static_cast<uint32_t>(right.size());
    for (const uint32_t capacity : {0u, 1u, 7u, total / 2, total - 1, total}) {
      const Found found = found_in(crowd, capacity);
      const std::vector<uint64_t> first(right.begin(), right.begin() + static_cast<int>(capacity));
      EXPECT_EQ(found.keys, first);
      EXPECT_EQ(found.dropped, total - capacity);
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
