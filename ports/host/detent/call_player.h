#pragma once
#include <deque>

#include "call_list.h"
#include "delta_debugging.h"
#include "fault.h"
#include "recording_bytes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What came of playing some units of a list.
struct PlayedUnits {
  std::string fault;                         ///< the first fault; empty: none
  uint64_t tick = 0;                         ///< completed when it was found
  detent_tool::Units used;                   ///< the units that had an effect before
  uint64_t start = 0;                        ///< the last tick after which a shorter recording may start
  detent_tool::ShrinkSize size;              ///< except for bytes
  CapacityUse use;                           ///< of the steps
  uint32_t body_slots = 0, joint_slots = 0;  ///< slots used at any time
  uint64_t digest = 0;                       ///< of the state at the end

  bool shows() const { return !fault.empty(); }
};

/// Plays any units of a list. A call about a body or joint that is left out is left out, too, and so is a call that the
/// world refuses. Bodies get other ids than in the recording: the ids in the calls are replaced.
class CallPlayer {
 public:
  CallPlayer(const CallList& list, World& world, Fault& fault) : list_(list), world_(world), fault_(fault) {}

  /// Plays up to the first fault, or to the end of the list. `recording`: takes the recording; null: none is made.
  PlayedUnits play(const detent_tool::Units& units, RecordingBytes* recording = nullptr);
  /// Plays up to a tick, and lists what follows: the state then, and the calls of these units after it. Returns false
  /// if the state cannot be saved.
  bool list_from(const detent_tool::Units& units, uint64_t tick, CallList& later);

  const detent_tool::Progress* progress = nullptr;  ///< of play(), in ticks; null: not told
  uint64_t kept_ticks = 0;                          ///< from PlayedUnits::start to the fault, at least

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
  std::deque<uint64_t> starts_;   ///< clean ticks of which one can be PlayedUnits::start
  std::vector<uint32_t> calls_;   ///< the units that are calls
  size_t next_ = 0;               ///< into calls_
  std::vector<uint8_t> refused_;  ///< the record of the call whose refusal is the fault
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
