#include "replay/tracer.h"

#include <string.h>

#include "base/digest.h"
#include "replay/format.h"
#include "replay/trace_stream.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Writes the trace of a tick to the recorder's buffer, and from there in chunks. The buffer is empty before and after
/// the trace.
struct TraceWriter {
  Recorder& recorder;
  const StepObserver* before = nullptr;  ///< the observer that the world had before the trace
  TraceStage stage = TraceStage::calls;
  uint32_t elements = 0;
  uint64_t digest = 0;

  bool full() const { return recorder.trace_.level == TraceLevel::full; }

  void flush() {
    const ChunkType type = full() ? ChunkType::state : ChunkType::stages;
    if (recorder.payload_count_ != 0) recorder.write_chunk(static_cast<uint32_t>(type), recorder.payload_count_);
    recorder.payload_count_ = 0;
  }

  void put(const uint8_t* bytes, uint32_t count) {
    while (count != 0) {
      const uint32_t room = k_chunk_payload_bytes_max - recorder.payload_count_;
      const uint32_t piece = count < room ? count : room;
      memcpy(recorder.buffer_ + k_chunk_header_bytes + recorder.payload_count_, bytes, piece);
      recorder.payload_count_ += piece;
      bytes += piece;
      count -= piece;
      if (recorder.payload_count_ == k_chunk_payload_bytes_max) flush();
    }
  }

  void put_record(uint32_t part, uint32_t place) {
    TraceRecord record = {static_cast<uint64_t>(stage), part, place};
    uint8_t bytes[k_trace_record_bytes];
    Writer writer{bytes, sizeof bytes};
    visit(writer, record);
    put(bytes, writer.count);
  }

  void put_digest(uint64_t value, uint32_t count) {
    uint8_t bytes[k_trace_stage_end_bytes];
    Writer writer{bytes, sizeof bytes};
    writer.bits("trace digest", value, count);
    put(bytes, writer.count);
  }

  static void take(void* context, const TracePart& part, uint32_t place, const uint8_t* bytes) {
    TraceWriter& writer = *static_cast<TraceWriter*>(context);
    const uint64_t own = trace_digest(part, place, bytes);
    writer.digest += own;
    ++writer.elements;
    writer.put_record(part.number, place);
    if (writer.full()) return writer.put(bytes, part.element_bytes);
    writer.put(bytes, 4 * part.key_words);
    writer.put_digest(digest_fold(own), k_trace_digest_bytes);
  }

  void write(TraceStage ended, uint32_t contacts) {
    stage = ended;
    elements = 0;
    digest = 0;
    visit_trace(recorder.world_, stage, contacts, {take, this});
    put_record(k_trace_stage_end, elements);
    put_digest(digest, k_trace_stage_end_bytes);
  }

  static void stage_ended(void* context, const World& world, StepStage ended, uint32_t contacts) {
    TraceWriter& writer = *static_cast<TraceWriter*>(context);
    if (writer.before != nullptr && writer.before->stage_ended != nullptr) {
      writer.before->stage_ended(writer.before->context, world, ended, contacts);
    }
    writer.write(trace_stage(ended), contacts);
  }

  static StepReport step(Recorder& recorder) {
    recorder.flush_records();
    recorder.chunk_tick_ = recorder.tick_;
    TraceWriter writer{recorder, recorder.world_.hooks.observer};
    writer.write(TraceStage::calls, 0);
    const StepObserver observer = {stage_ended, &writer};
    recorder.world_.hooks.observer = &observer;
    const StepReport report = detent::step(recorder.world_);
    recorder.world_.hooks.observer = writer.before;
    writer.write(TraceStage::end, 0);
    writer.flush();
    return report;
  }
};

const Tracer k_tracer = {TraceWriter::step};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
