#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "examples/rollback/game.h"
#include "examples/worlds/match.h"
#include "examples/worlds/worlds.h"
#include "threads/thread_pool.h"

using namespace detent;
using worlds::for_each, worlds::k_common_ticks, worlds::Match, worlds::Snapshot;

namespace {

constexpr size_t k_world_bytes = world_bytes(pitch::k_capacity);

struct Options {
  uint32_t worlds = 1000;
  uint32_t ticks = 180;  ///< of a match
  uint32_t threads = 0;  ///< 0: as many as the machine has processors
};

bool read(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; i += 2) {
    uint32_t* const option = strcmp(argv[i], "--worlds") == 0    ? &options.worlds
                             : strcmp(argv[i], "--ticks") == 0   ? &options.ticks
                             : strcmp(argv[i], "--threads") == 0 ? &options.threads
                                                                 : nullptr;
    if (option == nullptr || i + 1 == argc) return false;
    *option = static_cast<uint32_t>(strtoul(argv[i + 1], nullptr, 10));
  }
  return options.worlds >= 1 && options.worlds <= 100000 && options.ticks > k_common_ticks && options.ticks <= 100000 &&
         options.threads <= 256;
}

/// What a way to play the matches has used, and the digest of the states that it has reached.
struct Result {
  uint64_t ticks;  ///< simulated, of all worlds
  size_t bytes;    ///< of all worlds and of the states that were kept
  uint64_t digest;
};

uint64_t digest_of(const std::vector<Match>& matches) {
  worlds::DigestOfAll digest;
  for (const Match& match : matches) digest.add(match.world);
  return digest.value();
}

/// Every match from its first tick on.
Result play_from_start(const Options& options, const Tasks& tasks) {
  std::vector<Match> matches(options.worlds);
  for_each(tasks, options.worlds, [&](uint32_t i, uint32_t) { matches[i] = Match(i); });
  for (uint32_t tick = 0; tick < options.ticks; ++tick) {
    for_each(tasks, options.worlds, [&](uint32_t i, uint32_t) { matches[i].play(1); });
  }
  return {uint64_t{options.worlds} * options.ticks, options.worlds * k_world_bytes, digest_of(matches)};
}

/// The ticks in which all matches are equal, simulated once.
Snapshot common_state() {
  Match match(0);
  match.play(k_common_ticks);
  return Snapshot(match.world);
}

/// Every match from the common state on.
Result play_from_common_state(const Options& options, const Tasks& tasks) {
  const Snapshot common = common_state();
  std::vector<Match> matches(options.worlds);
  for_each(tasks, options.worlds, [&](uint32_t i, uint32_t) {
    matches[i].seed = i;
    common.restore_to(matches[i].world);
  });
  for (uint32_t tick = k_common_ticks; tick < options.ticks; ++tick) {
    for_each(tasks, options.worlds, [&](uint32_t i, uint32_t) { matches[i].play(1); });
  }
  return {k_common_ticks + uint64_t{options.worlds} * (options.ticks - k_common_ticks), options.worlds * k_world_bytes,
          digest_of(matches)};
}

/// The same with one world for each thread. Of each match only its difference from the common state is kept.
Result play_kept_as_differences(const Options& options, const Tasks& tasks) {
  constexpr uint32_t k_turn = 30;  // ticks that a match plays before the next one has its turn
  const Snapshot common = common_state();
  std::vector<Match> matches(tasks.workers);
  common.restore_to(matches[0].world);
  std::vector<std::vector<uint8_t>> kept(options.worlds, common.difference(matches[0].world));
  for (uint32_t tick = k_common_ticks; tick < options.ticks; tick += k_turn) {
    for_each(tasks, options.worlds, [&](uint32_t i, uint32_t worker) {
      Match& match = matches[worker];
      match.seed = i;
      common.restore_to(match.world, kept[i]);
      match.play(std::min(k_turn, options.ticks - tick));
      kept[i] = common.difference(match.world);
    });
  }
  size_t bytes = tasks.workers * k_world_bytes + common.byte_count();
  worlds::DigestOfAll digest;
  for (const std::vector<uint8_t>& difference : kept) {
    bytes += difference.size();
    common.restore_to(matches[0].world, difference);
    digest.add(matches[0].world);
  }
  return {k_common_ticks + uint64_t{options.worlds} * (options.ticks - k_common_ticks), bytes, digest.value()};
}

using Play = Result (*)(const Options&, const Tasks&);

/// Plays all matches, and prints a line. Returns the digest.
uint64_t run(const char* name, Play play, const Options& options, const Tasks& tasks) {
  const auto start = std::chrono::steady_clock::now();
  const Result result = play(options, tasks);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const double core_seconds =
      seconds.count() * std::min(tasks.workers, std::max(1u, std::thread::hardware_concurrency()));
  printf("%-28s %7.2f %18.0f %16.0f %9.1f  %016" PRIx64 "\n", name, seconds.count(), options.worlds / core_seconds,
         static_cast<double>(result.ticks) / core_seconds, static_cast<double>(result.bytes) / options.worlds / 1e3,
         result.digest);
  return result.digest;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!read(argc, argv, options)) {
    fprintf(stderr, "usage: %s [--worlds N] [--ticks N, more than %" PRIu32 "] [--threads N]\n", argv[0],
            k_common_ticks);
    return 2;
  }
  detent_host::ThreadPool pool(options.threads);
  const Tasks tasks = pool.tasks<Tasks>();
  printf("%" PRIu32 " matches of %" PRIu32 " ticks, %" PRIu32 " threads\n", options.worlds, options.ticks,
         tasks.workers);
  printf("%-28s %7s %18s %16s %9s  %s\n", "", "seconds", "matches/s and core", "ticks/s and core", "KB/match",
         "digest of all");
  const uint64_t digest = run("from the start", play_from_start, options, tasks);
  const bool same = run("from a common state", play_from_common_state, options, tasks) == digest &&
                    run("kept as differences from it", play_kept_as_differences, options, tasks) == digest;
  if (!same) fprintf(stderr, "the digests differ\n");
  return same ? 0 : 1;
}
