#include "examples/worlds/worlds.h"

#include <set>
#include <thread>

#include "examples/scenes/scene.h"
#include "examples/worlds/match.h"
#include "tests/unit/world/lab.h"
#include "threads/thread_pool.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using worlds::for_each, worlds::k_common_ticks, worlds::Match, worlds::Snapshot;

constexpr uint32_t k_threads[] = {1, 2, 8};

using Digests = std::vector<uint64_t>;

/// Each match for itself, from its first tick to its last.
Digests played_alone(uint32_t count, uint32_t ticks) {
  Digests digests;
  for (uint32_t i = 0; i < count; ++i) {
    Match match(i);
    match.play(ticks);
    digests.push_back(digest(match.world));
  }
  return digests;
}

Snapshot state_after(uint32_t ticks) {
  Match match(0);
  match.play(ticks);
  return Snapshot(match.world);
}

DETENT_TEST(worlds, are_equal_on_any_number_of_threads) {
  constexpr uint32_t k_count = 100, k_ticks = k_common_ticks + 12;
  const Digests expected = played_alone(k_count, k_ticks);
  EXPECT_GT(std::set<uint64_t>(expected.begin(), expected.end()).size(), k_count * 3 / 4)
      << "the matches hardly differ";
  for (const uint32_t threads : k_threads) {
    detent_host::ThreadPool pool(threads);
    const Tasks tasks = pool.tasks<Tasks>();
    std::vector<Match> matches(k_count);
    for_each(tasks, k_count, [&](uint32_t i, uint32_t) { matches[i] = Match(i); });
    for (uint32_t tick = 0; tick < k_ticks; ++tick) {
      for_each(tasks, k_count, [&](uint32_t i, uint32_t) { matches[i].play(1); });
    }
    for (uint32_t i = 0; i < k_count; ++i) {
      ASSERT_EQ(digest(matches[i].world), expected[i]) << "match " << i << " on " << threads << " threads";
    }
  }
}

DETENT_TEST(worlds, that_begin_from_the_common_state_equal_those_that_simulated_it) {
  constexpr uint32_t k_count = 20, k_ticks = k_common_ticks + 40;
  const Digests expected = played_alone(k_count, k_ticks);
  const Snapshot common = state_after(k_common_ticks);
  for (uint32_t i = 0; i < k_count; ++i) {
    Match match;
    match.seed = i;
    common.restore_to(match.world);
    match.play(k_ticks - k_common_ticks);
    EXPECT_EQ(digest(match.world), expected[i]) << "match " << i;
  }
}

DETENT_TEST(worlds, that_are_kept_as_differences_equal_those_that_stay) {
  constexpr uint32_t k_count = 20, k_turn = 10, k_ticks = k_common_ticks + 4 * k_turn;
  const Digests expected = played_alone(k_count, k_ticks);
  const Snapshot common = state_after(k_common_ticks);
  for (const uint32_t threads : k_threads) {
    detent_host::ThreadPool pool(threads);
    const Tasks tasks = pool.tasks<Tasks>();
    std::vector<Match> matches(tasks.workers);
    common.restore_to(matches[0].world);
    std::vector<std::vector<uint8_t>> kept(k_count, common.difference(matches[0].world));
    EXPECT_EQ(kept[0].size(), 24u) << "of equal states";
    for (uint32_t tick = k_common_ticks; tick < k_ticks; tick += k_turn) {
      for_each(tasks, k_count, [&](uint32_t i, uint32_t worker) {
        Match& match = matches[worker];
        match.seed = i;
        common.restore_to(match.world, kept[i]);
        match.play(k_turn);
        kept[i] = common.difference(match.world);
      });
    }
    for (uint32_t i = 0; i < k_count; ++i) {
      EXPECT_LT(kept[i].size(), common.byte_count() / 2) << "match " << i;
      common.restore_to(matches[0].world, kept[i]);
      EXPECT_EQ(digest(matches[0].world), expected[i]) << "match " << i << " on " << threads << " threads";
    }
  }
}

DETENT_TEST(worlds, are_each_worked_on_once_by_one_worker) {
  constexpr uint32_t k_count = 500;
  for (const uint32_t threads : k_threads) {
    detent_host::ThreadPool pool(threads);
    const Tasks tasks = pool.tasks<Tasks>();
    std::vector<std::atomic<uint32_t>> calls(k_count), busy(tasks.workers);
    std::atomic<uint32_t> shared = 0;
    for_each(tasks, k_count, [&](uint32_t i, uint32_t worker) {
      if (worker >= tasks.workers || busy[worker]++ != 0) ++shared;
      ++calls[i];
      std::this_thread::yield();
      if (worker < tasks.workers) --busy[worker];
    });
    EXPECT_EQ(shared, 0u) << "workers that two calls had at the same time, or that do not exist";
    for (uint32_t i = 0; i < k_count; ++i) ASSERT_EQ(calls[i], 1u) << i;
  }
}

/// Hulls on a height field.
void build_on_hills(Lab& lab, uint32_t seed) {
  lab.world.hooks.assets = scene_assets();
  ASSERT_OK(bind_asset(lab.world, k_asset_hills));
  ASSERT_OK(bind_asset(lab.world, k_asset_round));
  BodyDef hills;
  hills.type = BodyType::fixed;
  hills.shape = terrain(k_asset_hills);
  lab.add(hills);
  BodyDef rock;
  rock.shape = hull(k_asset_round);
  rock.position = position(0.3 * seed - 1, 4, 0.5);
  lab.add(rock);
}

DETENT_TEST(worlds, share_assets) {
  constexpr uint32_t k_count = 8, k_ticks = 90;
  constexpr Capacity k_capacity = {.bodies = 2, .contacts = 16, .assets = 4};
  Digests expected;
  for (uint32_t i = 0; i < k_count; ++i) {
    Lab lab(k_capacity);
    build_on_hills(lab, i);
    lab.run(k_ticks);
    expected.push_back(digest(lab.world));
  }
  EXPECT_EQ(std::set<uint64_t>(expected.begin(), expected.end()).size(), k_count);
  detent_host::ThreadPool pool(4);
  const Tasks tasks = pool.tasks<Tasks>();
  std::vector<std::unique_ptr<Lab>> labs;
  for (uint32_t i = 0; i < k_count; ++i) labs.push_back(std::make_unique<Lab>(k_capacity));
  for (uint32_t i = 0; i < k_count; ++i) build_on_hills(*labs[i], i);
  std::atomic<uint32_t> with_contacts = 0;
  for (uint32_t tick = 0; tick < k_ticks; ++tick) {
    for_each(tasks, k_count, [&](uint32_t i, uint32_t) {
      if (step(labs[i]->world).contacts.count != 0) ++with_contacts;
    });
  }
  EXPECT_GT(with_contacts, k_count) << "no rock touches the hills";
  for (uint32_t i = 0; i < k_count; ++i) EXPECT_EQ(digest(labs[i]->world), expected[i]) << i;
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
