#include "call_player.h"

#include <string.h>

#include <algorithm>

#include "replay/command.h"
#include "state/used.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

/// Replaces a recorded id. Returns false if it names a body or joint that is left out. An id that never named anything
/// stays.
template <class Id>
bool replace_id(const std::map<Id, Id>& ids, const std::set<Id>& recorded, Id& id) {
  const auto found = ids.find(id);
  if (found == ids.end()) return recorded.count(id) == 0;
  id = found->second;
  return true;
}

/// Copies the ids that are valid in the world, and removes the others from the recorded ids: they name nothing from now
/// on.
template <class Id>
void take_valid_ids(const World& world, const std::map<Id, Id>& ids, std::map<Id, Id>& valid, std::set<Id>& recorded) {
  for (const auto& [id, given] : ids) {
    if (is_valid(world, given))
      valid[id] = given;
    else
      recorded.erase(id);
  }
}

}  // namespace

void CallPlayer::keep_id(BodyId recorded, BodyId given) {
  ids_.bodies[recorded] = given;
  if (fault_.body_slot != 0 && recorded.slot == fault_.body_slot) fault_.body = given;
}

/// Loads the state and removes the bodies and joints that are left out.
bool CallPlayer::start(const Units& units) {
  ids_ = {};
  fault_.body = {};
  next_ = 0;
  refused_.clear();
  starts_.assign(1, list_.first);
  calls_.assign(std::lower_bound(units.begin(), units.end(), list_.first_call()), units.end());
  if (restore(world_, reinterpret_cast<const uint8_t*>(list_.seed.data()), list_.seed_bytes) != Status::ok)
    return false;
  uint32_t unit = list_.first_joint();
  for (const auto& [recorded, given] : list_.ids.joints) {
    const bool kept = std::binary_search(units.begin(), units.end(), unit++);
    if (kept)
      ids_.joints[recorded] = given;
    else if (is_valid(world_, given) && destroy_joint(world_, given) != Status::ok)
      return false;
  }
  unit = 0;
  for (const auto& [recorded, given] : list_.ids.bodies) {
    const bool kept = std::binary_search(units.begin(), units.end(), unit++);
    if (kept)
      keep_id(recorded, given);
    else if (destroy_body(world_, given) != Status::ok)
      return false;
  }
  return true;
}

/// Replaces the recorded ids in a command. Returns false if the command is about a body or joint that is left out.
bool CallPlayer::replace_ids(uint8_t tag, void* command) const {
  const auto replace_body = [this](BodyId& id) { return replace_id(ids_.bodies, list_.recorded->bodies, id); };
  switch (static_cast<RecordTag>(tag)) {
    case RecordTag::create_body:
    case RecordTag::set_gravity:
    case RecordTag::set_settings:
    case RecordTag::bind_asset:
    case RecordTag::explode:
      return true;
    case RecordTag::create_joint: {
      JointDef& def = static_cast<CreateJoint*>(command)->def;
      return replace_body(def.a) && replace_body(def.b);
    }
    case RecordTag::set_joint:
    case RecordTag::destroy_joint:
      return replace_id(ids_.joints, list_.recorded->joints, *static_cast<JointId*>(command));
    default:  // all others begin with a body
      return replace_body(*static_cast<BodyId*>(command));
  }
}

CallPlayer::Made CallPlayer::make(Recorder& recorder, const ListedCall& call, RefusedCall& refused) {
  const uint8_t* const record = list_.record(call);
  const RecordTag tag = static_cast<RecordTag>(record[0]);
  const CommandCode* const code = find_command(tag);
  alignas(8) uint8_t command[k_command_bytes_max] = {};
  Reader reader{record, call.count, 1};
  code->visit(reader, command);
  BodyId recorded, given;  // or joint ids
  memcpy(&recorded, command, sizeof recorded);
  if (!replace_ids(record[0], command)) return Made::left_out;
  const Status status = recorder.make(*code, command);
  if (status != Status::ok) {
    refused = {call.at, call.tick, record_name(tag), status};
    refused_.resize(1 + k_command_bytes_max);
    refused_[0] = record[0];
    Writer writer{refused_.data() + 1, k_command_bytes_max};
    code->visit(writer, command);
    refused_.resize(1 + writer.count);
    return Made::refused;
  }
  memcpy(&given, command, sizeof given);
  if (tag == RecordTag::create_body) keep_id(recorded, given);
  if (tag == RecordTag::create_joint)
    ids_.joints[{recorded.slot, recorded.generation}] = {given.slot, given.generation};
  return Made::good;
}

