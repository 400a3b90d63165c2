#include "reading.h"

#include <detent/numbers.h>

#include "file.h"
#include "own_replay.h"
#include "ports/config_text.h"
#include "replay/format.h"
#include "text.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

/// A recording that is being read, with or without a world.
class Reading {
 public:
  explicit Reading(const ReadRequest& request) : request_(request) {
    std::string problem;
    input_ = Input::open(request.path, problem);
    if (input_ == nullptr) {
      outcome = failed(problem);
      return;
    }
    player_ = std::make_unique<Player>(source_of(*input_), buffer_, k_recording_buffer_bytes);
    take(player_->open());
    outcome.file_bytes = input_->file_bytes;
    outcome.header_known = player_->info().snapshot_bytes != 0;
    outcome.header = header_of(player_->info());
  }

  bool good() const { return player_ != nullptr && status_ == Status::ok && outcome.verdict == Verdict::good; }
  Player& player() { return *player_; }
  OwnedWorld& owned() { return world_.owned; }

  void create_world() {
    const Status created = world_.create(player_->info(), *input_, request_.assets);
    if (created == Status::truncated) {
      outcome.verdict = Verdict::bad;
      outcome.status = status_text(Status::truncated);
      outcome.problem = "truncated: the file is too small for its seed snapshot";
    } else if (created != Status::ok) {
      outcome = failed("not enough memory for its world");
    }
    player_->repeat_queries();
  }

  void start_from(uint64_t tick) {
    if (tick > player_->info().tick)
      go_to(tick);
    else
      take(player_->start(owned().world));
  }

  void go_to(uint64_t tick) {
    if (!good()) return;
    const Status status = player_->go_to(owned().world, tick);
    if (status == Status::out_of_range && player_->error().status == Status::ok) return no_tick(tick);
    take(status);
  }

  /// Reads to the end, or to the request's last tick.
  void play(bool with_world, const Progress& progress) {
    const Stopwatch stopwatch;
    const uint64_t first_byte = good() ? player_->bytes_read() : 0;
    uint64_t tick = good() && with_world ? get_info(owned().world).tick : 0;
    for (TickResult result; good() && tick < request_.to;) {
      take(with_world ? player_->next_tick(owned().world, result) : player_->skip_tick(result));
      if (!good()) break;
      outcome.calls += result.calls;
      outcome.digest = result.digest;
      if (result.finished) {
        finished = true;
        if (!input_->ends_whole()) {
          outcome.verdict = Verdict::bad;
          outcome.status = status_text(Status::truncated);
          outcome.problem = input_->problem;
        }
        break;
      }
      tick = result.tick;
      ++outcome.ticks;
      outcome.digests += result.compared ? 1 : 0;
      if (outcome.ticks % k_ticks_per_progress == 0)
        progress(player_->bytes_read() - first_byte, input_->bytes_max - first_byte);
    }
    outcome.seconds = stopwatch.seconds();
    if (!good() || request_.to == UINT64_MAX) return;
    if (finished || tick > request_.to) return no_tick(request_.to);
    outcome.digest = digest(owned().world);
  }

  Outcome outcome;
  bool finished = false;

 private:
  void no_tick(uint64_t tick) {
    outcome.verdict = Verdict::bad;
    outcome.status = status_text(Status::out_of_range);
    outcome.problem = "has no tick " + std::to_string(tick);
  }

  void take(Status status) {
    status_ = status;
    if (status == Status::ok) return;
    const ReplayError& error = player_->error();
    const bool refused =
        status == Status::simulation_differs || status == Status::config_differs || status == Status::format_unknown;
    outcome.verdict = refused ? Verdict::refused : Verdict::bad;
    outcome.other_config = status == Status::config_differs;
    outcome.status = status_text(status);
    outcome.field = error.field;
    outcome.offset = error.offset;
    outcome.tick = error.tick;
    // A digest covers the state after its tick, so that tick may be wrong. Any other fault comes before the next tick.
    outcome.first_bad_tick = ends_with(outcome.field, "digest") ? error.tick : error.tick + 1;
    // Stays false if the calls after the last tick differ.
    outcome.digests_differ = status == Status::digest_differs && ends_with(outcome.field, "digest") &&
                             (outcome.field != "final digest" || !is_due(player_->info().digest_interval, error.tick));
    outcome.problem = problem_text(error, *input_);
  }

