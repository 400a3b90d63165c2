#include "base/bytes.h"
#include "tests/world/lab.h"
#include "world/fields.h"
#include "world/snapshot.h"
#include "world/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(state, every_bit_of_it_is_in_the_digest) {
  Lab lab = make_pile();
  const uint64_t before = digest(lab.world);
  const uint32_t end = snapshot_bytes(get_info(lab.world).capacity);
  uint32_t unseen = 0;
  for (uint32_t byte = sizeof(BlockHeader); byte < end; ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      lab.block()[byte] ^= static_cast<uint8_t>(1 << bit);
      unseen += digest(lab.world) == before ? 1u : 0u;
      lab.block()[byte] ^= static_cast<uint8_t>(1 << bit);
    }
  }
  EXPECT_EQ(unseen, 0u);
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(state, no_bit_of_a_snapshot_can_be_flipped_into_a_crash_and_those_of_the_header_are_refused) {
  Lab lab = make_pile();
  const uint64_t before = digest(lab.world);
  const std::vector<uint64_t> good = lab.snapshot();
  Lab other(get_info(lab.world).capacity);
  uint32_t loaded = 0;
  for (uint32_t bit = 0; bit < byte_count(good) * 8; ++bit) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[bit / 8] ^= static_cast<uint8_t>(1 << (bit % 8));
    const Status status = load(other.world, bytes_of(bytes), byte_count(bytes));
    const bool features = bit / 32 == offsetof(BlockHeader, left_out) / 4;  // one that no body uses may be left out
    if (bit / 8 < sizeof(BlockHeader) && !(features && status == Status::ok && digest(other.world) == before)) {
      EXPECT_NE(status, Status::ok) << "bit " << bit;
    }
    if (status != Status::ok) continue;
    ++loaded;
    other.run(1);  // any state that is let in can be stepped
  }
  EXPECT_GT(loaded, 0u);
}

DETENT_TEST(state, a_refused_snapshot_changes_nothing) {
  Lab lab = make_pile();
  const uint64_t before = digest(lab.world);
  std::vector<uint64_t> bytes = lab.snapshot();
  std::vector<uint64_t> bad = bytes;
  view_of(bytes_of(bad), get_info(lab.world).capacity).world.body_count += 1;
  lab.run(1);
  const uint64_t later = digest(lab.world);
  if (!k_big_endian) {
    EXPECT_EQ(load(lab.world, bytes_of(bad), byte_count(bad)), Status::corrupt);
  }
  EXPECT_EQ(digest(lab.world), later);
  for (uint32_t count = 0; count < byte_count(bytes); count += 64) {
    std::vector<uint64_t> part = bytes;
    EXPECT_EQ(load(lab.world, bytes_of(part), count), Status::truncated);
    EXPECT_EQ(restore(lab.world, bytes_of(part), count), Status::truncated);
  }
  EXPECT_EQ(digest(lab.world), later);
  EXPECT_OK(load(lab.world, bytes_of(bytes), byte_count(bytes)));
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(state, a_restored_world_goes_on_as_if_nothing_had_happened) {
  Lab lab = make_pile();
  const std::vector<uint64_t> seed = lab.snapshot();
  std::vector<uint64_t> expected;
  for (int i = 0; i < 60; ++i) {
    lab.run(1);
    expected.push_back(digest(lab.world));
  }
  Lab other(get_info(lab.world).capacity);
  for (int round = 0; round < 2; ++round) {
    std::vector<uint64_t> bytes = seed;
    ASSERT_OK(round == 0 ? restore(other.world, bytes_of(bytes), byte_count(bytes))
                         : load(other.world, bytes_of(bytes), byte_count(bytes)));
    for (const uint64_t want : expected) {
      other.run(1);
      ASSERT_EQ(digest(other.world), want);
    }
  }
}

DETENT_TEST(state, bodies_may_be_created_and_destroyed_between_a_snapshot_and_its_restore) {
  Lab lab = make_pile();
  const std::vector<uint64_t> seed = lab.snapshot();
  const auto play = [&] {
    const BodyId id = lab.add_box(0.25, 0, 6, 0);
    lab.run(10);
    EXPECT_OK(destroy_body(lab.world, next_body(lab.world, {})));
    EXPECT_OK(destroy_body(lab.world, id));
    lab.add_box(0.25, 1, 6, 0);
    lab.run(10);
    return digest(lab.world);
  };
  const uint64_t first = play();
  ASSERT_OK(restore(lab.world, reinterpret_cast<const uint8_t*>(seed.data()), byte_count(seed)));
  EXPECT_EQ(play(), first);
}

DETENT_TEST(state, the_digest_does_not_depend_on_the_capacity) {
  const auto run = [](Capacity capacity) {
    Lab lab(capacity);
    lab.add_ground();
    for (int i = 0; i < 3; ++i) lab.add_box(0.5, 0.1 * i, 0.5 + i, 0);
    lab.run(30);
    return digest(lab.world);
  };
  EXPECT_EQ(run({4, 8, 0}), run({100, 50, 3}));
}

DETENT_TEST(state, a_snapshot_of_another_kind_is_named) {
  Lab lab = make_pile();
  const std::vector<uint64_t> good = lab.snapshot();
  const auto altered = [&](uint32_t word) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[word * 4 + 1] ^= 1;
    return load(lab.world, bytes_of(bytes), byte_count(bytes));
  };
  EXPECT_EQ(altered(0), Status::not_detent);
  EXPECT_EQ(altered(1), Status::format_unknown);
  EXPECT_EQ(altered(2), Status::simulation_differs);
  EXPECT_EQ(altered(3), Status::config_differs);
  EXPECT_EQ(altered(4), Status::capacity_differs);
  EXPECT_EQ(altered(5), Status::capacity_differs);
  EXPECT_EQ(altered(6), Status::capacity_differs);
}

