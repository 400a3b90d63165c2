#pragma once
#include "reading.h"
#include "recorded.h"

/// Replays a recording on this machine, and goes on if the recorded digests differ.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Makes the calls of a recording in a new world, through a recorder.
class OwnReplay {
 public:
  /// `sink`: the recorder's sink; a null sink records nothing.
  OwnReplay(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, Sink sink);
  OwnReplay(const OwnReplay&) = delete;

  /// Goes to the state after `tick`, or to the seed if the seed is later. Starts from the nearest keyframe. If this
  /// machine's digests differ from the recorded ones before `tick`, starts from the seed. Returns false on a problem.
  bool begin(uint64_t tick);
  /// Plays the next tick, or, after the last tick, the calls that follow it. Returns false at the end, and on a
  /// problem.
  bool next();
  /// Goes on to the next recorded digest. Returns whether all recorded digests so far equal this machine's.
  bool verified();

  Recorder& recorder() { return *recorder_; }
  World& world() { return world_.owned.world; }
  const RecordingInfo& info() const { return player_->info(); }

  std::string problem;
  bool refused = false;  ///< the problem is a call that fails on this machine, or gives another id
  bool finished = false;
  bool compared = false;     ///< the recording has a digest of the present state
  uint64_t tick = 0;         ///< number of completed ticks
  uint64_t first_other = 0;  ///< the first tick whose recorded digest differs; 0: none

 private:
  bool open();
  bool fail(const std::string& why);
  static void called(void* context, const uint8_t* record, uint32_t count);
  void call(const uint8_t* record, uint32_t count);

  detent_tool::Recorded recorded_;
  const detent_tool::Assets& assets_;
  Sink sink_;
  std::unique_ptr<detent_tool::Input> input_;
  uint8_t reading_[k_recording_buffer_bytes], writing_[k_recording_buffer_bytes];
  std::unique_ptr<Player> player_;
  ReplayWorld world_;
  std::unique_ptr<Recorder> recorder_;
};

/// The result of trace_to().
struct TraceMade {
  std::string problem;       ///< the reason of an early end; empty: none
  uint64_t ticks = 0;        ///< in the recording
  uint64_t last = 0;         ///< ticks completed at its end
  uint64_t first_other = 0;  ///< OwnReplay::first_other, up to the first digest after the window
  uint64_t digest = 0;
};
/// Writes a recording of the same calls, from the tick before the window of `def` to the end of the window, with traces
/// of this machine's states.
TraceMade trace_to(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, const TraceDef& def,
                   Sink sink, const detent_tool::Progress& progress);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
