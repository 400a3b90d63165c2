#include "scene_play.h"

#include <filesystem>

#include "file.h"
#include "owned_world.h"
#include "scene_player.h"
#include "stream.h"
#include "text.h"
#include "world/asset_binding.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr uint32_t k_events_max = 4096;  // of each kind and step

/// Why a cooked file is refused as a shape of this type.
std::string refusal(FileKind kind, ShapeType type) {
  const bool surface = kind == FileKind::mesh || kind == FileKind::height_field;
  if (type == ShapeType::hull && kind != FileKind::hull) return is_not(kind, "a cooked hull");
  if (type == ShapeType::compound && kind != FileKind::compound) return is_not(kind, "a cooked compound");
  if (type == ShapeType::surface && !surface) return is_not(kind, "a cooked mesh or height field");
  return "is damaged, or of another format version";
}

/// The scene's cooked files.
struct SceneAssets {
  Assets bytes;
  std::vector<Asset> table;

  /// False, and a problem, if one cannot be read or has another digest than the scene says.
  bool read(SceneReading& reading, const RunRequest& request, RunOutcome& outcome) {
    const std::filesystem::path folder = std::filesystem::path(request.path).parent_path();
    bytes.resize(reading.assets.size());
    for (size_t i = 0; i < bytes.size(); ++i) {
      const SceneAsset& asset = reading.assets[i];
      const std::string path = (folder / asset.file).string();
      if (const std::string problem = read_asset(path, bytes[i]); !problem.empty()) {
        reading.problem(asset.file_origin, asset.file + " " + problem);
        return false;
      }
      if (is_same_file(path, request.recording)) {
        reading.problem(asset.file_origin, asset.file + " would be written over by the recording");
        return false;
      }
      table.push_back({reinterpret_cast<const uint8_t*>(bytes[i].words.data()), bytes[i].byte_count});
      AssetState state;
      const AssetTable so_far = {table.data(), static_cast<uint32_t>(table.size())};
      const Status status = describe_asset(so_far, static_cast<uint32_t>(i), feature_table<Features::all>, state);
      if (status != Status::ok || state.kind != static_cast<uint32_t>(asset_kind_of(asset.type))) {
        reading.problem(asset.file_origin, asset.file + " " + refusal(bytes[i].kind, asset.type));
        return false;
      }
      const std::string digest = hexadecimal(state.digest);
      if (!asset.digest.empty() && asset.digest != digest) {
        reading.problem(asset.digest_origin, "that of " + asset.file + " is " + digest);
        return false;
      }
      outcome.assets.push_back(asset.file);
      outcome.asset_digests.push_back(digest);
    }
    return true;
  }
};

/// Room for the events that a step tells.
struct EventRoom {
  std::vector<ContactEvent> contacts;
  std::vector<SensorEvent> sensors;
  std::vector<JointEvent> joints;
  std::vector<BodyEvent> bodies;

  explicit EventRoom(World& world)
      : contacts(k_events_max), sensors(k_events_max), joints(k_events_max), bodies(k_events_max) {
    world.contact_events = {contacts.data(), k_events_max};
    world.sensor_events = {sensors.data(), k_events_max};
    world.joint_events = {joints.data(), k_events_max};
    world.body_events = {bodies.data(), k_events_max};
  }
};

/// Steps the world; the first problem ends it.
void step_through(const RunRequest& request, uint32_t ticks, Recorder& recorder, ScenePlayer& player,
                  RunOutcome& outcome, const RunPrinter& print, const Progress& progress) {
  for (uint32_t tick = 0; tick < ticks && recorder.status() == Status::ok; ++tick) {
    if (!player.before_tick(tick)) return;
    const StepReport report = recorder.step();
    outcome.ticks = report.tick;
    if (!report.complete()) ++outcome.ticks_incomplete;
    if (request.prints.events) player.print_events(recorder.world(), report);
    if (request.prints.ticks) {
      RunLine line = {report.tick, "tick", {}};
      line.add("digest", hexadecimal(digest(recorder.world())));
      line.add("awake", report.awake);
      line.add("contacts", report.contacts);
      print(line);
    }
    if (tick % k_ticks_per_progress == 0) progress(tick, ticks);
  }
}

void play(const RunRequest& request, SceneReading& reading, OwnedWorld& owned, RunOutcome& outcome,
          const RunPrinter& print, const Progress& progress) {
  const EventRoom room(owned.world);
  std::unique_ptr<Output> output;
  const auto write = [](void* to, const uint8_t* bytes, uint32_t count) {
    return (*static_cast<std::unique_ptr<Output>*>(to))->write(bytes, count) ? Status::ok : Status::sink_failed;
  };
  uint8_t buffer[k_recording_buffer_bytes];
  const bool recorded = !request.recording.empty();
  Recorder recorder(owned.world, recorded ? Sink{write, &output} : Sink{}, buffer, sizeof buffer);
  ScenePlayer player(reading, recorder, request.prints, print);
  if (!player.build()) return;
  if (recorded) {
    std::string problem;
    output = Output::open(request.recording, ends_with(request.recording, k_compressed_suffix), problem);
    if (output == nullptr) return reading.problem({}, request.recording + " " + problem);
  }
  Status status = recorder.begin({request.digest_interval});
  const uint32_t ticks = request.ticks_given ? request.ticks : reading.scene.ticks;
  if (status == Status::ok) step_through(request, ticks, recorder, player, outcome, print, progress);
  status = recorder.end();
  if (recorded && reading.problems.empty() && (status != Status::ok || !output->close())) {
    reading.problem({}, with_reason(request.recording + " cannot be written"));
  }
  if (request.prints.bodies) player.print_bodies(owned.world, outcome.ticks);
  outcome.calls = player.calls();
  outcome.recording_bytes = recorded ? output->file_bytes : 0;
}

/// False, and a problem, if it cannot be.
bool make_world(SceneReading& reading, const SceneAssets& assets, uint32_t bytes_max, OwnedWorld& owned) {
  const WorldDef& def = reading.scene.world;
  const uint32_t bytes = world_bytes(def.capacity);
  if (bytes == 0 || bytes > bytes_max) {
    reading.problem({},
                    "its world would take more than " + std::to_string(bytes_max >> 20) + " MB: less capacity will do");
    return false;
  }
  const Status status = owned.create(def, {assets.table.data(), static_cast<uint32_t>(assets.table.size())});
  if (status != Status::ok) reading.problem({}, std::string("its world cannot be made: ") + status_text(status));
  return status == Status::ok;
}

}  // namespace

RunOutcome play_scene(const RunRequest& request, const RunPrinter& print, const Progress& progress) {
  RunOutcome outcome;
  SceneReading reading;
  SceneAssets assets;
  OwnedWorld owned;
  read_scene(*request.root, reading);
  outcome.description = reading.scene.description;
  if (reading.problems.empty() && assets.read(reading, request, outcome) &&
      make_world(reading, assets, request.world_bytes_max, owned)) {
    const Stopwatch stopwatch;
    play(request, reading, owned, outcome, print, progress);
    outcome.seconds = stopwatch.seconds();
    const WorldInfo info = get_info(owned.world);
    outcome.bodies = info.bodies;
    outcome.joints = info.joints;
    outcome.digest = digest(owned.world);
  }
  outcome.problems = reading.problems;
  return outcome;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