DETENT_TEST(state, a_snapshot_reads_the_same_in_pieces_of_any_size) {
  Lab lab = make_pile();
  const std::vector<uint64_t> whole = lab.snapshot();
  for (const uint32_t piece : {1u, 7u, 64u, 250u}) {
    std::vector<uint8_t> parts(byte_count(whole));
    for (uint32_t at = 0; at < parts.size(); at += piece) {
      const uint32_t left = static_cast<uint32_t>(parts.size()) - at;
      ASSERT_TRUE(snapshot_read(lab.world, at, parts.data() + at, left < piece ? left : piece));
    }
    EXPECT_EQ(memcmp(parts.data(), whole.data(), parts.size()), 0);
  }
  uint8_t byte = 0;
  EXPECT_FALSE(snapshot_read(lab.world, byte_count(whole), &byte, 1));
}

DETENT_TEST(state, the_layout_is_the_same_on_every_target) {
  constexpr Capacity k_capacity = {10, 20, 3};
#if defined(DETENT_FX64)
  EXPECT_EQ(snapshot_bytes(k_capacity), 7264u);
  EXPECT_EQ(world_bytes(k_capacity), 29752u);
#elif defined(DETENT_FX32)
  EXPECT_EQ(snapshot_bytes(k_capacity), 7224u);
  EXPECT_EQ(world_bytes(k_capacity), 29152u);
#elif defined(DETENT_F32)
  EXPECT_EQ(snapshot_bytes(k_capacity), 5464u);
  EXPECT_EQ(world_bytes(k_capacity), 23272u);
#else
  EXPECT_EQ(snapshot_bytes(k_capacity), 8744u);
  EXPECT_EQ(world_bytes(k_capacity), 39312u);
#endif
}

DETENT_TEST(state, assets_are_bound_by_content) {
  alignas(8) static const uint8_t content[] = {1, 2, 3, 4, 5}, other[] = {1, 2, 3, 4, 6};
  Lab lab({1, 1, 2});
  EXPECT_EQ(bind_asset(lab.world, 0), Status::asset_missing);
  const Asset table[] = {{content, sizeof content}, {other, sizeof other}};
  lab.world.assets = {table, 2};
  ASSERT_OK(bind_asset(lab.world, 1));
  EXPECT_EQ(bind_asset(lab.world, 2), Status::out_of_range);
  const std::vector<uint64_t> good = lab.snapshot();
  const auto load_with = [&](AssetTable assets) {
    Lab fresh({1, 1, 2});
    fresh.world.assets = assets;
    std::vector<uint64_t> bytes = good;
    return load(fresh.world, bytes_of(bytes), byte_count(bytes));
  };
  EXPECT_OK(load_with({table, 2}));
  EXPECT_EQ(load_with({table, 1}), Status::asset_missing);
  const Asset swapped[] = {table[1], table[0]};
  EXPECT_EQ(load_with({swapped, 2}), Status::asset_mismatch);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