/// Makes the calls after `tick` completed ticks, up to a fault.
void CallPlayer::make_calls(Recorder& recorder, uint64_t tick, PlayedUnits& played) {
  for (; next_ < calls_.size() && !played.shows(); ++next_) {
    const ListedCall& call = list_.calls[calls_[next_] - list_.first_call()];
    if (call.tick != tick) return;
    RefusedCall refused;
    const Made made = make(recorder, call, refused);
    if (made == Made::refused) played.fault = fault_.refused(refused);
    if (!played.shows()) refused_.clear();
    if (made == Made::good || played.shows()) played.used.push_back(calls_[next_]);
  }
}

/// Notes a tick after which a shorter recording may start, and forgets earlier ticks if a later one leaves enough
/// ticks.
void CallPlayer::add_start(uint64_t tick) {
  starts_.push_back(tick);
  while (starts_.size() > 1 && starts_[1] + kept_ticks <= tick) starts_.pop_front();
}

PlayedUnits CallPlayer::play(const Units& units, RecordingBytes* recording) {
  PlayedUnits played;
  if (!start(units)) return played;
  played.used.assign(units.begin(), std::lower_bound(units.begin(), units.end(), list_.first_call()));
  uint8_t buffer[k_recording_buffer_bytes];
  Recorder recorder(world_, recording == nullptr ? Sink{} : recording->sink(), buffer, sizeof buffer);
  Status status = recorder.begin();
  for (uint64_t tick = list_.first; status == Status::ok; ++tick) {
    played.tick = tick;
    make_calls(recorder, tick, played);
    if (played.shows() || tick == list_.last) break;
    if (progress != nullptr && (tick - list_.first) % k_ticks_per_progress == 0)
      (*progress)(tick - list_.first, list_.last - list_.first);
    fault_.before_step(world_);
    const StepReport report = recorder.step();
    bool clean = true;
    played.fault = fault_.after_step(world_, report, clean);
    played.tick = report.tick;
    note_use(report, get_info(world_), played.use);
    if (played.shows()) break;
    if (clean) add_start(report.tick);
    status = recorder.status();
  }
  played.start = list_.first;
  for (const uint64_t tick : starts_) {
    if (tick + kept_ticks <= played.tick) played.start = tick;
  }
  played.digest = digest(world_);
  const StateView<const uint8_t> state = const_view_of(world_.block);
  played.body_slots = state.world.slots_used;
  played.joint_slots = state.world.joints_used;
  const WorldInfo info = get_info(world_);
  const uint32_t first_call = list_.first_call();
  const auto calls = std::lower_bound(played.used.begin(), played.used.end(), first_call);
  played.size = {played.tick - list_.first, info.bodies, info.joints, static_cast<uint64_t>(played.used.end() - calls),
                 0};
  finish(recorder, recording, played);
  return played;
}

/// Ends the recording. If the fault is the refusal of a call, this call is the last record.
void CallPlayer::finish(Recorder& recorder, RecordingBytes* recording, const PlayedUnits& played) {
  if (recording == nullptr) return;
  if (refused_.empty()) {
    recording->full = recorder.end() != Status::ok || recording->full;
    return;
  }
  recording->full = recorder.flush() != Status::ok || recording->full;
  recording->add(refused_.data(), static_cast<uint32_t>(refused_.size()), played.tick);
  recording->end(played.tick, {played.tick - list_.first, digest(world_)});
}

bool CallPlayer::list_from(const Units& units, uint64_t tick, CallList& later) {
  if (!start(units)) return false;
  Recorder recorder(world_, {}, nullptr, 0);
  PlayedUnits played;
  for (uint64_t now = list_.first; now < tick; ++now) {
    make_calls(recorder, now, played);
    if (played.shows()) return false;
    recorder.step();
  }
  later = {};
  later.first = tick;
  later.last = list_.last;
  later.records = list_.records;
  const auto recorded = std::make_shared<RecordedIds>(*list_.recorded);
  take_valid_ids(world_, ids_.bodies, later.ids.bodies, recorded->bodies);
  take_valid_ids(world_, ids_.joints, later.ids.joints, recorded->joints);
  later.recorded = recorded;
  for (; next_ < calls_.size(); ++next_) later.calls.push_back(list_.calls[calls_[next_] - list_.first_call()]);
  return save_seed(world_, later) == Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
