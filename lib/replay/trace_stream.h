#pragma once
#include "replay/archive.h"
#include "state/trace.h"

/// The trace of a tick as bytes: a record for each element of each stage, in the order of a step, and one that ends the
/// stage. They are cut into chunks without regard to their borders. docs/recording.md.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Instead of a part's number: the end of a stage.
inline constexpr uint32_t k_trace_stage_end = 0;

struct TraceRecord {
  uint64_t stage = 0;
  uint64_t part = k_trace_stage_end;
  uint64_t place = 0;  ///< of the element in its array; at a stage's end the number of elements
};
inline constexpr uint32_t k_trace_record_bytes = 6;
inline constexpr uint32_t k_trace_digest_bytes = 4;     ///< of an element, at TraceLevel::stages, after its key
inline constexpr uint32_t k_trace_stage_end_bytes = 8;  ///< the digest of the stage

inline void visit(Archive& archive, TraceRecord& record) {
  archive.bits("trace stage", record.stage, 1);
  archive.bits("trace part", record.part, 1);
  archive.bits("trace place", record.place, 4);
}

/// What follows a record, bytes.
constexpr uint32_t trace_payload_bytes(const TracePart* part, bool full) {
  if (part == nullptr) return k_trace_stage_end_bytes;
  return full ? part->element_bytes : 4 * part->key_words + k_trace_digest_bytes;
}

/// An element of a trace as it was read, or the end of a stage.
struct TraceElement {
  TraceStage stage = TraceStage::calls;
  const TracePart* part = nullptr;  ///< null: the end of the stage
  uint32_t place = 0;
  const uint8_t* bytes = nullptr;  ///< the element, or its key and digest; or the stage's digest
};

/// Reads the trace of a tick, from anywhere: what it gives lies within the bytes, of a known stage and part.
class TraceReader {
 public:
  TraceReader(const uint8_t* bytes, uint32_t count, bool full) : bytes_(bytes), count_(count), full_(full) {}
  /// The next element. False at the end, and if the bytes are no trace.
  bool next(TraceElement& element);
  /// Whether all was read, to the end of a stage, and stages came in order.
  bool whole() const { return at_ == count_ && !open_ && !failed_; }

 private:
  const uint8_t* bytes_;
  uint32_t count_;
  bool full_;
  uint32_t at_ = 0;
  uint64_t stage_ = 0;  ///< now
  bool open_ = false;   ///< elements were read, and the end of their stage was not
  bool failed_ = false;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