  const ReadRequest& request_;
  std::unique_ptr<Input> input_;
  uint8_t buffer_[k_recording_buffer_bytes];
  std::unique_ptr<Player> player_;
  Status status_ = Status::ok;
  ReplayWorld world_;
};

const char* type_text(BodyType type) {
  switch (type) {
    case BodyType::fixed:
      return "fixed";
    case BodyType::kinematic:
      return "kinematic";
    case BodyType::dynamic:
      return "dynamic";
  }
  return "unknown";
}

void take_vector(const Vec3<Real>& from, double (&to)[3]) {
  to[0] = real_to_host(from.x);
  to[1] = real_to_host(from.y);
  to[2] = real_to_host(from.z);
}

BodyLine line_of(const World& world, BodyId id) {
  BodyLine line;
  BodyType type = BodyType::fixed;
  Pose pose;
  Vec3<Real> linear_velocity, angular_velocity;
  if (get_type(world, id, type) != Status::ok || get_pose(world, id, pose) != Status::ok ||
      get_velocity(world, id, linear_velocity, angular_velocity) != Status::ok ||
      is_awake(world, id, line.awake) != Status::ok) {
    return line;  // impossible: the world gave the id
  }
  line.slot = id.slot;
  line.generation = id.generation;
  line.type = type_text(type);
  line.position[0] = coord_to_host(pose.position.x);
  line.position[1] = coord_to_host(pose.position.y);
  line.position[2] = coord_to_host(pose.position.z);
  const Unit parts[] = {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
  for (int i = 0; i < 4; ++i) line.rotation[i] = unit_to_host(parts[i]);
  take_vector(linear_velocity, line.linear_velocity);
  take_vector(angular_velocity, line.angular_velocity);
  return line;
}

/// Copies the first `count` bytes of a recording and appends an end. Returns the problem; empty if none.
std::string copy(const std::string& from, uint64_t count, const std::vector<uint8_t>& end, const std::string& to,
                 uint64_t& bytes_written) {
  std::string problem;
  const std::unique_ptr<Input> input = Input::open(from, problem);
  if (input == nullptr) return problem;
  const std::unique_ptr<Output> output = Output::open(to, ends_with(to, k_compressed_suffix), problem);
  if (output == nullptr) return to + " " + problem;
  uint8_t piece[4096];
  bool good = true;
  while (count != 0 && good) {
    uint32_t got = 0;
    const uint32_t asked = count < sizeof piece ? static_cast<uint32_t>(count) : static_cast<uint32_t>(sizeof piece);
    good = input->read(piece, asked, got) && got == asked && output->write(piece, got);
    count -= got;
  }
  good = good && output->write(end.data(), static_cast<uint32_t>(end.size())) && output->close();
  bytes_written = output->file_bytes;
  return good ? "" : with_reason(to + " cannot be written");
}

}  // namespace

Sink sink_of(Output& output) {
  return {[](void* to, const uint8_t* bytes, uint32_t count) {
            return static_cast<Output*>(to)->write(bytes, count) ? Status::ok : Status::sink_failed;
          },
          &output};
}

Header header_of(const RecordingInfo& info) {
  return {config_text(info.config),
          info.format_version,
          info.simulation_version,
          info.capacity.bodies,
          info.capacity.contacts,
          info.capacity.assets,
          static_cast<uint32_t>(info.trace_level),
          info.digest_interval,
          info.keyframe_interval,
          info.tick,
          info.snapshot_bytes};
}

Outcome failed(const std::string& problem) {
  Outcome outcome;
  outcome.verdict = Verdict::bad;
  outcome.problem = outcome.status = problem;
  return outcome;
}

Outcome failed_to_open(const ReplayError& error, Input& input) {
  Outcome outcome = failed(problem_text(error, input));
  outcome.other_config = error.status == Status::config_differs;
  return outcome;
}

