#pragma once
#include <vector>

#include "replay/format.h"

/// Recordings as bytes, with records that a Recorder does not write: calls that the world refuses, and digests of
/// another machine.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A recording in memory: first the bytes that a Recorder writes, then chunks that this class appends.
class RecordingBytes {
 public:
  /// The sink for a Recorder that writes the first part.
  Sink sink();
  /// Buffers a record: its tag and fields.
  void add(const uint8_t* record, uint32_t count, uint64_t tick);
  /// Buffers the record of a step, which completes `tick` + 1 ticks. `digest`: null: no digest is recorded.
  void add_tick(uint64_t tick, const uint64_t* digest);
  /// Appends the buffered records and the end chunk to `bytes`.
  void end(uint64_t tick, const Ending& ending);

  std::vector<uint8_t> bytes;
  bool full = false;  ///< the recording exceeds k_whole_file_bytes_max; `bytes` ends early

 private:
  void flush();
  void append(const uint8_t* chunk, uint32_t count);

  uint32_t sequence_ = UINT32_MAX;  ///< of the next chunk; UINT32_MAX until the Recorder has written the header
  std::vector<uint8_t> payload_;
  uint64_t payload_tick_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
