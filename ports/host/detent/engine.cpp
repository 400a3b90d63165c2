#include "engine.h"

#include <detent/recording.h>

#include <chrono>
#include <new>

#include "file.h"
#include "ports/config_text.h"
#include "tests/scenes/scene.h"
#include "text.h"

#define DETENT_TOOL_TEXT_OF(name) #name
#define DETENT_TOOL_TEXT(name) DETENT_TOOL_TEXT_OF(name)

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_tool;

constexpr uint32_t k_ticks_per_progress = 16;

struct Stopwatch {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
};

/// A world in memory of its own; `block` is null if there is not enough.
struct OwnedWorld {
  std::unique_ptr<uint64_t[]> block;
  World world;

  Status create(const WorldDef& def, const AssetTable& assets) {
    const uint32_t bytes = world_bytes(def.capacity);
    if (bytes == 0) return Status::out_of_range;
    block.reset(new (std::nothrow) uint64_t[(bytes + 7) / 8]);
    if (block == nullptr) return Status::buffer_too_small;
    return create_world(reinterpret_cast<uint8_t*>(block.get()), bytes, def, assets, world);
  }
};

Outcome failed(const std::string& problem) {
  Outcome outcome;
  outcome.verdict = Verdict::bad;
  outcome.problem = outcome.status = problem;
  return outcome;
}

void take_header(Outcome& outcome, const RecordingInfo& info) {
  outcome.header_known = info.snapshot_bytes != 0;
  outcome.header = {config_text(info.config),
                    info.format_version,
                    info.simulation_version,
                    info.capacity.bodies,
                    info.capacity.contacts,
                    info.capacity.assets,
                    static_cast<uint32_t>(info.trace_level),
                    info.digest_interval,
                    info.tick,
                    info.snapshot_bytes};
}

void take_error(Outcome& outcome, const ReplayError& error) {
  const Status status = error.status;
  const bool refused =
      status == Status::simulation_differs || status == Status::config_differs || status == Status::format_unknown;
  outcome.verdict = refused ? Verdict::refused : Verdict::bad;
  outcome.other_config = status == Status::config_differs;
  outcome.status = status_text(status);
  outcome.field = error.field;
  outcome.offset = error.offset;
  outcome.tick = error.tick;
  outcome.problem = outcome.status + " at byte " + std::to_string(error.offset) + ", tick " +
                    std::to_string(error.tick) + ": " + error.field;
  if (error.digest_recorded != error.digest_replayed) {
    outcome.problem +=
        " (recorded " + hexadecimal(error.digest_recorded) + ", here " + hexadecimal(error.digest_replayed) + ")";
  }
}

Status read_file(void* file, uint8_t* bytes, uint32_t count, uint32_t& got) {
  got = static_cast<uint32_t>(fread(bytes, 1, count, static_cast<FILE*>(file)));
  return got < count && ferror(static_cast<FILE*>(file)) != 0 ? Status::sink_failed : Status::ok;
}

Status write_file(void* file, const uint8_t* bytes, uint32_t count) {
  return fwrite(bytes, 1, count, static_cast<FILE*>(file)) == count ? Status::ok : Status::sink_failed;
}

