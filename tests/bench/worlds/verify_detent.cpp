#include <algorithm>
#include <atomic>

#include "examples/scenes/make.h"
#include "examples/worlds/worlds.h"
#include "tests/bench/worlds/arena.h"
#include "tests/bench/worlds/engine.h"
#include "tests/bench/worlds/watch.h"
#include "threads/thread_pool.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_bench;

namespace {

using MatchBytes = std::vector<uint8_t>;

Status append(void* context, const uint8_t* bytes, uint32_t count) {
  MatchBytes& all = *static_cast<MatchBytes*>(context);
  all.insert(all.end(), bytes, bytes + count);
  return Status::ok;
}

struct Reading {
  const MatchBytes& bytes;
  size_t at = 0;

  static Status read(void* context, uint8_t* bytes, uint32_t count, uint32_t& got) {
    Reading& self = *static_cast<Reading*>(context);
    got = static_cast<uint32_t>(std::min<size_t>(count, self.bytes.size() - self.at));
    std::copy_n(self.bytes.begin() + static_cast<std::ptrdiff_t>(self.at), got, bytes);
    self.at += got;
    return Status::ok;
  }
};

MatchBytes record_match(const WorldsScene& scene, uint64_t seed) {
  MatchBytes bytes;
  uint8_t buffer[k_recording_buffer_bytes];
  Arena arena(scene);
  Recorder recorder(arena.world, {append, &bytes}, buffer, sizeof buffer);
  Arena::build(recorder, scene);
  must(recorder.begin());
  for (uint32_t tick = 0; tick < scene.match_ticks; ++tick) {
    Arena::act(recorder, scene, seed);
    recorder.step();
  }
  must(recorder.end());
  return bytes;
}

/// Whether every tick of the recording agrees. `world`: of its capacity.
bool verify_match(const MatchBytes& bytes, World& world) {
  Reading reading{bytes};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player({Reading::read, &reading}, buffer, sizeof buffer);
  if (player.open() != Status::ok || player.start(world) != Status::ok) return false;
  for (TickResult tick; !tick.finished;) {
    if (player.next_tick(world, tick) != Status::ok) return false;
  }
  return true;
}

}  // namespace

Recordings record_matches(const WorldsScene& scene, uint32_t count) {
  Recordings recordings;
  for (uint32_t i = 0; i < count; ++i) recordings.push_back(record_match(scene, i));
  return recordings;
}

bool verify_matches(const WorldsScene& scene, const Recordings& recordings, uint32_t threads,
                    WorldsVerification& result) {
  detent_host::ThreadPool pool(threads, std::chrono::nanoseconds(0));
  const Tasks tasks = pool.tasks<Tasks>();
  std::vector<Arena> arenas;
  for (uint32_t i = 0; i < tasks.workers; ++i) arenas.emplace_back(scene);
  const uint32_t count = static_cast<uint32_t>(recordings.size());
  std::atomic<uint32_t> good = 0;
  const Watch watch;
  worlds::for_each(tasks, count, [&](uint32_t i, uint32_t worker) {
    good += verify_match(recordings[i], arenas[worker].world) ? 1 : 0;
  });
  result = {threads, count / watch.cpu(), count / watch.wall()};
  return good == count;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
