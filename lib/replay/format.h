#pragma once
#include <detent/recording.h>

#include "base/crc.h"
#include "replay/archive.h"

/// The frame of a recording: a header, chunks, and a chunk that ends the recording (docs/recording.md).
namespace detent {
inline namespace DETENT_NAMESPACE {

constexpr uint32_t k_magic_bytes = 8;
/// The first eight bytes of a recording. They contain a byte above 127, both kinds of line end and an end-of-file mark,
/// so that a transfer in text mode damages them.
inline constexpr uint8_t k_recording_magic[k_magic_bytes] = {0x89, 'D', 'T', 'R', '\r', '\n', 0x1a, '\n'};

constexpr uint32_t k_version_bytes = 4;  ///< size of the format version; in every version it follows the magic
constexpr uint32_t k_info_bytes = 60;    ///< size of the header's fields (RecordingInfo)
constexpr uint32_t k_checksum_bytes = 4;
constexpr uint32_t k_header_bytes = k_magic_bytes + k_info_bytes + k_checksum_bytes;

/// Offsets, bytes, of those header fields that can make a reader refuse a recording although the checksum is correct.
constexpr uint32_t k_simulation_at = 12;
constexpr uint32_t k_config_at = 16;
constexpr uint32_t k_capacity_at = 20;
constexpr uint32_t k_snapshot_bytes_at = 48;

constexpr uint32_t k_chunk_header_bytes = 16;
constexpr uint32_t k_chunk_payload_bytes_max = 512;
static_assert(k_chunk_header_bytes + k_chunk_payload_bytes_max + k_checksum_bytes <= k_recording_buffer_bytes);

/// The type of a chunk. The values are stored in files, so a value that is no longer used is never given to another
/// type.
enum class ChunkType : uint32_t {
  seed = 1,           ///< a piece of the first state's snapshot; the pieces are in order
  calls = 2,          ///< whole records (command.h)
  end = 3,            ///< the last chunk (Ending)
  keyframe = 0x8001,  ///< a piece of a later state's digest and snapshot; the pieces are in order
  stages = 0x8002,    ///< a piece of a tick's trace at TraceLevel::stages (trace_stream.h); precedes the tick's record
  state = 0x8003,     ///< as `stages`, but at TraceLevel::full
};
/// A bit of the chunk type. A reader skips a chunk of an unknown type with this bit, and refuses a chunk of an unknown
/// type without it.
constexpr uint32_t k_chunk_optional = 0x8000;

struct ChunkHeader {
  uint64_t type = 0;
  uint64_t payload_count = 0;
  uint64_t sequence = 0;  ///< number of the chunk; 0 for the first
  uint64_t tick = 0;      ///< number of ticks completed before the contents of the chunk
};

inline void visit(Archive& archive, ChunkHeader& header) {
  archive.bits("chunk type", header.type, 2);
  archive.bits("chunk length", header.payload_count, 2);
  archive.bits("chunk sequence", header.sequence, 4);
  archive.bits("chunk tick", header.tick, 8);
}

/// The payload of the chunk that ends a recording.
struct Ending {
  uint64_t ticks = 0;   ///< number of ticks in the recording
  uint64_t digest = 0;  ///< of the final state
};

inline void visit(Archive& archive, Ending& ending) {
  archive.bits("tick count", ending.ticks, 8);
  archive.bits("final digest", ending.digest, 8);
}

template <class Enum>
void visit_header_choice(Archive& archive, const char* name, Enum& value, Enum first, Enum last) {
  uint32_t word = static_cast<uint32_t>(value);
  visit_word(archive, name, word);
  archive.require(name, word >= static_cast<uint32_t>(first) && word <= static_cast<uint32_t>(last),
                  Status::bad_argument);
  value = static_cast<Enum>(word);
}

inline void visit(Archive& archive, RecordingInfo& info) {
  visit_word(archive, "format version", info.format_version);
  visit_word(archive, "simulation version", info.simulation_version);
  visit_header_choice(archive, "configuration", info.config, Config::fx64, Config::f64);
  visit_word(archive, "body capacity", info.capacity.bodies);
  visit_word(archive, "contact capacity", info.capacity.contacts);
  visit_word(archive, "asset capacity", info.capacity.assets);
  visit_header_choice(archive, "trace level", info.trace_level, TraceLevel::digests, TraceLevel::full);
  visit_word(archive, "digest interval", info.digest_interval);
  archive.bits("tick", info.tick, 8);
  visit_word(archive, "snapshot bytes", info.snapshot_bytes);
  constexpr uint32_t k_no_manifolds = 1;
  uint32_t flags = info.capacity.manifolds ? 0 : k_no_manifolds;
  visit_word(archive, "flags", flags);
  archive.require("flags", flags <= k_no_manifolds, Status::bad_argument);
  info.capacity.manifolds = (flags & k_no_manifolds) == 0;
  visit_word(archive, "joint capacity", info.capacity.joints);
  visit_word(archive, "sensed capacity", info.capacity.sensed);
  visit_word(archive, "keyframe interval", info.keyframe_interval);
}

constexpr uint32_t k_keyframe_digest_bytes = 8;  ///< size of the digest that precedes the snapshot in a keyframe

/// Whether an action that is done every `interval` ticks is due after `tick` completed ticks; false for interval 0.
constexpr bool is_due(uint32_t interval, uint64_t tick) { return interval != 0 && tick % interval == 0; }

/// read_checksum() reads the CRC-32 at `bytes`; write_checksum() writes it.
inline uint32_t read_checksum(const uint8_t* bytes) {
  uint32_t checksum = 0;
  Reader reader{bytes, k_checksum_bytes};
  visit_word(reader, "checksum", checksum);
  return checksum;
}
inline void write_checksum(uint8_t* bytes, uint32_t checksum) {
  Writer writer{bytes, k_checksum_bytes};
  visit_word(writer, "checksum", checksum);
}

/// Makes a chunk in `buffer`, which already holds the payload after the space for the header: writes the header before
/// it and the checksum after it. Returns the length of the chunk, bytes.
inline uint32_t make_chunk(uint8_t* buffer, ChunkHeader header) {
  Writer writer{buffer, k_chunk_header_bytes};
  visit(writer, header);
  const uint32_t count = k_chunk_header_bytes + static_cast<uint32_t>(header.payload_count);
  write_checksum(buffer + count, crc32(buffer, count));
  return count + k_checksum_bytes;
}

/// Makes the chunk that ends a recording in `buffer`. Returns its length, bytes.
inline uint32_t make_end(uint8_t* buffer, Ending ending, uint32_t sequence, uint64_t tick) {
  Writer writer{buffer + k_chunk_header_bytes, k_chunk_payload_bytes_max};
  visit(writer, ending);
  return make_chunk(buffer, {static_cast<uint64_t>(ChunkType::end), writer.count, sequence, tick});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
