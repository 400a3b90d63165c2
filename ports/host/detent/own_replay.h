#pragma once
#include "reading.h"
#include "recorded.h"

/// What this machine makes of a recording, whatever digests it holds.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Makes the calls of a recording in a world of this machine's own, through a recorder.
class OwnReplay {
 public:
  /// `sink`: of the recorder; a null one records nothing.
  OwnReplay(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, Sink sink);
  OwnReplay(const OwnReplay&) = delete;

  /// Goes to the state after this tick, or of the seed if that is later: by the nearest keyframe, or from the seed if
  /// this machine's states differ before.
  bool begin(uint64_t tick);
  /// Makes the next tick, or the calls after the last one. False at the end, and if there is a problem.
  bool next();
  /// Goes on to the next digest that the recording holds: whether all that were passed are those of this machine.
  bool verified();

  Recorder& recorder() { return *recorder_; }
  World& world() { return world_.owned.world; }
  const RecordingInfo& info() const { return player_->info(); }

  std::string problem;
  bool refused = false;  ///< the problem is a call that this machine does not make, or makes in another way
  bool finished = false;
  bool compared = false;     ///< the recording holds a digest of the state of now
  uint64_t tick = 0;         ///< completed
  uint64_t first_other = 0;  ///< the first tick whose recorded digest is another; 0: none

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

/// What `trace` made.
struct TraceMade {
  std::string problem;       ///< it ends before its time; empty: it does not
  uint64_t ticks = 0;        ///< in the recording
  uint64_t last = 0;         ///< ticks completed at its end
  uint64_t first_other = 0;  ///< OwnReplay's, up to the first digest after the window
  uint64_t digest = 0;
};
/// A recording of the same calls, from the tick before the window to its end, with this machine's states.
TraceMade trace_to(const detent_tool::Recorded& recorded, const detent_tool::Assets& assets, const TraceDef& def,
                   Sink sink, const detent_tool::Progress& progress);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
