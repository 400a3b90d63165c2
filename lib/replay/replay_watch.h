#pragma once
#include "replay/format.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Callbacks for the contents that a player reads (Player::watch), in the recording's order. The checksum of each chunk
/// has been checked.
struct ReplayWatch {
  void* context;
  /// A call or query that has been read without error: `record` holds its tag and its fields.
  void (*called)(void* context, const uint8_t* record, uint32_t count);
  /// The next part of the trace of the current tick (trace_stream.h). Its content has not been checked.
  void (*traced)(void* context, ChunkType type, const uint8_t* payload, uint32_t count);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
