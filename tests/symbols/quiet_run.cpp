#include <detent/recording.h>
#include <string.h>

#include "tests/scenes/scene.h"

// Every kind of call, without the help of any run-time library: a match that creates and destroys bodies, recorded,
// saved, restored and loaded as it goes, then replayed. The exit code says whether the library agreed with itself.

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
    if (tick % k_save_interval == 0 && !save_and_load(world, def)) return false;
  }
  return is_ok(recorder.end());
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
