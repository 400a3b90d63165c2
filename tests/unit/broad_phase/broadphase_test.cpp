#include "broad_phase/broadphase.h"

#include <algorithm>
#include <vector>

#include "broad_phase/bounds_integer.h"
#include "shape/bounds.h"
#include "tests/common/oracle/bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Crowd {
  std::vector<BodyProperties> properties;
  std::vector<Bounds> bounds;
  std::vector<bool> rests;
};

/// Boxes of mixed sizes in a room of `room` m. Some are fixed, some have bounds that span the room, some slots are
/// empty, some bounds share a coordinate; most boxes rest.
Crowd random_crowd(Samples& samples, uint32_t count, double room) {
  Crowd crowd;
  for (uint32_t i = 0; i < count; ++i) {
    BodyProperties properties{};
    properties.category = properties.mask = 1;
    if (samples.below(4) == 0) {
      properties.category = 1 + samples.below(3);
      properties.mask = samples.below(4);
      properties.group = static_cast<int32_t>(samples.below(5)) - 2;
    }
    properties.type = samples.below(8) == 0 ? 0 : samples.below(4) == 0 ? 1 + samples.below(2) : 3;
    const auto edge = [&] { return floor(uniform(samples, -room, room) * 4) / 4; };
    const Vector low = {{edge(), edge(), edge()}};
    const double size = floor(exp2(uniform(samples, 0, 4))) / 4;
    Bounds bounds = {position_near(low), position_near(low + Vector{{size, size / 2, size * 2}})};
    if (samples.below(50) == 0) bounds = k_everywhere;
    crowd.properties.push_back(properties);
    crowd.bounds.push_back(bounds);
    crowd.rests.push_back(samples.below(3) != 0);
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

/// The filter rules of body.h, evaluated independently.
bool may_touch(const BodyProperties& a, const BodyProperties& b) {
  if (a.group != 0 && a.group == b.group) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

/// The least overlap of the bounds along an axis, as the specification defines it.
uint64_t depth_of(const Bounds& a, const Bounds& b) {
  uint64_t least = UINT64_MAX;
  for (const auto axis : k_axes) {
    const int64_t upper = std::min(integer_from(a.upper.*axis), integer_from(b.upper.*axis));
    const int64_t lower = std::max(integer_from(a.lower.*axis), integer_from(b.lower.*axis));
    least = std::min(least, static_cast<uint64_t>(upper) - static_cast<uint64_t>(lower));
  }
  return least;
}

/// The result of testing every pair with a body that moves, in the order of the keys.
std::vector<uint64_t> all_pairs(const Crowd& crowd) {
  std::vector<uint64_t> keys;
  for (uint32_t a = 0; a < crowd.properties.size(); ++a) {
    for (uint32_t b = a + 1; b < crowd.properties.size(); ++b) {
      if (crowd.properties[a].type == 0 || crowd.properties[b].type == 0) continue;
      if (crowd.rests[a] && crowd.rests[b]) continue;
      if (crowd.properties[a].type != 3 && crowd.properties[b].type != 3) continue;
      if (!may_touch(crowd.properties[a], crowd.properties[b])) continue;
      if (meet(crowd.bounds[a], crowd.bounds[b])) keys.push_back(uint64_t{a} << 32 | b);
    }
  }
  return keys;
}

/// The deepest pairs, in the order of the keys.
std::vector<uint64_t> deepest(const Crowd& crowd, std::vector<uint64_t> keys, uint32_t count) {
  const auto depth = [&](uint64_t key) { return depth_of(crowd.bounds[pair_low(key)], crowd.bounds[pair_high(key)]); };
  std::stable_sort(keys.begin(), keys.end(), [&](uint64_t a, uint64_t b) { return depth(a) > depth(b); });
  keys.resize(count);
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// A tree with capacity for all bodies of a crowd.
struct Tree {
  TreeRoot root{};
  std::vector<TreeNode> nodes;
  std::vector<uint32_t> parents;
  RestingTree tree;

  explicit Tree(const Crowd& crowd)
      : nodes(crowd.bounds.size() + 1),
        parents(crowd.bounds.size()),
        tree{root,
             {nodes.data(), static_cast<uint32_t>(crowd.bounds.size() - 1)},
             {parents.data(), static_cast<uint32_t>(parents.size())},
             {crowd.bounds.data(), static_cast<uint32_t>(crowd.bounds.size())}} {}
  /// The links from the uppermost node down, and what each tells the two sides apart by.
  void describe(uint32_t link, uint32_t depth, std::vector<uint32_t>& shape) const {
    ASSERT_LE(depth, RestingTree::k_depth_max);
    shape.push_back((link & 1) != 0 ? link : nodes[link / 2 - 1].bit);
    if (link == 0 || (link & 1) != 0) return;
    for (const uint32_t child : nodes[link / 2 - 1].child) describe(child, depth + 1, shape);
  }
  std::vector<uint32_t> shape() const {
    std::vector<uint32_t> result;
    describe(root.link, 0, result);
    return result;
  }
};

struct Found {
  std::vector<uint64_t> keys;
  uint32_t dropped;
};

Found found_in(const Crowd& crowd, const RestingTree& tree, uint32_t capacity) {
  const uint32_t count = static_cast<uint32_t>(crowd.properties.size());
  std::vector<BoundsKey> bounds_keys(count), bounds_spare(count);
  std::vector<uint64_t> keys(capacity + 1, 77), spare(capacity);
  std::vector<uint32_t> moving;
  for (uint32_t slot = 0; slot < count; ++slot) {
    if (crowd.properties[slot].type != 0 && !crowd.rests[slot]) moving.push_back(slot);
  }
  PairPool pool = {{},
                   {crowd.properties.data(), count},
                   {crowd.bounds.data(), count},
                   {spare.data(), capacity},
                   {keys.data(), capacity}};
  add_moving_pairs({moving.data(), static_cast<uint32_t>(moving.size())}, tree, {bounds_keys.data(), count},
                   {bounds_spare.data(), count}, pool);
  pool.sort();
  EXPECT_EQ(keys[capacity], 77u) << "written beyond the buffer";
  keys.resize(pool.pairs().count);
  return {keys, pool.dropped()};
}

Found found_in(const Crowd& crowd, uint32_t capacity) {
  Tree tree(crowd);
  for (uint32_t slot = 0; slot < crowd.properties.size(); ++slot) {
    if (crowd.properties[slot].type != 0 && crowd.rests[slot]) tree.tree.insert(slot);
  }
  return found_in(crowd, tree.tree, capacity);
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

DETENT_TEST(broadphase, a_buffer_too_small_keeps_the_deepest_pairs_and_counts_the_rest) {
  Samples samples = {42};
  for (uint32_t round = 0; round < detent_oracle::rounds(40); ++round) {
    const Crowd crowd = random_crowd(samples, 150, 4);
    const std::vector<uint64_t> right = all_pairs(crowd);
    const uint32_t total = static_cast<uint32_t>(right.size());
    for (const uint32_t capacity : {0u, 1u, 7u, total / 2, total - 1, total}) {
      const Found found = found_in(crowd, capacity);
      EXPECT_EQ(found.keys, deepest(crowd, right, capacity));
      EXPECT_EQ(found.dropped, total - capacity);
    }
  }
}

DETENT_TEST(broadphase, pairs_found_after_sorting_are_kept_by_depth_alike) {
  Samples samples = {43};
  for (uint32_t round = 0; round < detent_oracle::rounds(40); ++round) {
    Crowd crowd = random_crowd(samples, 100, 4);
    const std::vector<uint64_t> right = all_pairs(crowd);
    const uint32_t count = 100, capacity = static_cast<uint32_t>(right.size() / 3);
    std::vector<uint64_t> keys(capacity), spare(capacity);
    PairPool pool = {{},
                     {crowd.properties.data(), count},
                     {crowd.bounds.data(), count},
                     {spare.data(), capacity},
                     {keys.data(), capacity}};
    for (const uint64_t key : right) {
      pool.consider(pair_high(key), pair_low(key));
      if (samples.below(10) != 0) continue;
      pool.sort();
      pool.go_on();
    }
    pool.sort();
    EXPECT_EQ(keys, deepest(crowd, right, capacity));
  }
}

DETENT_TEST(broadphase, the_tree_finds_the_same_however_bodies_come_and_go_and_its_shape_is_that_of_who_is_in_it) {
  Samples samples = {44};
  for (uint32_t round = 0; round < detent_oracle::rounds(10); ++round) {
    Crowd crowd = random_crowd(samples, 120, exp2(uniform(samples, 0, 5)));
    for (size_t slot = 0; slot < crowd.rests.size(); ++slot) crowd.rests[slot] = false;
    Tree tree(crowd);
    for (int change = 0; change < 400; ++change) {
      const uint32_t slot = samples.below(120);
      if (crowd.properties[slot].type == 0) continue;
      if (crowd.rests[slot])
        tree.tree.remove(slot);
      else
        tree.tree.insert(slot);
      crowd.rests[slot] = !crowd.rests[slot];
      EXPECT_EQ(tree.tree.has(slot), crowd.rests[slot]);
      if (change % 20 == 0) {
        EXPECT_EQ(found_in(crowd, tree.tree, 20000).keys, all_pairs(crowd));
      }
    }
    Tree other(crowd);
    for (uint32_t slot = 120; slot-- > 0;) {
      if (crowd.rests[slot]) other.tree.insert(slot);
    }
    EXPECT_EQ(tree.shape(), other.shape());
  }
}

DETENT_TEST(broadphase, a_query_looks_at_few_of_many) {
  const uint32_t side = 64, count = side * side;
  Crowd crowd;
  for (uint32_t i = 0; i < count; ++i) {
    const Vector low = {{3.0 * (i % side), 0, 3.0 * (i / side)}};
    crowd.bounds.push_back({position_near(low), position_near(low + Vector{{1, 1, 1}})});
  }
  Tree tree(crowd);
  for (uint32_t slot = 0; slot < count; ++slot) tree.tree.insert(slot);
  uint32_t found = 0, most = 0;
  for (uint32_t slot = 0; slot < count; ++slot) {
    uint32_t looked_at = 0;
    const auto meets = [&](const Bounds& bounds) {
      ++looked_at;
      return overlap(bounds, crowd.bounds[slot]);
    };
    tree.tree.walk(
        meets, [](const Bounds&, const Bounds&) { return false; }, [&](uint32_t) { ++found; });
    most = std::max(most, looked_at);
  }
  EXPECT_EQ(found, count);
  EXPECT_LE(most, 100u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
