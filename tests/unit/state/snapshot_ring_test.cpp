#include <detent/rollback.h>

#include "tests/common/oracle/effort.h"
#include "tests/unit/world/turmoil.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_window = 6;

struct Ring {
  std::vector<uint64_t> words = std::vector<uint64_t>(snapshot_ring_bytes(k_turmoil_capacity, k_window) / 8, ~0ull);
  SnapshotRing ring;
  Ring() { EXPECT_OK(ring.begin(bytes_of(words), byte_count(words), k_turmoil_capacity, k_window)); }
};

/// Keeps and makes some ticks. Returns the digest before each tick, and the last one.
std::vector<uint64_t> play(SnapshotRing& ring, World& world, uint64_t seed, uint32_t ticks) {
  std::vector<uint64_t> digests = {digest(world)};
  for (uint32_t i = 0; i < ticks; ++i) {
    EXPECT_OK(ring.keep(world));
    make_turmoil(world, seed);
    digests.push_back(digest(world));
  }
  return digests;
}

/// Goes back by each number of ticks that the ring holds, makes other ticks, goes back again, and repeats the first
/// ticks.
DETENT_TEST(snapshot_ring, ticks_with_bodies_shapes_and_joints_that_come_and_go_are_the_same_when_made_again) {
  const uint32_t windows = getenv("DETENT_FULL") != nullptr ? 100000 : detent_oracle::rounds(2500);
  constexpr uint32_t k_windows_a_world = 50;
  uint32_t done = 0, fewer = 0, more = 0;
  for (uint64_t seed = 1; done < windows; ++seed) {
    OwnedWorld owned = make_turmoiled(seed, static_cast<uint32_t>(seed % 20));
    OwnedWorld straight = make_turmoiled(seed, static_cast<uint32_t>(seed % 20));
    World& world = owned.world;
    Ring kept;
    Draw draw(seed, false);
    for (uint32_t i = 0; i < k_windows_a_world && done < windows; ++i, ++done) {
      const uint64_t start = get_info(world).tick, script = seed * 64 + i;
      const uint32_t ticks = 1 + draw.below(k_window), back = draw.below(ticks), bodies = get_info(world).bodies;
      const std::vector<uint64_t> digests = play(kept.ring, world, script, ticks);
      fewer += get_info(world).bodies < bodies ? 1u : 0u;
      more += get_info(world).bodies > bodies ? 1u : 0u;
      ASSERT_OK(kept.ring.restore(world, start + back));
      if (draw.chance(0.5)) {  // what was predicted
        play(kept.ring, world, script + 1000000, 1 + draw.below(k_window));
        ASSERT_OK(kept.ring.restore(world, start + back));
      }
      ASSERT_EQ(digest(world), digests[back]) << "seed " << seed << ", window " << i;
      const std::vector<uint64_t> again = play(kept.ring, world, script, ticks - back);
      for (uint32_t tick = 0; tick < again.size(); ++tick) {
        ASSERT_EQ(again[tick], digests[back + tick]) << "seed " << seed << ", window " << i << ", tick " << tick;
      }
      for (uint32_t tick = 0; tick < ticks; ++tick) make_turmoil(straight.world, script);
      ASSERT_EQ(digest(straight.world), digest(world)) << "seed " << seed << ", window " << i;
    }
    ASSERT_EQ(save_all(straight.world), save_all(world)) << seed;
  }
  EXPECT_GT(fewer, windows / 50);
  EXPECT_GT(more, windows / 50);
}

