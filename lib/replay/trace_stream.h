#pragma once
#include "replay/archive.h"
#include "state/trace.h"

/// The trace of a tick as bytes. In the order of a step, each stage has a record for each of its elements, and a record
/// that ends the stage. Data follow each record. A record may continue in the next chunk. Format: docs/recording.md.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// TraceRecord::part of the record that ends a stage.
inline constexpr uint32_t k_trace_stage_end = 0;

/// The head of an element or of a stage's end. The data follow it (trace_payload_bytes()).
struct TraceRecord {
  uint64_t stage = 0;
  uint64_t part = k_trace_stage_end;
  uint64_t place = 0;  ///< index of the element in its array; at a stage's end: the number of the stage's elements
};
inline constexpr uint32_t k_trace_record_bytes = 6;
inline constexpr uint32_t k_trace_digest_bytes = 4;     ///< at TraceLevel::stages: size of an element's digest
inline constexpr uint32_t k_trace_stage_end_bytes = 8;  ///< size of a stage's digest

inline void visit(Archive& archive, TraceRecord& record) {
  archive.bits("trace stage", record.stage, 1);
  archive.bits("trace part", record.part, 1);
  archive.bits("trace place", record.place, 4);
}

/// Returns the number of bytes of the data that follow a record. `part`: the element's part; null for the end of a
/// stage. `full`: whether the trace has TraceLevel::full.
constexpr uint32_t trace_payload_bytes(const TracePart* part, bool full) {
  if (part == nullptr) return k_trace_stage_end_bytes;
  return full ? part->element_bytes : 4 * part->key_words + k_trace_digest_bytes;
}

/// An element that was read from a trace, or the end of a stage.
struct TraceElement {
  TraceStage stage = TraceStage::calls;
  const TracePart* part = nullptr;  ///< null: the end of the stage
  uint32_t place = 0;
  const uint8_t* bytes = nullptr;  ///< the element, or its key and digest; or the stage's digest
};

/// Reads the trace of a tick from untrusted bytes. Each element that next() returns lies within these bytes, and has a
/// known stage and part.
class TraceReader {
 public:
  TraceReader(const uint8_t* bytes, uint32_t count, bool full) : bytes_(bytes), count_(count), full_(full) {}
  /// Sets `element` to the next element, or to the end of a stage. Returns false at the end of the bytes, or if the
  /// bytes are not a valid trace.
  bool next(TraceElement& element);
  /// Whether all bytes were read, the last stage is complete, and the stages are in order.
  bool whole() const { return at_ == count_ && !open_ && !failed_; }

 private:
  const uint8_t* bytes_;
  uint32_t count_;
  bool full_;
  uint32_t at_ = 0;
  uint64_t stage_ = 0;  ///< the current stage
  bool open_ = false;   ///< elements of the stage were read, but not its end
  bool failed_ = false;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
