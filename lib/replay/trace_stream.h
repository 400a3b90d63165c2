#pragma once
#include "replay/archive.h"
#include "state/trace.h"

/// The trace of a tick as bytes: a record for each element of each stage, in the order of a step, and a record that
/// ends each stage. Chunk borders may lie within records. Format: docs/recording.md.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// TraceRecord::part of the record that ends a stage.
inline constexpr uint32_t k_trace_stage_end = 0;

struct TraceRecord {
  uint64_t stage = 0;
  uint64_t part = k_trace_stage_end;
  uint64_t place = 0;  ///< index of the element in its array; at a stage's end the number of elements
};
inline constexpr uint32_t k_trace_record_bytes = 6;
inline constexpr uint32_t k_trace_digest_bytes = 4;     ///< at TraceLevel::stages: an element's digest, after its key
inline constexpr uint32_t k_trace_stage_end_bytes = 8;  ///< the digest of the stage

inline void visit(Archive& archive, TraceRecord& record) {
  archive.bits("trace stage", record.stage, 1);
  archive.bits("trace part", record.part, 1);
  archive.bits("trace place", record.place, 4);
}

/// The number of bytes of the data that follow a record.
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

/// Reads the trace of a tick from untrusted bytes. The elements that next() gives lie within the bytes and have a known
/// stage and part.
class TraceReader {
 public:
  TraceReader(const uint8_t* bytes, uint32_t count, bool full) : bytes_(bytes), count_(count), full_(full) {}
  /// Reads the next element, or the end of a stage. Returns false at the end of the bytes, or if the bytes are not a
  /// valid trace.
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
