#pragma once
#include "replay/format.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Callbacks for the contents that a player reads (Player::watch), in order. Each chunk and each record has been
/// checked.
struct ReplayWatch {
  void* context;
  /// The record of a call or query: its tag and its fields.
  void (*called)(void* context, const uint8_t* record, uint32_t count);
  /// The next piece of the trace of the current tick (trace_stream.h). Only the frame of its chunk has been checked.
  void (*traced)(void* context, ChunkType type, const uint8_t* payload, uint32_t count);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
