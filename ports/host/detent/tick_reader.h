#pragma once
#include "reading.h"
#include "recorded.h"
#include "replay/format.h"
#include "tick_trace.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Reads a recording tick by tick, without a world.
class TickReader {
 public:
  explicit TickReader(const detent_tool::Recorded& recorded);
  TickReader(const TickReader&) = delete;

  /// Reads the next tick, or, after the last tick, the end. Returns false at the end, and on a problem.
  bool next();
  const RecordingInfo& info() const { return player_->info(); }

  std::string problem;
  bool other_config = false;                ///< the problem is another configuration
  bool finished = false;                    ///< all ticks were read; the other members describe the end
  uint64_t tick = 0;                        ///< number of completed ticks
  std::vector<std::vector<uint8_t>> calls;  ///< records of the calls before the tick
  TickTrace trace;                          ///< of the tick
  bool compared = false;
  uint64_t digest = 0;  ///< valid if `compared`

 private:
  std::unique_ptr<detent_tool::Input> input_;
  uint8_t buffer_[k_recording_buffer_bytes];
  std::unique_ptr<Player> player_;
  std::vector<uint8_t> traced_;
  ChunkType type_ = ChunkType::end;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
