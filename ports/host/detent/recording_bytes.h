#pragma once
#include <vector>

#include "replay/format.h"

/// Recordings as bytes, with records that a Recorder does not write: calls that are refused, digests of another
/// machine.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A recording in memory: first as a Recorder writes it, then chunks that are appended.
class RecordingBytes {
 public:
  /// For a Recorder.
  Sink sink();
  /// Buffers a record: its tag and fields.
  void add(const uint8_t* record, uint32_t count, uint64_t tick);
  /// Buffers the record of a step, which completes `tick` + 1 ticks. `digest`: null: not recorded.
  void add_tick(uint64_t tick, const uint64_t* digest);
  /// Writes what is buffered, and the end.
  void end(uint64_t tick, const Ending& ending);

  std::vector<uint8_t> bytes;
  bool full = false;  ///< it would have more bytes than the tool reads whole; the bytes end early

 private:
  void flush();
  void append(const uint8_t* chunk, uint32_t count);

  uint32_t sequence_ = UINT32_MAX;  ///< of the next chunk; the Recorder's first write is the header
  std::vector<uint8_t> payload_;
  uint64_t payload_tick_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
