#include "shrink_recording.h"

#include <detent/rollback.h>

#include <algorithm>
#include <numeric>

#include "call_player.h"
#include "file.h"
#include "text.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

/// Largest number of rounds of the search. When bodies are left out, the recording can perhaps start later, and then
/// more can perhaps be left out.
constexpr uint32_t k_rounds_max = 4;

Units all_units(const CallList& list) {
  Units all(list.unit_count());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// The search for the smallest recording: the list and the units that are left, which show the fault.
class ShrinkSearch {
 public:
  ShrinkSearch(const ShrinkRequest& request, CallList list, World& world, Fault& fault, const Progress& progress)
      : request_(request),
        list_(std::move(list)),
        world_(&world),
        fault_(fault),
        kept_ticks_(request.lead_ticks + (request.kind == FaultKind::status ? 0 : 1)),
        progress_(progress),
        trials_(request.replays_max) {}

  /// Plays the whole recording. Returns false if it does not show the fault.
  bool find() {
    if (!trials_.take()) return false;
    CallPlayer player = player_of(list_, *world_);
    player.progress = &progress_;
    const PlayedUnits played = player.play(all_units(list_));
    if (!played.shows()) return false;
    take(played);
    kept_ticks_ = std::min(kept_ticks_, played.tick - list_.first);
    fault_.settle();
    return true;
  }

  void search() {
    for (uint32_t round = 0; round < k_rounds_max && !trials_.limit_reached(); ++round) {
      const size_t units_before = units_.size();
      const bool later = start_later();
      for (const UnitKind kind : {UnitKind::body, UnitKind::joint, UnitKind::call}) leave_out(kind);
      if (!later && units_.size() == units_before) return;
    }
  }

  /// Replaces the world by a world of less capacity, if the units play in the same way there. The reason: the capacity
  /// determines the size of a recording's seed.
  void fit_capacity() {
    CallList fitted;
    if (!trials_.take() || !player_of(list_, *world_).list_from(units_, list_.first, fitted)) return;
    const Capacity now = get_info(*world_).capacity;
    WorldDef def;
    def.capacity = suggest_capacity(played_.use, now);
    def.capacity.bodies = std::max(played_.body_slots, 1u);
    def.capacity.joints = played_.joint_slots;
    def.capacity.contacts = std::min(def.capacity.contacts, now.contacts);
    def.capacity.sensed = std::min(def.capacity.sensed, now.sensed);
    if (fitted_.create(def, world_->hooks.assets) != Status::ok || copy_world(*world_, fitted_.world) != Status::ok ||
        save_seed(fitted_.world, fitted) != Status::ok) {
      return;
    }
    if (!trials_.take()) return;
    const PlayedUnits played = player_of(fitted, fitted_.world).play(all_units(fitted));
    if (played.fault != played_.fault || played.tick != played_.tick || played.digest != played_.digest) return;
    list_ = std::move(fitted);
    world_ = &fitted_.world;
    take(played);
  }

  PlayedUnits write(RecordingBytes& recording) { return player_of(list_, *world_).play(units_, &recording); }

  const PlayedUnits& played() const { return played_; }
  const Trials& trials() const { return trials_; }

 private:
  CallPlayer player_of(const CallList& list, World& world) const {
    CallPlayer player(list, world, fault_);
    player.kept_ticks = kept_ticks_;
    return player;
  }

  /// Plays units of the list. If they show the fault, takes them as the units that are left.
  bool shows(const Units& units) {
    progress_(trials_.made(), request_.replays_max);
    const PlayedUnits played = player_of(list_, *world_).play(units);
    if (!played.shows() || !has_lead(list_, played)) return false;
    take(played);
    return true;
  }

  /// Whether at least kept_ticks_ ticks precede the fault. It may come earlier than in the given recording.
  bool has_lead(const CallList& list, const PlayedUnits& played) const {
    return played.tick - list.first >= kept_ticks_;
  }

  void take(const PlayedUnits& played) {
    played_ = played;
    units_ = played.used;
    list_.last = played.tick;
  }

  /// Tries to start the recording later: at the last start that leaves kept_ticks_ ticks before the fault.
  bool start_later() {
    const uint64_t start = played_.start;
    CallList later;
    if (start == list_.first || !trials_.take() || !player_of(list_, *world_).list_from(units_, start, later))
      return false;
    if (!trials_.take()) return false;
    const PlayedUnits played = player_of(later, *world_).play(all_units(later));
    if (!played.shows() || !has_lead(later, played)) return false;
    list_ = std::move(later);
    trials_.forget();
    take(played);
    return true;
  }

  void leave_out(UnitKind kind) {
    Units own, others;
    for (const uint32_t unit : units_) (list_.kind_of(unit) == kind ? own : others).push_back(unit);
    minimise(own, others, trials_, [this](const Units& units) { return shows(units); });
  }

  const ShrinkRequest& request_;
  CallList list_;
  World* world_;
  Fault& fault_;
  /// Least number of ticks from the start to the fault. Includes the step that shows the fault, if the fault is not the
  /// refusal of a call.
  uint64_t kept_ticks_;
  const Progress& progress_;
  OwnedWorld fitted_;
  Trials trials_;
  Units units_;
  PlayedUnits played_;
};

/// Whether the recording verifies and shows the fault again, at its last tick. If the fault is the refusal of a call,
/// the replay must end at this call instead, and the call must be the last.
bool shows_again(const ShrinkRequest& request, const std::shared_ptr<std::vector<uint8_t>>& bytes, Fault& fault,
                 const PlayedUnits& written) {
  Recorded recorded;
  recorded.bytes = bytes;
  std::string problem;
  const std::unique_ptr<Input> input = recorded.open(problem);
  ReplayWorld replayed;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(source_of(*input), buffer, sizeof buffer);
  if (player.open() != Status::ok || replayed.create(player.info(), *input, request.reading.assets) != Status::ok)
    return false;
  Status status = player.start(replayed.owned.world);
  for (TickResult result; status == Status::ok && !result.finished;)
    status = player.next_tick(replayed.owned.world, result);
  const bool refused = status == Status::digest_differs && player.error().field == std::string("call refused");
  if (request.kind == FaultKind::status ? !refused : status != Status::ok) return false;
  CallReading reading;
  read_calls(recorded, request.reading.assets, reading);
  if (!reading.problem.empty() || !reading.damage.empty()) return false;
  const std::unique_ptr<Fault> unsettled = make_fault(request);  // `fault` knows the call by its old place
  Fault& same = request.kind == FaultKind::status ? *unsettled : fault;
  same.body_slot = fault.body.slot;  // the slot of the body in this recording
  const PlayedUnits played = CallPlayer(reading.list, reading.world.owned.world, same).play(all_units(reading.list));
  return played.fault == written.fault && played.tick == written.tick;
}

}  // namespace

