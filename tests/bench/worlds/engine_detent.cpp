#include "tests/bench/worlds/engine.h"

#include <algorithm>

#include "examples/worlds/worlds.h"
#include "tests/bench/worlds/arena.h"
#include "tests/bench/worlds/watch.h"
#include "tests/campaigns/stress/run_detent.h"
#include "threads/thread_pool.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_bench;

Recordings record_matches(const WorldsScene& scene, uint32_t count);
bool verify_matches(const WorldsScene& scene, const Recordings& recordings, uint32_t threads,
                    WorldsVerification& result);

namespace {

using worlds::Snapshot;

constexpr uint32_t k_samples = 20;  // of what is done to one world
constexpr uint32_t k_choices = 3, k_depth = 4, k_edge_ticks = 8;

/// us, the mean of a number of calls of work(i); `least` becomes it unless that is less.
template <class Work>
void time_calls(double& least, uint32_t count, const Work& work) {
  const Watch watch;
  for (uint32_t i = 0; i < count; ++i) work(i);
  const double us = watch.cpu() * 1e6 / count;
  if (least == 0 || us < least) least = us;
}

Snapshot common_state(const WorldsScene& scene) {
  Arena arena(scene);
  arena.build();
  arena.play(0, k_worlds_settling);
  return Snapshot(arena.world);
}

/// The worlds of a row of WorldsSteps.
class Play {
 public:
  Play(const WorldsScene& scene, const Snapshot& common, uint32_t worlds, const Tasks& tasks)
      : scene_(scene), common_(common), tasks_(tasks), digests_(worlds) {}

  /// One world for each thread, which plays one match after the other.
  void one_by_one() {
    make_room(tasks_.workers);
    each(worlds(), [this](uint32_t i, uint32_t worker) {
      common_.restore_to(arenas_[worker].world);
      arenas_[worker].play(i, scene_.ticks);
      digests_[i] = digest(arenas_[worker].world);
    });
  }
  /// So many worlds at the same time: a tick of each, then the next tick of each.
  void together(uint32_t alive) {
    make_room(alive);
    for (uint32_t first = 0; first < worlds(); first += alive) {
      const uint32_t count = std::min(alive, worlds() - first);
      each(count, [&](uint32_t i, uint32_t) { common_.restore_to(arenas_[i].world); });
      for (uint32_t tick = 0; tick < scene_.ticks; ++tick) {
        each(count, [&](uint32_t i, uint32_t) { arenas_[i].play(first + i, 1); });
      }
      each(count, [&](uint32_t i, uint32_t) { digests_[first + i] = digest(arenas_[i].world); });
    }
  }
  const std::vector<uint64_t>& digests() const { return digests_; }

 private:
  uint32_t worlds() const { return static_cast<uint32_t>(digests_.size()); }
  void make_room(uint32_t alive) {
    while (arenas_.size() < alive) arenas_.emplace_back(scene_);
  }
  template <class Work>
  void each(uint32_t count, const Work& work) {
    worlds::for_each(tasks_, count, work);
  }

