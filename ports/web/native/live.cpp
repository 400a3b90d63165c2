#include <detent/recording.h>
#include <stdlib.h>

#include <new>

#include "byte_source.h"
#include "fields.h"
#include "ports/host/detent/repeat_call.h"
#include "replay/replay_watch.h"
#include "session.h"

/// A world that begins with the state at the start of a recording and goes on live. The recording's calls are made at
/// their ticks, the page makes further calls, and a recorder logs both.
namespace detent_web {
namespace {

/// The first member is the session, so that all functions of a world take it.
struct Live {
  Session session = {};
  ByteSource from = {};
  bool over = false;     ///< the recording has no more ticks
  uint32_t refused = 0;  ///< number of the recording's calls that this world refused or gave another id
  TickResult tick = {};  ///< what the recording says of the present tick
  uint8_t buffer[k_recording_buffer_bytes];
  Player player = {from.source(), buffer, sizeof buffer};
};

/// Makes the recording's calls before the next tick.
void make_calls(Live& live) {
  const ReplayWatch watch = {&live,
                             [](void* context, const uint8_t* record, uint32_t count) {
                               Live& to = *static_cast<Live*>(context);
                               const RepeatedCall made = repeat_call(*to.session.recorder, record, count);
                               if (made.status != Status::ok || !made.same_id) ++to.refused;
                             },
                             [](void*, ChunkType, const uint8_t*, uint32_t) {}};
  live.player.watch(&watch);
  live.tick = {};
  live.over = live.player.skip_tick(live.tick) != Status::ok || live.tick.finished;
  live.player.watch(nullptr);
}

}  // namespace

/// Makes a world with the state at the start of a recording of `count` bytes. The caller keeps the bytes alive. Gives
/// the address of the world's session. Errors: as start_session() and record_session().
DETENT_WEB(live_open)
uint32_t live_open(const uint8_t* bytes, uint32_t count, const uint32_t* asset_at, uint32_t asset_count) {
  void* memory = malloc(sizeof(Live));
  if (memory == nullptr) return static_cast<uint32_t>(Status::buffer_too_small);
  Live& live = *new (memory) Live;
  live.from.bytes = bytes;
  live.from.count = count;
  Status status = live.player.open();
  if (status == Status::ok) status = start_session(live.session, live.player, count, asset_at, asset_count);
  if (status == Status::ok) status = record_session(live.session, {});
  if (status != Status::ok) {
    close_session(live.session);
    free(memory);
    return static_cast<uint32_t>(status);
  }
  Giver out;
  out.word(reinterpret_cast<uint32_t>(&live));
  return 0;
}

/// Makes the recording's calls, and steps. Gives: whether the recording is over, whether it has a digest of this tick,
/// whether this digest equals the world's, the number of the recording's calls that could not be made so far, and the
/// report.
DETENT_WEB(live_step) void live_step(Live* live) {
  if (!live->over) make_calls(*live);
  live->session.report = live->session.recorder->step();
  const bool compared = !live->over && live->tick.compared;
  Giver out;
  out.flag(live->over);
  out.flag(compared);
  out.flag(compared && live->tick.digest == digest(live->session.world));
  out.word(live->refused);
  give(out, live->session.report);
}

/// Gives the address and the number of bytes of a recording of all calls so far; the caller frees it. The world's own
/// recording goes on. Errors: buffer_too_small without memory.
DETENT_WEB(live_recording) uint32_t live_recording(Live* live) {
  Session& session = live->session;
  if (const Status status = session.recorder->flush(); status != Status::ok) return static_cast<uint32_t>(status);
  Bytes copy;
  if (!copy.append(session.recording.data, session.recording.count))
    return static_cast<uint32_t>(Status::buffer_too_small);
  // Ends the copy as the recording of a program that was stopped: a player finds where the complete part ends, and
  // writes the end chunk.
  ByteSource from = {session.recording.data, session.recording.count};
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(from.source(), buffer, sizeof buffer);
  Status status = player.open();
  for (TickResult result; status == Status::ok;) status = player.skip_tick(result);
  const Sink sink = {[](void* to, const uint8_t* bytes, uint32_t count) {
                       return static_cast<Bytes*>(to)->append(bytes, count) ? Status::ok : Status::sink_failed;
                     },
                     &copy};
  status = status == Status::truncated ? player.write_end(session.world, sink) : status;
  if (status != Status::ok) {
    free(copy.data);
    return static_cast<uint32_t>(status);
  }
  Giver out;
  out.word(reinterpret_cast<uint32_t>(copy.data));
  out.word(copy.count);
  return 0;
}

}  // namespace detent_web
