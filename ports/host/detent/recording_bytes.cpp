#include "recording_bytes.h"

#include <string.h>

#include "file.h"
#include "replay/command.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

void RecordingBytes::append(const uint8_t* chunk, uint32_t count) {
  if (bytes.size() + count > detent_tool::k_whole_file_bytes_max) full = true;
  if (full) return;
  bytes.insert(bytes.end(), chunk, chunk + count);
  ++sequence_;
}

Sink RecordingBytes::sink() {
  return {[](void* self, const uint8_t* chunk, uint32_t count) {
            static_cast<RecordingBytes*>(self)->append(chunk, count);
            return static_cast<RecordingBytes*>(self)->full ? Status::sink_failed : Status::ok;
          },
          this};
}

void RecordingBytes::add(const uint8_t* record, uint32_t count, uint64_t tick) {
  if (payload_.size() + count > k_chunk_payload_bytes_max) flush();
  if (payload_.empty()) payload_tick_ = tick;
  payload_.insert(payload_.end(), record, record + count);
}

void RecordingBytes::add_tick(uint64_t tick, const uint64_t* digest) {
  uint8_t record[1 + sizeof(TickDigested)] = {static_cast<uint8_t>(RecordTag::tick)};
  Writer writer{record + 1, sizeof record - 1};
  if (digest != nullptr) {
    record[0] = static_cast<uint8_t>(RecordTag::tick_digested);
    TickDigested command{*digest};
    visit(writer, command);
  }
  add(record, 1 + writer.count, tick);
}

void RecordingBytes::flush() {
  if (payload_.empty()) return;
  uint8_t buffer[k_recording_buffer_bytes];
  memcpy(buffer + k_chunk_header_bytes, payload_.data(), payload_.size());
  const ChunkHeader header = {static_cast<uint64_t>(ChunkType::calls), payload_.size(), sequence_, payload_tick_};
  append(buffer, make_chunk(buffer, header));
  payload_.clear();
}

void RecordingBytes::end(uint64_t tick, const Ending& ending) {
  flush();
  uint8_t buffer[k_recording_buffer_bytes];
  append(buffer, make_end(buffer, ending, sequence_, tick));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
