#include "tick_reader.h"

#include "replay/replay_watch.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

TickReader::TickReader(const Recorded& recorded) {
  input_ = recorded.open(problem);
  if (input_ == nullptr) return;
  player_ = std::make_unique<Player>(source_of(*input_), buffer_, k_recording_buffer_bytes);
  const Status status = player_->open();
  other_config = status == Status::config_differs;
  if (status != Status::ok) problem = problem_text(player_->error(), *input_);
  tick = player_->info().tick;
}

bool TickReader::next() {
  if (finished || !problem.empty()) return false;
  calls.clear();
  traced_.clear();
  trace = {};
  type_ = ChunkType::end;
  const ReplayWatch watch = {this,
                             [](void* context, const uint8_t* record, uint32_t count) {
                               static_cast<TickReader*>(context)->calls.emplace_back(record, record + count);
                             },
                             [](void* context, ChunkType type, const uint8_t* payload, uint32_t count) {
                               TickReader& reader = *static_cast<TickReader*>(context);
                               reader.type_ = type;
                               reader.traced_.insert(reader.traced_.end(), payload, payload + count);
                             }};
  player_->watch(&watch);
  TickResult result;
  const Status status = player_->skip_tick(result);
  player_->watch(nullptr);
  if (status != Status::ok) {
    problem = problem_text(player_->error(), *input_);
    return false;
  }
  finished = result.finished;
  tick = result.tick;
  compared = result.compared;
  digest = result.digest;
  if (!traced_.empty() && !trace.read(traced_, type_ == ChunkType::state))
    problem = "corrupt at tick " + std::to_string(tick) + ": its trace is none";
  return problem.empty();
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
