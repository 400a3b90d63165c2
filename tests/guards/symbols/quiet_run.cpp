#include <detent/recording.h>
#include <detent/rollback.h>
#include <string.h>

#include "examples/scenes/scene.h"

// Every kind of call, without the help of any run-time library: a match that creates and destroys bodies, recorded,
// saved, restored and loaded as it goes, then replayed; and a session that goes back. The exit code says whether the
// library agreed with itself.

void forbid_allocation();  // forbidden.cpp.in
extern "C" void* malloc(size_t byte_count);

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_ticks = 100;
constexpr uint32_t k_save_interval = 10;

alignas(8) uint8_t block[1u << 17];
alignas(8) uint8_t block_loaded[1u << 17];
alignas(8) uint8_t snapshot[1u << 16];
alignas(8) uint8_t memory[1u << 20];
uint8_t delta[1u << 16];

/// A recording in memory.
struct Tape {
  uint8_t bytes[1u << 17];
  uint32_t written = 0;
  uint32_t read = 0;
};
Tape tape;

Status write_tape(void*, const uint8_t* bytes, uint32_t count) {
  if (count > sizeof tape.bytes - tape.written) return Status::buffer_too_small;
  memcpy(tape.bytes + tape.written, bytes, count);
  tape.written += count;
  return Status::ok;
}

Status read_tape(void*, uint8_t* bytes, uint32_t count, uint32_t& got) {
  got = count < tape.written - tape.read ? count : tape.written - tape.read;
  memcpy(bytes, tape.bytes + tape.read, got);
  tape.read += got;
  return Status::ok;
}

bool is_ok(Status status) { return status == Status::ok; }

/// Saves the world, restores it in place and loads it into another block; nothing may change.
bool save_and_load(World& world, const WorldDef& def) {
  const uint64_t before = digest(world);
  const uint32_t bytes = snapshot_bytes(def.capacity);
  World loaded;
  return is_ok(save(world, snapshot, sizeof snapshot)) && is_ok(restore(world, snapshot, bytes)) &&
         digest(world) == before && is_ok(create_world(block_loaded, sizeof block_loaded, def, {}, loaded)) &&
         is_ok(load(loaded, snapshot, bytes)) && digest(loaded) == before;
}

/// The world and its own differences, copies and last ticks; nothing may change.
bool go_back(World& world, const WorldDef& def) {
  const uint64_t before = digest(world), tick = get_info(world).tick;
  const uint32_t bytes = snapshot_bytes(def.capacity);
  uint32_t delta_bytes = 0;
  World copied;
  SnapshotRing ring;
  if (!is_ok(create_world(block_loaded, sizeof block_loaded, def, {}, copied)) || !is_ok(copy_world(world, copied)) ||
      checksum32(copied) != checksum32(world) || !is_ok(save(world, snapshot, sizeof snapshot)) ||
      !is_ok(ring.begin(memory, sizeof memory, def.capacity, 2)) || !is_ok(ring.keep(world)))
    return false;
  step(world);
  const uint64_t after = digest(world);
  if (!is_ok(save_delta(world, snapshot, bytes, delta, sizeof delta, delta_bytes)) ||
      !is_ok(ring.restore(world, tick)) || digest(world) != before ||
      !is_ok(restore_delta(world, snapshot, bytes, delta, delta_bytes)) || digest(world) != after ||
      !is_ok(apply_delta(snapshot, bytes, delta, delta_bytes)))
    return false;
  return is_ok(ring.restore(world, tick)) && digest(world) == before;
}

void make_tick(void*, World& world, const TickInputs& inputs) {
  const Scaled up = inputs.of(1)[0] == 0 ? Scaled(0.0) : Scaled(50.0);
  (void)apply_impulse(world, next_body(world, {}), {Scaled(0.0), up, Scaled(0.0)});
  step(world);
}

/// A player whose other's inputs come late and are not as predicted.
bool play(World& world) {
  RollbackDef def;
  RollbackSession session;
  if (!is_ok(session.begin(world, def, {make_tick, nullptr}, memory, sizeof memory))) return false;
  const uint64_t start = get_info(world).tick;
  RollbackReport report;
  uint32_t again = 0;
  for (uint32_t i = 0; i < 30; ++i) {
    const uint8_t own = 0, other = i % 5 == 0 ? 1 : 0;
    uint64_t tick = 0;
    if (!is_ok(session.add_local_input(0, &own, tick)) || !is_ok(session.advance(world, report))) return false;
    again += report.ticks_again;
    if (i >= 5 && !is_ok(session.add_input(1, start + i - 5, &other))) return false;
  }
  const uint8_t input = 0;
  SyncTestReport difference;
  const SyncTestDef test = {1, &input, 1, 1};
  const TickMaker maker = {[](void*, World& stepped, const TickInputs&) { step(stepped); }, nullptr};
  return again != 0 && is_ok(sync_test(world, test, maker, memory, sizeof memory, {}, difference));
}

bool record(const Scene& scene) {
  const WorldDef def = scene.world();
  World world;
  uint8_t buffer[k_recording_buffer_bytes];
  if (!is_ok(create_world(block, sizeof block, def, {}, world))) return false;
  Recorder recorder(world, {write_tape, nullptr}, buffer, sizeof buffer);
  scene.build(recorder);
  if (!is_ok(recorder.begin())) return false;
  for (uint32_t tick = 0; tick < k_ticks; ++tick) {
    if (scene.before_tick != nullptr) scene.before_tick(recorder, tick);
    if (!recorder.step().complete()) return false;
    if (tick % k_save_interval == 0 && (!save_and_load(world, def) || !go_back(world, def))) return false;
  }
  return is_ok(recorder.end()) && play(world);
}

bool replay() {
  World world;
  WorldDef def;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player({read_tape, nullptr}, buffer, sizeof buffer);
  if (!is_ok(player.open())) return false;
  def.capacity = player.info().capacity;
  if (!is_ok(create_world(block, sizeof block, def, {}, world)) || !is_ok(player.start(world))) return false;
  TickResult result;
  while (!result.finished) {
    if (!is_ok(player.next_tick(world, result))) return false;
  }
  return result.tick == k_ticks;
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent

int main(int argc, char**) {
  forbid_allocation();
  void* (*volatile allocate)(size_t) = malloc;  // volatile, or a compiler that knows malloc would leave it out
  if (argc > 1) return allocate(1) == nullptr;
  const detent::Scene* const scene = detent::find_scene("traffic");
  return scene != nullptr && detent::record(*scene) && detent::replay() ? 0 : 1;
}
