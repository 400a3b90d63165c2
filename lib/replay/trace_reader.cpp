#include "replay/trace_stream.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

bool TraceReader::next(TraceElement& element) {
  if (failed_ || at_ == count_) return false;
  TraceRecord record;
  Reader reader{bytes_, count_, at_};
  visit(reader, record);
  const TracePart* const part =
      record.part == k_trace_stage_end ? nullptr : find_trace_part(static_cast<uint32_t>(record.part));
  const bool known = part != nullptr || record.part == k_trace_stage_end;
  const uint32_t bytes = trace_payload_bytes(part, full_);
  failed_ = reader.failed != nullptr || !known || record.stage >= k_trace_stage_count || record.stage < stage_ ||
            (open_ && record.stage != stage_) || bytes > count_ - reader.at;
  if (failed_) return false;
  element = {static_cast<TraceStage>(record.stage), part, static_cast<uint32_t>(record.place), bytes_ + reader.at};
  open_ = part != nullptr;
  stage_ = open_ ? record.stage : record.stage + 1;
  at_ = reader.at + bytes;
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