/// Reads the recording to its end, with a world or without.
Outcome read_recording(const std::string& path, bool with_world, const Assets& assets, const Progress& progress) {
  const File file = open_file(path, "rb");
  if (file == nullptr) return failed("cannot be opened");
  Outcome outcome;
  outcome.file_bytes = file_bytes(path);
  uint8_t buffer[k_recording_buffer_bytes];
  Player player({read_file, file.get()}, buffer, sizeof buffer);
  Status status = player.open();
  take_header(outcome, player.info());

  OwnedWorld owned;
  std::vector<Asset> table;
  if (status == Status::ok && with_world) {
    // A hostile header could ask for gigabytes: the seed is as large as the capacity says, so a small file can't.
    if (outcome.file_bytes < player.info().snapshot_bytes) {
      outcome.verdict = Verdict::bad;
      outcome.status = status_text(Status::truncated);
      outcome.problem = "truncated: the file is smaller than its seed snapshot";
      return outcome;
    }
    WorldDef def;
    def.capacity = player.info().capacity;
    for (const AssetBytes& asset : assets)
      table.push_back({reinterpret_cast<const uint8_t*>(asset.words.data()), asset.byte_count});
    const AssetTable given = {table.data(), static_cast<uint32_t>(table.size())};
    if (owned.create(def, table.empty() ? scene_assets() : given) != Status::ok)
      return failed("not enough memory for its world");
    player.repeat_queries();
    status = player.start(owned.world);
  }
  const Stopwatch stopwatch;
  const uint64_t seed_end = player.bytes_read();
  for (TickResult result; status == Status::ok && !result.finished;) {
    status = with_world ? player.next_tick(owned.world, result) : player.skip_tick(result);
    if (status != Status::ok) break;
    outcome.calls += result.calls;
    outcome.digest = result.digest;
    if (result.finished) break;
    ++outcome.ticks;
    outcome.digests += result.compared ? 1 : 0;
    if (outcome.ticks % k_ticks_per_progress == 0)
      progress(player.bytes_read() - seed_end, outcome.file_bytes - seed_end);
  }
  outcome.seconds = stopwatch.seconds();
  if (status != Status::ok) take_error(outcome, player.error());
  return outcome;
}

Outcome verify(const std::string& path, const Assets& assets, const Progress& progress) {
  return read_recording(path, true, assets, progress);
}
Outcome info(const std::string& path, const Assets& assets, const Progress& progress) {
  return read_recording(path, false, assets, progress);
}

Outcome record(const RecordRequest& request, const Progress& progress) {
  const Scene* scene = find_scene(request.scene.c_str());
  if (scene == nullptr) return failed("no such scene: " + request.scene);
  OwnedWorld owned;
  const Status created = owned.create(scene->world(), scene_assets());
  if (created != Status::ok) return failed(std::string("its world cannot be made: ") + status_text(created));
  File file = open_file(request.path, "wb");
  if (file == nullptr) return failed("cannot be opened for writing");

  Outcome outcome;
  const Stopwatch stopwatch;
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(owned.world, {write_file, file.get()}, buffer, sizeof buffer);
  scene->build(recorder);
  Status status = recorder.begin({request.digest_interval});
  const uint32_t ticks = request.ticks != 0 ? request.ticks : scene->ticks;
  for (uint32_t tick = 0; tick < ticks && status == Status::ok; ++tick) {
    if (scene->before_tick != nullptr) scene->before_tick(recorder, tick);
    recorder.step();
    if (tick % k_ticks_per_progress == 0) progress(tick, ticks);
    status = recorder.status();
  }
  status = recorder.end();
  if (fclose(file.release()) != 0 || status != Status::ok) return failed("cannot be written");

  const WorldInfo world_info = get_info(owned.world);
  outcome.header_known = true;
  outcome.header = {config_text(k_config),
                    k_recording_format_version,
                    k_simulation_version,
                    world_info.capacity.bodies,
                    world_info.capacity.contacts,
                    world_info.capacity.assets,
                    static_cast<uint32_t>(TraceLevel::digests),
                    request.digest_interval,
                    0,
                    snapshot_bytes(world_info.capacity)};
  outcome.file_bytes = file_bytes(request.path);
  outcome.ticks = ticks;
  outcome.digests = request.digest_interval == 0 ? 0 : ticks / request.digest_interval;
  outcome.digest = digest(owned.world);
  outcome.seconds = stopwatch.seconds();
  return outcome;
}

std::vector<SceneLine> scene_lines() {
  std::vector<SceneLine> lines;
  uint32_t count = 0;
  const Scene* all = scenes(count);
  for (uint32_t i = 0; i < count; ++i) {
    const Capacity capacity = all[i].world().capacity;
    lines.push_back({all[i].name, all[i].description, all[i].ticks, capacity.bodies, capacity.contacts});
  }
  return lines;
}

}  // namespace

Engine engine() {
  return {DETENT_TOOL_TEXT(DETENT_NAMESPACE),
          k_recording_format_version,
          k_simulation_version,
          scene_lines,
          record,
          verify,
          info};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