Outcome verify(const ReadRequest& request, const Progress& progress) {
  Reading reading(request);
  if (reading.good()) reading.create_world();
  if (reading.good()) reading.start_from(request.from);
  reading.play(true, progress);
  if (!reading.good() && reading.outcome.ticks != 0 && reading.outcome.status == status_text(Status::truncated)) {
    reading.outcome.problem += "; whole up to tick " + std::to_string(reading.outcome.tick) + " (see: detent recover)";
  }
  return reading.outcome;
}

Outcome info(const ReadRequest& request, const Progress& progress) {
  Reading reading(request);
  reading.play(false, progress);
  return reading.outcome;
}

Outcome state(const ReadRequest& request, std::vector<BodyLine>& bodies) {
  Reading reading(request);
  if (reading.good()) reading.create_world();
  reading.go_to(request.to);
  if (!reading.good()) return reading.outcome;
  const World& world = reading.owned().world;
  reading.outcome.tick = request.to;
  reading.outcome.digest = digest(world);
  for (BodyId id = next_body(world, {}); id.slot != 0; id = next_body(world, id)) bodies.push_back(line_of(world, id));
  return reading.outcome;
}

Outcome recover(const ReadRequest& request, const std::string& path, const Progress& progress) {
  Reading reading(request);
  if (reading.good()) reading.create_world();
  if (reading.good()) reading.start_from(0);
  if (!reading.good()) return reading.outcome;
  reading.play(true, progress);
  std::vector<uint8_t> end;
  if (!reading.finished) {
    const auto keep = [](void* bytes, const uint8_t* from, uint32_t count) {
      static_cast<std::vector<uint8_t>*>(bytes)->assign(from, from + count);
      return Status::ok;
    };
    if (reading.player().write_end(reading.owned().world, {keep, &end}) != Status::ok) return reading.outcome;
  }
  const uint64_t whole = reading.finished ? reading.player().bytes_read() : reading.player().whole_bytes();
  Outcome outcome = reading.outcome;
  outcome.lost = outcome.problem;
  outcome.problem = copy(request.path, whole, end, path, outcome.file_bytes);
  outcome.verdict = outcome.problem.empty() ? Verdict::good : Verdict::bad;
  outcome.status = outcome.problem.empty() ? status_text(Status::ok) : outcome.problem;
  outcome.field.clear();
  outcome.digest = digest(reading.owned().world);
  return outcome;
}

Outcome trace(const TraceRequest& request, const Progress& progress) {
  Recorded recorded;
  recorded.path = request.reading.path;
  {
    // Returns the same outcome as the other commands for a file that cannot be read or has another configuration.
    std::string problem;
    const std::unique_ptr<Input> input = recorded.open(problem);
    if (input == nullptr) return failed(problem);
    uint8_t buffer[k_recording_buffer_bytes];
    Player player(source_of(*input), buffer, sizeof buffer);
    if (player.open() != Status::ok) return failed_to_open(player.error(), *input);
  }
  std::string problem;
  const std::unique_ptr<Output> output =
      Output::open(request.output, ends_with(request.output, k_compressed_suffix), problem);
  if (output == nullptr) return failed(request.output + " " + problem);
  const TraceLevel level = request.full ? TraceLevel::full : TraceLevel::stages;
  const TraceDef def = {level, request.reading.from, request.reading.to};
  const TraceMade made = trace_to(recorded, request.reading.assets, def, sink_of(*output), progress);
  Outcome outcome;
  if (!made.problem.empty()) {
    outcome = failed(made.problem);
  } else if (made.last < def.to) {
    outcome = failed("has no tick " + std::to_string(def.to));
  } else if (!output->close()) {
    outcome = failed(with_reason(request.output + " cannot be written"));
  }
  outcome.ticks = made.ticks;
  outcome.tick = made.last;
  outcome.first_bad_tick = made.first_other;
  outcome.digest = made.digest;
  outcome.file_bytes = output->file_bytes;
  return outcome;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