std::string write_shrunk(const ShrinkRequest& request, const std::vector<uint8_t>& bytes, Shrunk& shrunk) {
  std::string problem;
  const std::unique_ptr<Output> output =
      Output::open(request.output, ends_with(request.output, k_compressed_suffix), problem);
  if (output == nullptr) return request.output + " " + problem;
  if (!output->write(bytes.data(), static_cast<uint32_t>(bytes.size())) || !output->close())
    return with_reason(request.output + " cannot be written");
  shrunk.after.bytes = output->file_bytes;
  return "";
}

Outcome shrink(const ShrinkRequest& request, Shrunk& shrunk, const Progress& progress) {
  Recorded recorded;
  recorded.path = request.reading.path;
  if (request.kind == FaultKind::differs) return shrink_difference(request, recorded, shrunk, progress);
  CallReading reading;
  read_calls(recorded, request.reading.assets, reading);
  if (!reading.problem.empty()) {
    Outcome outcome = failed(reading.problem);
    outcome.other_config = reading.other_config;
    return outcome;
  }
  const std::unique_ptr<Fault> fault = make_fault(request);
  World& world = reading.world.owned.world;
  const uint64_t last = reading.list.last;
  ShrinkSearch search(request, std::move(reading.list), world, *fault, progress);
  const bool found = search.find();
  shrunk.replays = search.trials().made();
  if (!found) {
    const std::string none = "shows no " + fault->name() + " up to tick " + std::to_string(last);
    return failed(reading.damage.empty() ? none : reading.damage + "; " + none);
  }
  shrunk.before = search.played().size;
  shrunk.before.bytes = file_bytes(request.reading.path);
  shrunk.tick_before = search.played().tick;
  search.search();
  search.fit_capacity();
  shrunk.replays = search.trials().made();
  shrunk.limit_reached = search.trials().limit_reached();
  RecordingBytes bytes;
  const PlayedUnits written = search.write(bytes);
  if (bytes.full) return failed("what remains is too large");
  const auto shared = std::make_shared<std::vector<uint8_t>>(std::move(bytes.bytes));
  if (!shows_again(request, shared, *fault, written)) return failed("the smaller recording does not show the fault");
  shrunk.after = written.size;
  shrunk.fault = written.fault;
  shrunk.tick = written.tick;
  Outcome outcome;
  outcome.problem = write_shrunk(request, *shared, shrunk);
  return outcome.problem.empty() ? outcome : failed(outcome.problem);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
