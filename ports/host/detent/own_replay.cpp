#include "own_replay.h"

#include "repeat_call.h"
#include "replay/command.h"
#include "replay/replay_watch.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

OwnReplay::OwnReplay(const Recorded& recorded, const Assets& assets, Sink sink)
    : recorded_(recorded), assets_(assets), sink_(sink) {}

bool OwnReplay::fail(const std::string& why) {
  if (problem.empty()) problem = why;
  return false;
}

bool OwnReplay::open() {
  std::string why;
  input_ = recorded_.open(why);
  if (input_ == nullptr) return fail(why);
  player_ = std::make_unique<Player>(source_of(*input_), reading_, k_recording_buffer_bytes);
  if (player_->open() != Status::ok) return fail(problem_text(player_->error(), *input_));
  world_ = {};
  const Status created = world_.create(player_->info(), *input_, assets_);
  if (created != Status::ok) return fail(std::string("its world cannot be made: ") + status_text(created));
  recorder_ = std::make_unique<Recorder>(world(), sink_, writing_, k_recording_buffer_bytes);
  tick = player_->info().tick;
  return true;
}

bool OwnReplay::begin(uint64_t wanted) {
  if (!open()) return false;
  Status status = wanted > tick ? player_->go_to(world(), wanted) : player_->start(world());
  if (status == Status::digest_differs) {
    if (!open()) return false;
    status = player_->start(world());
  }
  if (status == Status::out_of_range && player_->error().status == Status::ok)
    return fail("has no tick " + std::to_string(wanted));
  if (status != Status::ok) return fail(problem_text(player_->error(), *input_));
  tick = get_info(world()).tick;
  while (tick < wanted) {
    if (!next()) return fail("has no tick " + std::to_string(wanted));
  }
  return true;
}

void OwnReplay::called(void* context, const uint8_t* record, uint32_t count) {
  static_cast<OwnReplay*>(context)->call(record, count);
}

void OwnReplay::call(const uint8_t* record, uint32_t count) {
  if (!problem.empty()) return;
  const RecordTag tag = static_cast<RecordTag>(record[0]);
  const auto [status, same_id] = repeat_call(*recorder_, record, count);
  if (status == Status::ok && same_id) return;
  refused = true;
  fail("tick " + std::to_string(tick + 1) + ": this machine " +
       (status == Status::ok ? "gives another id by" : "refuses") + " the call " + record_name(tag) +
       (status == Status::ok ? "" : std::string(" (") + status_text(status) + ")"));
}

bool OwnReplay::next() {
  if (finished || !problem.empty()) return false;
  const ReplayWatch watch = {this, called, [](void*, ChunkType, const uint8_t*, uint32_t) {}};
  player_->watch(&watch);
  TickResult result;
  const Status status = player_->skip_tick(result);
  player_->watch(nullptr);
  if (status != Status::ok) return fail(problem_text(player_->error(), *input_));
  if (!problem.empty()) return false;
  finished = result.finished;
  if (!finished) tick = recorder_->step().tick;
  compared = result.compared;
  if (compared && first_other == 0 && result.digest != digest(world())) first_other = tick;
  return !finished;
}

bool OwnReplay::verified() {
  while (!compared && first_other == 0 && next()) {
  }
  return first_other == 0 && problem.empty();
}

TraceMade trace_to(const Recorded& recorded, const Assets& assets, const TraceDef& def, Sink sink,
                   const Progress& progress) {
  TraceMade made;
  OwnReplay replay(recorded, assets, sink);
  if (!replay.begin(def.from == 0 ? 0 : def.from - 1)) {
    made.problem = replay.problem;
    return made;
  }
  const uint64_t first = replay.tick;
  Status status = replay.recorder().trace(def);
  if (status == Status::ok) status = replay.recorder().begin();
  while (status == Status::ok && replay.tick < def.to && replay.next()) {
    if (replay.tick % k_ticks_per_progress == 0) progress(replay.tick - first, def.to - first);
    status = replay.recorder().status();
  }
  if (status == Status::ok) status = replay.recorder().end();
  made.problem = status == Status::ok ? replay.problem : std::string(status_text(status));
  made.ticks = replay.tick - first;
  made.last = replay.tick;
  made.digest = digest(replay.world());
  replay.verified();
  made.first_other = replay.first_other;
  return made;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
