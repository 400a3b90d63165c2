#pragma once
#include <detent/recording.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "examples/scenes/scene.h"
#include "tests/common/support/test.h"

/// Recordings in memory, how to make them, and how to take them apart.
namespace detent {
inline namespace DETENT_NAMESPACE {

using Bytes = std::vector<uint8_t>;

/// A sink that stores the bytes it gets, and fails from its `writes_max`-th write on.
struct MemorySink {
  Bytes bytes;
  uint32_t writes = 0;
  uint32_t writes_max = ~0u;

  Sink sink() { return {write, this}; }
  static Status write(void* context, const uint8_t* bytes, uint32_t count) {
    MemorySink& self = *static_cast<MemorySink*>(context);
    if (self.writes++ >= self.writes_max) return Status::sink_failed;
    self.bytes.insert(self.bytes.end(), bytes, bytes + count);
    return Status::ok;
  }
};

struct MemorySource {
  const Bytes* bytes;
  size_t at = 0;
  uint64_t given = 0;  ///< bytes, in all

  Source source() { return {read, this, nullptr}; }
  Source seekable_source() { return {read, this, seek}; }
  static Status seek(void* context, uint64_t offset) {
    MemorySource& self = *static_cast<MemorySource*>(context);
    self.at = offset < self.bytes->size() ? static_cast<size_t>(offset) : self.bytes->size();
    return Status::ok;
  }
  static Status read(void* context, uint8_t* bytes, uint32_t count, uint32_t& got) {
    MemorySource& self = *static_cast<MemorySource*>(context);
    const size_t left = self.bytes->size() - self.at;
    got = left < count ? static_cast<uint32_t>(left) : count;
    std::copy_n(self.bytes->begin() + static_cast<std::ptrdiff_t>(self.at), got, bytes);
    self.at += got;
    self.given += got;
    return Status::ok;
  }
};

/// A world and its memory.
struct OwnedWorld {
  std::unique_ptr<uint64_t[]> block;
  World world;

  explicit OwnedWorld(const WorldDef& def, AssetTable assets = scene_assets()) {
    const uint32_t bytes = world_bytes(def.capacity);
    block.reset(new uint64_t[(bytes + 7) / 8]());
    EXPECT_EQ(create_world(reinterpret_cast<uint8_t*>(block.get()), bytes, def, {.assets = assets}, world), Status::ok);
  }
  explicit OwnedWorld(Capacity capacity) : OwnedWorld(def_of(capacity)) {}
  static WorldDef def_of(Capacity capacity) {
    WorldDef def;
    def.capacity = capacity;
    return def;
  }
};

/// A recorder on a new world of the scene, over a sink in memory.
struct Recording {
  MemorySink memory;
  OwnedWorld owned;
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder;

  explicit Recording(const WorldDef& def, bool recorded = true)
      : owned(def), recorder(owned.world, recorded ? memory.sink() : Sink{}, buffer, sizeof buffer) {}
};

inline void play_scene(Recorder& recorder, const Scene& scene, uint32_t ticks) {
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    if (scene.before_tick != nullptr) scene.before_tick(recorder, tick);
    recorder.step();
  }
}

inline Bytes record_scene(const Scene& scene, uint32_t ticks, const RecordingDef& def = {}) {
  Recording recording(scene.world());
  scene.build(recording.recorder);
  EXPECT_EQ(recording.recorder.begin(def), Status::ok);
  play_scene(recording.recorder, scene, ticks);
  EXPECT_EQ(recording.recorder.end(), Status::ok);
  return recording.memory.bytes;
}

/// A small recording: two balls on a half-space that meet within `ticks`.
inline Bytes record_small(uint32_t ticks, const RecordingDef& def = {}) {
  Recording recording(OwnedWorld::def_of({3, 3, 0}));
  Recorder& recorder = recording.recorder;
  BodyId id;
  BodyDef body;
  body.type = BodyType::fixed;
  body.shape = half_space();
  EXPECT_EQ(recorder.create_body(body, id), Status::ok);
  EXPECT_EQ(recorder.begin(def), Status::ok);
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    if (tick < 2) {
      body = {};
      body.position.y = tick == 0 ? Coord(0.5) : Coord(1.5);
      EXPECT_EQ(recorder.create_body(body, id), Status::ok);
    }
    recorder.step();
  }
  EXPECT_EQ(recorder.set_user_data(id, 7), Status::ok);  // after the last tick: only the final digest covers it
  EXPECT_EQ(recorder.end(), Status::ok);
  return recording.memory.bytes;
}

struct Replay {
  ReplayError error;
  uint64_t ticks = 0;
  uint64_t compared = 0;
  uint64_t digest = 0;
  bool finished = false;
};

/// Replays until the end or the first error. `meddle` is called before each tick.
inline Replay replay(const Bytes& bytes, const std::function<void(World&, uint64_t)>& meddle = {}) {
  MemorySource memory{&bytes};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(memory.source(), buffer, sizeof buffer);
  Replay outcome;
  if (player.open() == Status::ok) {
    OwnedWorld owned(player.info().capacity);
    Status status = player.start(owned.world);
    while (status == Status::ok && !outcome.finished) {
      TickResult result;
      if (meddle) meddle(owned.world, outcome.ticks);
      status = player.next_tick(owned.world, result);
      if (status != Status::ok) break;
      outcome.finished = result.finished;
      if (result.finished)
        outcome.digest = result.digest;
      else {
        ++outcome.ticks;
        outcome.compared += result.compared ? 1 : 0;
      }
    }
  }
  outcome.error = player.error();
  return outcome;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
