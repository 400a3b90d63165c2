#include <detent/recording.h>
#include <stdlib.h>

#include <new>

#include "byte_source.h"
#include "fields.h"
#include "session.h"

namespace detent_web {
namespace {

/// A recording in memory that is being replayed. The first member is the session, so that all functions that read a
/// world can also read the world of a replay.
struct Replay {
  Session session = {};
  ByteSource from;
  TickResult result = {};
  uint8_t buffer[k_recording_buffer_bytes];
  alignas(Player) uint8_t player_memory[sizeof(Player)];

  Player& player() { return *reinterpret_cast<Player*>(player_memory); }
};

/// Opens the recording again, from its start.
Status reopen(Replay& replay) {
  replay.from.at = 0;
  new (replay.player_memory) Player(replay.from.source(), replay.buffer, sizeof replay.buffer);
  replay.player().repeat_queries();
  return replay.player().open();
}

}  // namespace

/// Opens a recording of `count` bytes, which the caller keeps alive. Returns its replay, or null if there is no memory.
/// replay_info() tells whether the recording can be replayed.
DETENT_WEB(replay_open) Replay* replay_open(const uint8_t* bytes, uint32_t count) {
  void* memory = malloc(sizeof(Replay));
  if (memory == nullptr) return nullptr;
  Replay* replay = new (memory) Replay;
  replay->from = {bytes, count};
  (void)reopen(*replay);  // the error stays in the player
  return replay;
}
DETENT_WEB(replay_close) void replay_close(Replay* replay) {
  close_session(replay->session);
  free(replay);
}

/// Gives the header of the recording; all 0 if it could not be read.
DETENT_WEB(replay_info) void replay_info(Replay* replay) {
  RecordingInfo info = replay->player().info();
  Giver out;
  out.word(info.format_version);
  out.word(info.simulation_version);
  out.choice(info.config);
  visit(out, info.capacity);
  out.choice(info.trace_level);
  out.word(info.digest_interval);
  out.count64(info.tick);
  out.word(info.snapshot_bytes);
  out.word(info.keyframe_interval);
}
/// Gives where and why the replay stopped: status, tick, offset in the recording, bytes, and the address of the name of
/// the wrong item.
DETENT_WEB(replay_error) void replay_error(Replay* replay) {
  const ReplayError& error = replay->player().error();
  Giver out;
  out.choice(error.status);
  out.count64(error.tick);
  out.count64(error.offset);
  out.word(reinterpret_cast<uint32_t>(error.field));
}
DETENT_WEB(replay_digest_recorded) uint64_t replay_digest_recorded(Replay* replay) {
  return replay->player().error().digest_recorded;
}
DETENT_WEB(replay_digest_replayed) uint64_t replay_digest_replayed(Replay* replay) {
  return replay->player().error().digest_replayed;
}

/// Makes the world of the replay and loads the seed. Errors: as start_session().
DETENT_WEB(replay_start) uint32_t replay_start(Replay* replay, const uint32_t* asset_at, uint32_t asset_count) {
  return static_cast<uint32_t>(
      start_session(replay->session, replay->player(), replay->from.count, asset_at, asset_count));
}

/// Plays one tick and compares its digest, or, if `world` is 0, only reads the bytes of the tick. Gives: whether the
/// recording has ended, whether there was a digest to compare, the tick, the number of calls before it, and the step's
/// report.
DETENT_WEB(replay_next) uint32_t replay_next(Replay* replay, uint32_t world) {
  Player& player = replay->player();
  const Status status =
      world != 0 ? player.next_tick(replay->session.world, replay->result) : player.skip_tick(replay->result);
  if (status != Status::ok) return static_cast<uint32_t>(status);
  replay->session.report = replay->result.report;
  Giver out;
  out.flag(replay->result.finished);
  out.flag(replay->result.compared);
  out.count64(replay->result.tick);
  out.word(replay->result.calls);
  give(out, replay->result.report);
  return 0;
}

/// Goes to a tick by the recording's own keyframes. Errors: as Player::go_to().
DETENT_WEB(replay_go_to) uint32_t replay_go_to(Replay* replay, double tick) {
  return static_cast<uint32_t>(replay->player().go_to(replay->session.world, static_cast<uint64_t>(tick)));
}
/// Goes to a snapshot that world_save() made during this replay, even after the replay has stopped with an error.
/// Checks every byte of the snapshot, as if its origin were unknown.
DETENT_WEB(replay_resume) uint32_t replay_resume(Replay* replay, uint8_t* bytes, uint32_t count) {
  if (const Status status = load(replay->session.world, bytes, count); status != Status::ok)
    return static_cast<uint32_t>(status);
  if (const Status status = reopen(*replay); status != Status::ok) return static_cast<uint32_t>(status);
  replay->session.report = {};
  return static_cast<uint32_t>(replay->player().start_at(replay->session.world));
}

}  // namespace detent_web
