#include "scene_play.h"

#include <detent/world.h>

#include "file.h"
#include "owned_world.h"
#include "scene_player.h"
#include "scene_repeat.h"
#include "scene_world.h"
#include "stream.h"
#include "text.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr uint32_t k_events_max = 4096;  // of each kind in a step

/// Buffers for the events of a step.
struct EventRoom {
  std::vector<ContactEvent> contacts;
  std::vector<SensorEvent> sensors;
  std::vector<JointEvent> joints;
  std::vector<BodyEvent> bodies;

  explicit EventRoom(World& world)
      : contacts(k_events_max), sensors(k_events_max), joints(k_events_max), bodies(k_events_max) {
    world.hooks.contact_events = {contacts.data(), k_events_max};
    world.hooks.sensor_events = {sensors.data(), k_events_max};
    world.hooks.joint_events = {joints.data(), k_events_max};
    world.hooks.body_events = {bodies.data(), k_events_max};
  }
};

/// Steps the world until the end or the first problem.
void step_through(const RunRequest& request, uint32_t ticks, Recorder& recorder, ScenePlayer& player,
                  RunOutcome& outcome, const RunPrinter& print, const Progress& progress) {
  CapacityUse use;
  for (uint32_t tick = 0; tick < ticks && recorder.status() == Status::ok; ++tick) {
    if (!player.before_tick(tick)) return;
    const StepReport report = recorder.step();
    outcome.ticks = report.tick;
    if (!report.complete()) ++outcome.ticks_incomplete;
    note_use(report, get_info(recorder.world()), use);
    if (request.prints.events) player.print_events(recorder.world(), report);
    if (request.prints.ticks) {
      RunLine line = {report.tick, "tick", {}};
      line.add("digest", hexadecimal(digest(recorder.world())));
      line.add("awake", report.awake);
      line.add("contacts", report.contacts.count);
      print(line);
    }
    if (tick % k_ticks_per_progress == 0) progress(tick, ticks);
  }
  const Capacity fit = suggest_capacity(use, get_info(recorder.world()).capacity);
  outcome.ticks_full = use.steps_full;
  outcome.bodies_fit = fit.bodies;
  outcome.contacts_fit = fit.contacts;
  outcome.joints_fit = fit.joints;
  outcome.sensed_fit = fit.sensed;
}

/// Where the recording of a run goes: a file, bytes, or nowhere.
class Recording {
 public:
  explicit Recording(const RunRequest& request) : request_(request) {}

  Sink sink() {
    if (request_.recording.empty() && request_.recorded == nullptr) return {};
    return {[](void* to, const uint8_t* bytes, uint32_t count) {
              return static_cast<Recording*>(to)->write(bytes, count) ? Status::ok : Status::sink_failed;
            },
            this};
  }
  /// Opens the recording. Called after the world was created, so that no file is left if that fails. Returns false on
  /// failure, with the reason in `problem`.
  bool open(std::string& problem) {
    if (request_.recording.empty()) return true;
    output_ = Output::open(request_.recording, ends_with(request_.recording, k_compressed_suffix), problem);
    return output_ != nullptr;
  }
  bool close() { return output_ == nullptr || output_->close(); }
  uint64_t bytes() const { return output_ == nullptr ? 0 : output_->file_bytes; }

 private:
  bool write(const uint8_t* bytes, uint32_t count) {
    if (request_.recorded == nullptr) return output_->write(bytes, count);
    if (request_.recorded->size() + count > k_whole_file_bytes_max) return false;
    request_.recorded->insert(request_.recorded->end(), bytes, bytes + count);
    return true;
  }

  const RunRequest& request_;
  std::unique_ptr<Output> output_;
};

void play(const RunRequest& request, SceneReading& reading, OwnedWorld& owned, RunOutcome& outcome,
          const RunPrinter& print, const Progress& progress) {
  const EventRoom room(owned.world);
  Recording recording(request);
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(owned.world, recording.sink(), buffer, sizeof buffer);
  ScenePlayer player(reading, recorder, request.prints, print);
  if (!player.build()) return;
  std::string problem;
  if (!recording.open(problem)) return reading.problem({}, request.recording + " " + problem);
  Status status = recorder.begin({request.digest_interval});
  const uint32_t ticks = request.ticks_given ? request.ticks : reading.scene.ticks;
  if (status == Status::ok) step_through(request, ticks, recorder, player, outcome, print, progress);
  status = recorder.end();
  if (reading.problems.empty() && (status != Status::ok || !recording.close())) {
    const std::string limit = std::to_string(k_whole_file_bytes_max);
    reading.problem({}, request.recorded != nullptr ? "its recording has more than " + limit + " bytes"
                                                    : with_reason(request.recording + " cannot be written"));
  }
  if (request.prints.bodies) player.print_bodies(owned.world, outcome.ticks);
  outcome.calls = player.calls();
  outcome.recording_bytes = recording.bytes();
}

}  // namespace

RunOutcome play_scene(const RunRequest& request, const RunPrinter& print, const Progress& progress) {
  RunOutcome outcome;
  SceneReading reading;
  SceneAssets assets;
  OwnedWorld owned;
  Node root = *request.root;
  write_out_repeats(root, reading.problems);
  read_scene(root, reading);
  outcome.description = reading.scene.description;
  if (reading.problems.empty() && assets.read(reading, request) &&
      make_world(reading, assets, request.world_bytes_max, owned)) {
    const Stopwatch stopwatch;
    play(request, reading, owned, outcome, print, progress);
    outcome.seconds = stopwatch.seconds();
    const WorldInfo info = get_info(owned.world);
    outcome.bodies = info.bodies;
    outcome.joints = info.joints;
    outcome.digest = digest(owned.world);
  }
  for (size_t i = 0; i < assets.digests.size(); ++i) outcome.assets.push_back(reading.assets[i].file);
  outcome.asset_digests = assets.digests;
  outcome.problems = reading.problems;
  return outcome;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
