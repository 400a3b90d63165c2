#pragma once
#include "replay/format.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Callbacks by which a player reports the contents that it reads (Player::watch). They are called in the order of the
/// recording. The player has already checked the checksum of the chunk.
struct ReplayWatch {
  void* context;
  /// Reports a call or query that has been read without error. `record`: its tag and its fields.
  void (*called)(void* context, const uint8_t* record, uint32_t count);
  /// Reports the next piece of the trace of the current tick (trace_stream.h). Its content has not been checked.
  void (*traced)(void* context, ChunkType type, const uint8_t* payload, uint32_t count);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
