#include "engine.h"

#include <detent/recording.h>
#include <string.h>

#include "examples/scenes/scene.h"
#include "file.h"
#include "owned_world.h"
#include "reading.h"
#include "scene_play.h"
#include "shrink_recording.h"
#include "stream.h"

#define DETENT_TOOL_TEXT_OF(name) #name
#define DETENT_TOOL_TEXT(name) DETENT_TOOL_TEXT_OF(name)

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_tool;

Outcome record(const RecordRequest& request, const Progress& progress) {
  const Scene* scene = find_scene(request.scene.c_str());
  if (scene == nullptr) return failed("no such scene: " + request.scene);
  OwnedWorld owned;
  const Status created = owned.create(scene->world(), scene_assets());
  if (created != Status::ok) return failed(std::string("its world cannot be made: ") + status_text(created));
  std::string problem;
  const std::unique_ptr<Output> output = Output::open(request.path, request.compressed, problem);
  if (output == nullptr) return failed(problem);

  Outcome outcome;
  const Stopwatch stopwatch;
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(owned.world, sink_of(*output), buffer, sizeof buffer);
  scene->build(recorder);
  Status status = recorder.begin({request.digest_interval, request.keyframe_interval});
  const uint32_t ticks = request.ticks != 0 ? request.ticks : scene->ticks;
  for (uint32_t tick = 0; tick < ticks && status == Status::ok; ++tick) {
    if (scene->before_tick != nullptr) scene->before_tick(recorder, tick);
    recorder.step();
    if (tick % k_ticks_per_progress == 0) progress(tick, ticks);
    status = recorder.status();
  }
  status = recorder.end();
  if (status != Status::ok || !output->close()) return failed(with_reason("cannot be written"));

  RecordingInfo info;
  info.format_version = k_recording_format_version;
  info.simulation_version = k_simulation_version;
  info.capacity = get_info(owned.world).capacity;
  info.digest_interval = request.digest_interval;
  info.keyframe_interval = request.keyframe_interval;
  info.snapshot_bytes = snapshot_bytes(info.capacity);
  outcome.header_known = true;
  outcome.header = header_of(info);
  outcome.file_bytes = output->file_bytes;
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

Assets copied_scene_assets() {
  Assets copies;
  const AssetTable table = scene_assets();
  for (uint32_t i = 0; i < table.count; ++i) {
    const Asset& asset = table.assets[i];
    AssetBytes copy;
    copy.words.resize((asset.byte_count + 7) / 8);
    memcpy(copy.words.data(), asset.bytes, asset.byte_count);
    copy.byte_count = asset.byte_count;
    copies.push_back(copy);
  }
  return copies;
}

}  // namespace

Engine engine() {
  return {DETENT_TOOL_TEXT(DETENT_NAMESPACE),
          k_recording_format_version,
          k_simulation_version,
          kind_of,
          scene_lines,
          record,
          verify,
          info,
          state,
          recover,
          diff,
          explain,
          trace,
          shrink,
          play_scene,
          describe_scene,
          copied_scene_assets};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
