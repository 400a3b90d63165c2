#pragma once
#include "replay/format.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Callbacks for the contents that a player reads (Player::watch), called in the order of the recording. The player has
/// already checked the checksum of each chunk.
struct ReplayWatch {
  void* context;
  /// A call or query that has been read without error: `record` holds its tag and its fields.
  void (*called)(void* context, const uint8_t* record, uint32_t count);
  /// The next part of the trace of the current tick (trace_stream.h). The content of the trace has not been checked.
  void (*traced)(void* context, ChunkType type, const uint8_t* payload, uint32_t count);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
