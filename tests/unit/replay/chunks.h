#pragma once
#include "base/crc.h"
#include "match.h"
#include "replay/format.h"

/// Splits a recording into its chunks, so that a test can change them, and joins them again with correct checksums.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Chunk {
  uint32_t type = 0;
  uint64_t tick = 0;
  Bytes payload;
};

struct Parts {
  Bytes header;  ///< without its checksum
  std::vector<Chunk> chunks;
};

template <class T>
void erase_at(std::vector<T>& items, uint32_t index) {
  items.erase(items.begin() + static_cast<std::ptrdiff_t>(index));
}
template <class T>
void insert_at(std::vector<T>& items, uint32_t index, const T& item) {
  items.insert(items.begin() + static_cast<std::ptrdiff_t>(index), item);
}

inline uint64_t little_endian(const uint8_t* bytes, uint32_t count) {
  uint64_t value = 0;
  for (uint32_t i = 0; i < count; ++i) value |= static_cast<uint64_t>(bytes[i]) << (8 * i);
  return value;
}

inline void append(Bytes& bytes, uint64_t value, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

inline Parts take_apart(const Bytes& recording) {
  Parts parts;
  const uint8_t* bytes = recording.data();
  parts.header.assign(bytes, bytes + k_header_bytes - k_checksum_bytes);
  for (size_t at = k_header_bytes; at < recording.size();) {
    Chunk chunk;
    const uint32_t count = static_cast<uint32_t>(little_endian(bytes + at + 2, 2));
    chunk.type = static_cast<uint32_t>(little_endian(bytes + at, 2));
    chunk.tick = little_endian(bytes + at + 8, 8);
    chunk.payload.assign(bytes + at + k_chunk_header_bytes, bytes + at + k_chunk_header_bytes + count);
    parts.chunks.push_back(chunk);
    at += k_chunk_header_bytes + count + k_checksum_bytes;
  }
  return parts;
}

/// Numbers the chunks in their order, or by `sequences`.
inline Bytes put_together(const Parts& parts, const std::vector<uint32_t>& sequences = {}) {
  Bytes bytes = parts.header;
  append(bytes, crc32(bytes.data(), static_cast<uint32_t>(bytes.size())), k_checksum_bytes);
  for (uint32_t i = 0; i < parts.chunks.size(); ++i) {
    const Chunk& chunk = parts.chunks[i];
    const size_t start = bytes.size();
    append(bytes, chunk.type, 2);
    append(bytes, chunk.payload.size(), 2);
    append(bytes, sequences.empty() ? i : sequences[i], 4);
    append(bytes, chunk.tick, 8);
    bytes.insert(bytes.end(), chunk.payload.begin(), chunk.payload.end());
    append(bytes, crc32(bytes.data() + start, static_cast<uint32_t>(bytes.size() - start)), k_checksum_bytes);
  }
  return bytes;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
