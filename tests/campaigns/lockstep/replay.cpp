#include <detent/detail/layout.h>
#include <detent/recording.h>
#include <ports/config_text.h>
#include <ports/machine.h>
#include <ports/print.h>
#include <string.h>

#include "examples/scenes/scene.h"
#include "state/snapshot.h"

/// Replays a recording on any target, including microcontrollers: no allocation, no C library beyond memcpy and strcmp.
///
///   replay FILE [--each] [--memory] [--save-at TICK OUT] [--load-at TICK IN]
///
/// --each prints every tick's digest. --save-at writes the state after TICK ticks of the world. --load-at starts from
/// such a state, of this or another machine, instead of the seed. Exit code 0 only if every tick agrees, 1 if not, 2
/// for wrong usage.

#if !defined(DETENT_REPLAY_BLOCK)
#define DETENT_REPLAY_BLOCK \
  (4u << 20)  ///< bytes for the world: an upper bound on the recordings that this machine replays
#endif

namespace {

using namespace detent;

constexpr int k_exit_good = 0;
constexpr int k_exit_bad = 1;
constexpr int k_exit_usage = 2;

alignas(8) uint8_t block[DETENT_REPLAY_BLOCK];
uint8_t buffer[k_recording_buffer_bytes];

struct Options {
  const char* recording = nullptr;
  bool each = false;
  bool memory = false;
  const char* save_path = nullptr;
  uint64_t save_tick = 0;
  const char* load_path = nullptr;
  uint64_t load_tick = 0;
};

bool parse_tick(const char* text, uint64_t& tick) {
  tick = 0;
  for (const char* digit = text; *digit != '\0'; ++digit) {
    if (*digit < '0' || *digit > '9' || tick > 0xffffffff) return false;
    tick = tick * 10 + static_cast<uint64_t>(*digit - '0');
  }
  return *text != '\0';
}

bool parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const char* argument = argv[i];
    const bool save = strcmp(argument, "--save-at") == 0;
    const bool load = strcmp(argument, "--load-at") == 0;
    if (save || load) {
      if (i + 2 >= argc || !parse_tick(argv[i + 1], save ? options.save_tick : options.load_tick)) return false;
      (save ? options.save_path : options.load_path) = argv[i + 2];
      i += 2;
    } else if (strcmp(argument, "--each") == 0) {
      options.each = true;
    } else if (strcmp(argument, "--memory") == 0) {
      options.memory = true;
    } else if (argument[0] == '-' || options.recording != nullptr) {
      return false;
    } else {
      options.recording = argument;
    }
  }
  return options.recording != nullptr;
}

void print_value(const char* name, uint64_t value) {
  machine_print(name);
  print_decimal(value);
  machine_print("\n");
}

int fail(const char* path, const char* problem) {
  machine_print(path);
  machine_print(": ");
  machine_print(problem);
  machine_print("\n");
  return k_exit_bad;
}

int fail(const char* path, const ReplayError& error) {
  machine_print(path);
  machine_print(": ");
  machine_print(status_text(error.status));
  machine_print(" at byte ");
  print_decimal(error.offset);
  machine_print(", tick ");
  print_decimal(error.tick);
  machine_print(": ");
  machine_print(error.field);
  if (error.digest_recorded != error.digest_replayed) {
    machine_print(" (recorded ");
    print_hex(error.digest_recorded, 16);
    machine_print(", here ");
    print_hex(error.digest_replayed, 16);
    machine_print(")");
  }
  machine_print("\n");
  return k_exit_bad;
}

Status read_next(void* file, uint8_t* bytes, uint32_t count, uint32_t& got) {
  got = machine_read(*static_cast<MachineFile*>(file), bytes, count);
  return Status::ok;
}

Status read_at(void* file, uint32_t offset, uint8_t* bytes, uint32_t count) {
  MachineFile& source = *static_cast<MachineFile*>(file);
  if (!machine_seek(source, offset)) return Status::sink_failed;
  return machine_read(source, bytes, count) == count ? Status::ok : Status::truncated;
}

