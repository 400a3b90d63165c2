#pragma once
#include <deque>

#include "call_list.h"
#include "delta_debugging.h"
#include "fault.h"
#include "recording_bytes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The result of playing some units of a list.
struct PlayedUnits {
  std::string fault;                         ///< the first fault; empty: none
  uint64_t tick = 0;                         ///< ticks completed when the fault was found
  detent_tool::Units used;                   ///< the units that had an effect before the fault
  uint64_t start = 0;                        ///< the last tick after which a shorter recording may start
  detent_tool::ShrinkSize size;              ///< without `bytes`
  CapacityUse use;                           ///< of the played steps
  uint32_t body_slots = 0, joint_slots = 0;  ///< slots used at any time
  uint64_t digest = 0;                       ///< of the state at the end

  bool shows() const { return !fault.empty(); }
};

/// Plays any units of a list. If a body or joint is left out, the calls about it are left out, too, and so are calls
/// that the world refuses. Bodies get other ids than in the recording, so the player replaces the ids in the calls.
class CallPlayer {
 public:
  CallPlayer(const CallList& list, World& world, Fault& fault) : list_(list), world_(world), fault_(fault) {}

  /// Plays up to the first fault, or to the end of the list. `recording`: receives a recording; null: no
  /// recording is written.
  PlayedUnits play(const detent_tool::Units& units, RecordingBytes* recording = nullptr);
  /// Plays up to a tick. Sets `later` to the list from there on: the state at that tick, and the later calls among
  /// `units`. Returns false if a fault occurs before that tick, or if the state cannot be loaded or saved.
  bool list_from(const detent_tool::Units& units, uint64_t tick, CallList& later);

  const detent_tool::Progress* progress = nullptr;  ///< called by play() with numbers of ticks; null: not called
  uint64_t kept_ticks = 0;                          ///< least number of ticks from PlayedUnits::start to the fault

 private:
  enum class Made : uint32_t { left_out, refused, good };

  bool start(const detent_tool::Units& units);
  void add_start(uint64_t tick);
  void make_calls(Recorder& recorder, uint64_t tick, PlayedUnits& played);
  Made make(Recorder& recorder, const ListedCall& call, RefusedCall& refused);
  bool replace_ids(uint8_t tag, void* command) const;
  void keep_id(BodyId recorded, BodyId given);
  void finish(Recorder& recorder, RecordingBytes* recording, const PlayedUnits& played);

  const CallList& list_;
  World& world_;
  Fault& fault_;
  IdMap ids_;
  std::deque<uint64_t> starts_;   ///< ticks from which PlayedUnits::start is chosen
  std::vector<uint32_t> calls_;   ///< the units that are calls
  size_t next_ = 0;               ///< index of the next call in calls_
  std::vector<uint8_t> refused_;  ///< the record of the call whose refusal is the fault
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
