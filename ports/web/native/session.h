#pragma once
#include <detent/recording.h>
#include <detent/world.h>

#include "desk.h"

namespace detent_web {

/// A growing array of bytes: what a recorder writes.
struct Bytes {
  uint8_t* data = nullptr;
  uint32_t count = 0;
  uint32_t capacity = 0;

  bool append(const uint8_t* from, uint32_t byte_count);
};

/// A world with all the memory that it uses: its block, its table of assets, its event buffers.
struct Session {
  World world = {};
  uint8_t* block = nullptr;
  Asset* assets = nullptr;
  void* events = nullptr;
  StepReport report = {};
  Recorder* recorder = nullptr;  ///< makes all calls; null in a replay, where only the recording changes the world
  uint8_t recorder_buffer[k_recording_buffer_bytes];
  Bytes recording = {};
  /// The world's rollback session; null: none. A world with a rollback session cannot be recorded.
  const void* rollback = nullptr;
};

/// Makes an empty world. `asset_at` has `asset_count` pairs: the address and the number of bytes of an asset. The
/// caller keeps the assets alive. Errors: as create_world(), and buffer_too_small if there is no memory.
Status open_session(Session& session, const WorldDef& def, const uint32_t* asset_at, uint32_t asset_count);
void close_session(Session& session);
/// Loads the seed of a recording, which the player has opened, into a new world. `byte_count`: size of the recording,
/// bytes. Errors: as Player::start(), and truncated if the recording is smaller than its seed, so that a hostile header
/// cannot ask for gigabytes.
Status start_session(Session& session, Player& player, uint32_t byte_count, const uint32_t* asset_at,
                     uint32_t asset_count);
/// Begins a recording of all later calls. Errors: as Recorder::begin(), and bad_argument if another recording has not
/// ended or if the world has a rollback session.
Status record_session(Session& session, const RecordingDef& def);

}  // namespace detent_web