/// Saves in pieces: the whole snapshot need not fit beside the world.
bool save_state(const World& world, const char* path) {
  MachineFile file = machine_open(path, MachineMode::write);
  if (!file.is_open()) return false;
  const uint32_t bytes = snapshot_bytes(get_info(world).capacity);
  uint8_t piece[64];
  bool good = true;
  for (uint32_t offset = 0; offset < bytes && good;) {
    const uint32_t count = bytes - offset < sizeof piece ? bytes - offset : static_cast<uint32_t>(sizeof piece);
    good = snapshot_read(world, offset, piece, count) && machine_write(file, piece, count) == count;
    offset += count;
  }
  return machine_close(file) && good;
}

Status load_state(World& world, const char* path) {
  MachineFile file = machine_open(path, MachineMode::read);
  if (!file.is_open()) return Status::sink_failed;
  Status status = load_from(world, read_at, &file);
  if (status == Status::ok &&
      machine_file_bytes(file) != static_cast<int32_t>(snapshot_bytes(get_info(world).capacity))) {
    status = Status::corrupt;
  }
  machine_close(file);
  return status;
}

int replay(const Options& options, MachineFile& file) {
  Player player({read_next, &file}, buffer, sizeof buffer);
  if (player.open() != Status::ok) return fail(options.recording, player.error());
  const RecordingInfo& info = player.info();
  machine_print("config ");
  machine_print(config_text(k_config));
  machine_print("\n");
  WorldDef def;
  def.capacity = info.capacity;
  World world;
  bool fits = false;
  print_value("world ", layout_of<false>(info.capacity, fits).bytes);  // of targets without lanes
  if (world_bytes(info.capacity) > sizeof block)
    return fail(options.recording, "its world is larger than this program's");
  const Status created = create_world(block, sizeof block, def, {.assets = scene_assets()}, world);
  if (created != Status::ok) return fail(options.recording, status_text(created));

  if (options.load_path != nullptr) {
    const Status loaded = load_state(world, options.load_path);
    if (loaded != Status::ok) return fail(options.load_path, status_text(loaded));
    if (get_info(world).tick != options.load_tick) return fail(options.load_path, "of another tick");
    if (player.start_at(world) != Status::ok) return fail(options.recording, player.error());
  } else if (player.start(world) != Status::ok) {
    return fail(options.recording, player.error());
  }

  uint64_t ticks = 0;
  uint64_t digests = 0;
  uint32_t contacts_max = 0;
  bool saved = options.save_path == nullptr;
  TickResult result;
  for (;; ++ticks) {
    // Before the calls of the next tick: this is the state after exactly save_tick ticks.
    if (!saved && get_info(world).tick == options.save_tick) {
      if (!save_state(world, options.save_path)) return fail(options.save_path, "cannot be written");
      saved = true;
    }
    if (player.next_tick(world, result) != Status::ok) {
      print_value("ticks ", ticks);
      return fail(options.recording, player.error());
    }
    if (result.finished) break;
    digests += result.compared ? 1 : 0;
    if (result.report.contacts.count > contacts_max) contacts_max = result.report.contacts.count;
    if (options.each) {
      machine_print("tick ");
      print_decimal(result.tick);
      machine_print(" ");
      print_hex(result.compared ? result.digest : digest(world), 16);
      machine_print("\n");
    }
  }
  if (!saved) return fail(options.save_path, "the recording does not pass this tick");
  print_value("ticks ", ticks);
  print_value("equal ", digests);
  print_value("contacts_max ", contacts_max);
  machine_print("digest ");
  print_hex(result.digest, 16);
  machine_print("\n");
  return k_exit_good;
}

void print_memory() {
  const MachineMemory memory = machine_memory();
  print_value("flash ", memory.flash_bytes);
  print_value("ram ", memory.ram_bytes);
  print_value("block ", sizeof block);
  print_value("stack ", memory.stack_bytes);
  print_value("stack_used ", machine_stack_used());
}

}  // namespace

int machine_main(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) {
    machine_print("usage: replay FILE [--each] [--memory] [--save-at TICK OUT] [--load-at TICK IN]\n");
    return k_exit_usage;
  }
  MachineFile file = machine_open(options.recording, MachineMode::read);
  if (!file.is_open()) return fail(options.recording, "cannot be opened");
  const int code = replay(options, file);
  machine_close(file);
  if (options.memory) print_memory();
  return code;
}
