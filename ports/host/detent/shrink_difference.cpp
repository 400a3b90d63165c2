#include "file.h"
#include "recording_bytes.h"
#include "shrink_recording.h"
#include "tick_reader.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

constexpr size_t k_span_bytes_max = size_t{1} << 28;
constexpr const char* k_keyframe_field = "keyframe digest";  // ReplayError::field

struct SpanTick {
  std::vector<std::vector<uint8_t>> calls;
  bool compared = false;
  uint64_t digest = 0;  ///< recorded
};

/// The ticks since the last recorded digest that equals this machine's, and the state at that digest.
struct DifferingSpan {
  std::vector<uint64_t> seed;
  uint64_t first = 0;
  std::vector<SpanTick> ticks;  ///< the last entry of a whole recording has only the calls after its last tick
  bool finished = false;        ///< `ticks` ends with the calls after the last tick
  size_t bytes = 0;

  /// Begins a new span at the world's state.
  Status begin(const World& world) {
    const uint32_t bytes_needed = snapshot_bytes(get_info(world).capacity);
    seed.resize((bytes_needed + 7) / 8);
    first = get_info(world).tick;
    ticks.clear();
    bytes = 0;
    return save(world, reinterpret_cast<uint8_t*>(seed.data()), bytes_needed);
  }
  void add(const TickReader& reader) {
    ticks.push_back({reader.calls, reader.compared, reader.digest});
    bytes += sizeof(SpanTick);
    for (const std::vector<uint8_t>& call : reader.calls) bytes += sizeof call + call.size();
    finished = reader.finished;
  }
  uint64_t tick_count() const { return ticks.size() - (finished ? 1 : 0); }
  uint64_t calls() const {
    uint64_t count = 0;
    for (const SpanTick& tick : ticks) count += tick.calls.size();
    return count;
  }
};

/// Writes the span as a recording. Returns the problem; empty if none.
std::string write_span(const DifferingSpan& span, uint32_t digest_interval, uint64_t final_digest, World& world,
                       RecordingBytes& recording) {
  const uint32_t seed_bytes = snapshot_bytes(get_info(world).capacity);
  Status status = restore(world, reinterpret_cast<const uint8_t*>(span.seed.data()), seed_bytes);
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(world, recording.sink(), buffer, sizeof buffer);
  if (status == Status::ok) status = recorder.begin({digest_interval});
  if (status != Status::ok) return status_text(status);
  uint64_t tick = span.first;
  const uint64_t last = span.first + span.tick_count();
  for (const SpanTick& each : span.ticks) {
    for (const std::vector<uint8_t>& call : each.calls)
      recording.add(call.data(), static_cast<uint32_t>(call.size()), tick);
    if (tick != last) recording.add_tick(tick++, each.compared ? &each.digest : nullptr);
  }
  recording.end(tick, {tick - span.first, final_digest});
  return recording.full ? "what remains is too large" : "";
}

/// Replays the bytes on this machine. Returns the status; `error` tells where and why the replay ends.
Status replay_again(const std::shared_ptr<std::vector<uint8_t>>& bytes, const Assets& assets, ReplayError& error,
                    std::string& text) {
  const std::unique_ptr<Input> input = open_bytes(bytes);
  ReplayWorld replayed;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(source_of(*input), buffer, sizeof buffer);
  Status status = player.open();
  if (status == Status::ok) status = replayed.create(player.info(), *input, assets);
  player.repeat_queries();
  if (status == Status::ok) status = player.start(replayed.owned.world);
  for (TickResult result; status == Status::ok && !result.finished;)
    status = player.next_tick(replayed.owned.world, result);
  error = player.error();
  text = problem_text(player.error(), *input);
  return status;
}

/// Replays and reads the recording tick by tick, up to the first difference, which is then in the span's last tick.
/// Returns why there is no difference; empty if there is one. `calls`: the number of calls that were read.
std::string find_difference_span(Player& player, Input& input, TickReader& reader, World& world, DifferingSpan& span,
                                 uint64_t& calls, const Progress& progress) {
  Status status = player.start(world);
  if (status == Status::ok) status = span.begin(world);
  for (TickResult result; status == Status::ok;) {
    const std::string so_far = "; no tick differs up to tick " + std::to_string(get_info(world).tick);
    if (result.finished) return "verifies" + so_far;
    if (!reader.next()) return reader.problem + so_far;
    span.add(reader);
    calls += reader.calls.size();
    if (span.bytes > k_span_bytes_max)
      return "has too much between two digests: its ticks and calls take more than " +
             std::to_string(k_span_bytes_max) + " bytes";
    status = player.next_tick(world, result);
    if (result.tick % k_ticks_per_progress == 0) progress(player.bytes_read(), input.bytes_max);
    if (status == Status::ok && result.compared && !result.finished) status = span.begin(world);
  }
  if (status != Status::digest_differs) return problem_text(player.error(), input);
  // The digest of a keyframe is found before the next tick, which the reader has passed.
  if (player.error().field != std::string(k_keyframe_field)) return "";
  span.ticks.pop_back();
  span.finished = false;
  return span.ticks.empty()
             ? "its keyframe at tick " + std::to_string(span.first) + " has another digest than that tick"
             : "";
}

/// Whether both errors are the same difference. The shrunk recording has no keyframe: the digest of a keyframe is in
/// its end instead.
bool is_same_difference(const ReplayError& a, const ReplayError& b) {
  const std::string field = a.field == std::string(k_keyframe_field) ? "final digest" : a.field;
  return a.tick == b.tick && field == b.field && a.digest_recorded == b.digest_recorded &&
         a.digest_replayed == b.digest_replayed;
}

}  // namespace

Outcome shrink_difference(const ShrinkRequest& request, const Recorded& recorded, Shrunk& shrunk,
                          const Progress& progress) {
  std::string problem;
  const std::unique_ptr<Input> input = recorded.open(problem);
  if (input == nullptr) return failed(problem);
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(source_of(*input), buffer, sizeof buffer);
  if (player.open() != Status::ok) return failed_to_open(player.error(), *input);
  ReplayWorld replayed;
  if (replayed.create(player.info(), *input, request.reading.assets) != Status::ok)
    return failed("its world cannot be made: the file is too small for its seed snapshot, or memory is short");
  player.repeat_queries();
  World& world = replayed.owned.world;
  TickReader reader(recorded);
  DifferingSpan span;
  const uint64_t first = player.info().tick;
  problem = find_difference_span(player, *input, reader, world, span, shrunk.before.calls, progress);
  shrunk.replays = 1;
  if (!problem.empty()) return failed(problem);
  const ReplayError& error = player.error();
  const WorldInfo info = get_info(world);
  RecordingBytes bytes;
  problem = write_span(span, player.info().digest_interval, error.digest_recorded, world, bytes);
  if (!problem.empty()) return failed(problem);
  const auto shared = std::make_shared<std::vector<uint8_t>>(std::move(bytes.bytes));
  ReplayError again;
  ++shrunk.replays;
  if (replay_again(shared, request.reading.assets, again, shrunk.fault) != Status::digest_differs ||
      !is_same_difference(error, again)) {
    return failed("the smaller recording does not show the fault");
  }
  shrunk.tick_before = shrunk.tick = error.tick;
  shrunk.after = {span.tick_count(), info.bodies, info.joints, span.calls(), 0};
  shrunk.before = {span.first - first + span.tick_count(), info.bodies, info.joints, shrunk.before.calls,
                   input->file_bytes};
  Outcome outcome;
  outcome.problem = write_shrunk(request, *shared, shrunk);
  return outcome.problem.empty() ? outcome : failed(outcome.problem);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