  const WorldsScene& scene_;
  const Snapshot& common_;
  const Tasks& tasks_;
  std::vector<Arena> arenas_;
  std::vector<uint64_t> digests_;
};

/// One repetition.
void measure_steps(const WorldsScene& scene, const WorldsEffort& effort, const Snapshot& common,
                   std::vector<uint64_t>& expected, WorldsRow& row) {
  const double ticks = static_cast<double>(uint64_t{effort.worlds} * scene.ticks);
  for (WorldsSteps& steps : row.steps) {
    // A thread that waits sleeps at once, so that only work counts as the processor's time.
    detent_host::ThreadPool pool(steps.threads, std::chrono::nanoseconds(0));
    const Tasks tasks = pool.tasks<Tasks>();
    Play play(scene, common, effort.worlds, tasks);
    const Watch watch;
    steps.alive == 1 ? play.one_by_one() : play.together(steps.alive);
    steps.ticks_per_cpu_second = std::max(steps.ticks_per_cpu_second, ticks / watch.cpu());
    steps.ticks_per_second = std::max(steps.ticks_per_second, ticks / watch.wall());
    if (expected.empty()) expected = play.digests();
    row.same = row.same && play.digests() == expected;
  }
}

void measure_common_start(const WorldsScene& scene, const Snapshot& common, WorldsRow& row) {
  std::vector<Arena> arenas;
  time_calls(row.create, k_samples, [&](uint32_t) {
    arenas.emplace_back(scene);
    arenas.back().build();
  });
  time_calls(row.simulate, k_samples, [&](uint32_t i) { arenas[i].play(i, k_worlds_settling); });
  const uint64_t expected = digest(arenas[0].world);
  time_calls(row.restore, k_samples, [&](uint32_t i) { common.restore_to(arenas[i].world); });
  for (const Arena& arena : arenas) row.same = row.same && digest(arena.world) == expected;
}

void measure_differences(const WorldsScene& scene, const Snapshot& common, WorldsRow& row) {
  std::vector<Arena> arenas;
  std::vector<uint64_t> digests;
  uint64_t awake = 0;
  for (uint32_t i = 0; i < k_samples; ++i) {
    arenas.emplace_back(scene);
    common.restore_to(arenas[i].world);
    awake += arenas[i].play(i, k_worlds_settling);
    digests.push_back(digest(arenas[i].world));
  }
  std::vector<std::vector<uint8_t>> differences(k_samples);
  time_calls(row.difference, k_samples, [&](uint32_t i) { differences[i] = common.difference(arenas[i].world); });
  time_calls(row.undo, k_samples, [&](uint32_t i) { common.restore_to(arenas[0].world, differences[i]); });
  size_t bytes = 0;
  for (uint32_t i = 0; i < k_samples; ++i) {
    bytes += differences[i].size();
    common.restore_to(arenas[0].world, differences[i]);
    row.same = row.same && digest(arenas[0].world) == digests[i];
  }
  row.awake = static_cast<double>(awake) / (k_samples * k_worlds_settling);
  row.difference_bytes = static_cast<uint32_t>(bytes / k_samples);
}

/// A tree of inputs, as a search or training makes it: at each node, each choice is played for some ticks.
class Tree {
 public:
  Tree(const WorldsScene& scene, const Snapshot& root) : arena_(scene), root_(root) {}

  /// Each edge once: a node's state is restored for each of its choices.
  void by_branching() { visit(root_, 0, 1); }
  /// Each leaf for itself.
  void from_root() {
    uint32_t leaves = 1;
    for (uint32_t i = 0; i < k_depth; ++i) leaves *= k_choices;
    for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
      root_.restore_to(arena_.world);
      uint64_t path = 1;
      for (uint32_t depth = 0, part = leaves / k_choices; depth < k_depth; ++depth, part /= k_choices) {
        path = path * k_choices + leaf / part % k_choices;
        arena_.play(path, k_edge_ticks);
      }
      leaves_.add(arena_.world);
    }
  }
  uint64_t digest_of_leaves() const { return leaves_.value(); }

 private:
  void visit(const Snapshot& node, uint32_t depth, uint64_t path) {
    for (uint32_t choice = 0; choice < k_choices; ++choice) {
      node.restore_to(arena_.world);
      const uint64_t next = path * k_choices + choice;
      arena_.play(next, k_edge_ticks);
      if (depth + 1 == k_depth) {
        leaves_.add(arena_.world);
      } else {
        visit(Snapshot(arena_.world), depth + 1, next);
      }
    }
  }

  Arena arena_;
  const Snapshot& root_;
  worlds::DigestOfAll leaves_;
};

void measure_tree(const WorldsScene& scene, const Snapshot& common, WorldsRow& row) {
  Tree branched(scene, common), repeated(scene, common);
  time_calls(row.tree, 1, [&](uint32_t) { branched.by_branching(); });
  time_calls(row.tree_from_root, 1, [&](uint32_t) { repeated.from_root(); });
  row.same = row.same && branched.digest_of_leaves() == repeated.digest_of_leaves();
}

WorldsRow measure(const WorldsScene& scene, const WorldsEffort& effort) {
  WorldsRow row;
  row.config = stress_engine().config;
  row.scene = scene.name;
  row.bodies = scene.bodies;
  row.world_bytes = world_bytes(Arena::capacity(scene));
  row.snapshot_bytes = snapshot_bytes(Arena::capacity(scene));
  const Snapshot common = common_state(scene);
  for (const uint32_t threads : effort.threads) {
    for (const uint32_t alive : effort.alive) row.steps.push_back({alive, threads});
  }
  std::vector<uint64_t> expected;
  for (uint32_t i = 0; i < effort.repetitions; ++i) {
    measure_common_start(scene, common, row);
    measure_differences(scene, common, row);
    measure_tree(scene, common, row);
    measure_steps(scene, effort, common, expected, row);
  }
  return row;
}

}  // namespace

/// Adds this configuration to those of the benchmark of many worlds.
void add_worlds_engine(WorldsEngineList& engines) {
  engines.push_back({stress_engine().config, measure, record_matches, verify_matches});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
