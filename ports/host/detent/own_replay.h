#pragma once
#include "reading.h"
#include "recorded.h"

/// Replays a recording on this machine, without regard to the recorded digests.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Makes the calls of a recording in a world of its own, through a recorder.
class OwnReplay {
 public:
  /// `sink`: the recorder's sink; a null sink records nothing.
  OwnReplay(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, Sink sink);
  OwnReplay(const OwnReplay&) = delete;

  /// Goes to the state after this tick, or to the seed if that is later. Uses the nearest keyframe, or the seed if this
  /// machine's states differ before that keyframe.
  bool begin(uint64_t tick);
  /// Makes the next tick, or the calls after the last one. False at the end, and on a problem.
  bool next();
  /// Goes on to the next recorded digest. Returns whether all digests so far equal this machine's.
  bool verified();

  Recorder& recorder() { return *recorder_; }
  World& world() { return world_.owned.world; }
  const RecordingInfo& info() const { return player_->info(); }

  std::string problem;
  bool refused = false;  ///< the problem: a call fails here, or gives another id
  bool finished = false;
  bool compared = false;     ///< the recording has a digest of the present state
  uint64_t tick = 0;         ///< completed
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
  uint64_t first_other = 0;  ///< OwnReplay's, up to the first digest after the window
  uint64_t digest = 0;
};
/// Writes a recording of the same calls, from the tick before the window to its end, with this machine's states.
TraceMade trace_to(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, const TraceDef& def,
                   Sink sink, const detent_tool::Progress& progress);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