DETENT_TEST(snapshot_ring, holds_the_last_ticks_and_no_others) {
  Ring kept;
  OwnedWorld owned = make_turmoiled(1, 0);
  World& world = owned.world;
  EXPECT_FALSE(kept.ring.holds(0)) << "memory may hold anything before";
  play(kept.ring, world, 1, 10);
  const uint64_t before = digest(world);
  for (uint64_t tick = 0; tick < 12; ++tick) {
    EXPECT_EQ(kept.ring.holds(tick), tick >= 4 && tick < 10) << tick;
    if (kept.ring.holds(tick)) continue;
    EXPECT_EQ(kept.ring.restore(world, tick), Status::out_of_range);
  }
  EXPECT_EQ(kept.ring.restore(world, UINT64_MAX), Status::out_of_range);
  EXPECT_EQ(digest(world), before);
  ASSERT_OK(kept.ring.restore(world, 7));
  for (uint64_t tick = 0; tick < 12; ++tick) EXPECT_EQ(kept.ring.holds(tick), tick >= 4 && tick <= 7) << tick;
}

DETENT_TEST(snapshot_ring, forces_that_wait_for_the_next_step_are_kept) {
  Ring kept;
  OwnedWorld owned = make_turmoiled(2, 5);
  World& world = owned.world;
  for (uint32_t i = 0; i < 4; ++i) {
    BodyId id;
    ASSERT_OK(create_body(world, {.shape = sphere(0.5)}, id));
    if (i % 2 == 0) continue;
    ASSERT_OK(apply_force(world, id, {3.0, -2.0, 1.0}));
    ASSERT_OK(apply_torque(world, id, {-1.0, 2.0, 0.5}));
  }
  const auto before = save_all(world);
  ASSERT_OK(kept.ring.keep(world));
  for (int i = 0; i < 3; ++i) step(world);
  ASSERT_OK(kept.ring.restore(world, get_info(world).tick - 3));
  EXPECT_EQ(save_all(world), before);
}

DETENT_TEST(snapshot_ring, bad_arguments_are_refused_and_change_nothing) {
  const uint32_t bytes = snapshot_ring_bytes(k_turmoil_capacity, k_window);
  std::vector<uint64_t> words(bytes / 8 + 1);
  SnapshotRing ring;
  OwnedWorld owned = make_turmoiled(1, 3), other(OwnedWorld::def_of({2, 2, 0}));
  World& world = owned.world;
  const uint64_t before = digest(world);
  EXPECT_EQ(ring.keep(world), Status::bad_argument);
  EXPECT_EQ(ring.restore(world, 3), Status::bad_argument);
  EXPECT_FALSE(ring.holds(3));
  EXPECT_EQ(ring.begin(bytes_of(words), bytes, k_turmoil_capacity, 0), Status::out_of_range);
  EXPECT_EQ(ring.begin(bytes_of(words), bytes, k_turmoil_capacity, 1u << 31), Status::out_of_range);
  EXPECT_EQ(ring.begin(bytes_of(words), bytes, {0, 0, 0}, k_window), Status::out_of_range);
  EXPECT_EQ(ring.begin(nullptr, bytes, k_turmoil_capacity, k_window), Status::buffer_too_small);
  EXPECT_EQ(ring.begin(bytes_of(words), bytes - 1, k_turmoil_capacity, k_window), Status::buffer_too_small);
  EXPECT_EQ(ring.begin(bytes_of(words) + 4, bytes, k_turmoil_capacity, k_window), Status::buffer_misaligned);
  EXPECT_FALSE(ring.holds(3));
  ASSERT_OK(ring.begin(bytes_of(words), bytes, k_turmoil_capacity, k_window));
  EXPECT_EQ(ring.keep(other.world), Status::capacity_differs);
  ASSERT_OK(ring.keep(world));
  EXPECT_EQ(ring.restore(other.world, 3), Status::capacity_differs);
  static constexpr FeatureTable k_few = feature_table<Features::sphere>;
  WorldDef def = turmoil_settings(1);
  def.continuous = def.sleeping = false;
  std::vector<uint64_t> block(world_bytes(def.capacity) / 8);
  World few;
  ASSERT_OK(create_world(bytes_of(block), byte_count(block), def, {}, k_few, few));
  EXPECT_EQ(ring.restore(few, 3), Status::feature_missing);
  EXPECT_EQ(get_info(few).tick, 0u);
  EXPECT_EQ(digest(world), before);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
