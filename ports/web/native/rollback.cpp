#include <detent/rollback.h>
#include <stdlib.h>

#include <new>

#include "fields.h"
#include "session.h"

/// Rollback sessions. JavaScript checks the lengths of inputs, and that numbers are whole. The library checks all else.
namespace detent_web {
namespace {

/// A rollback session of a world, with its memory.
struct Rollback {
  Session* world = nullptr;
  void (*make)(Rollback*) = nullptr;  ///< a function of JavaScript in the module's table
  RollbackDef def = {};
  uint8_t* memory = nullptr;
  uint8_t* game = nullptr;
  RollbackSession session;
  uint8_t input[k_rollback_input_bytes_max];  ///< the input for the next call, or the result of the last call
};

/// Puts the inputs on the desk, and calls the function of JavaScript that makes the tick.
void make_tick(void* context, World&, const TickInputs& inputs) {
  Rollback& rollback = *static_cast<Rollback*>(context);
  Giver out;
  out.count64(inputs.tick);
  out.word(reinterpret_cast<uint32_t>(inputs.inputs));
  out.word(inputs.predicted);
  out.flag(inputs.again);
  rollback.make(&rollback);
}

void close(Rollback* rollback) {
  if (rollback == nullptr) return;
  free(rollback->memory);
  free(rollback->game);
  free(rollback);
}

Status open(Rollback& rollback) {
  const RollbackDef& def = rollback.def;
  Session& world = *rollback.world;
  // A recording would hold the repeated ticks, too.
  if (world.rollback != nullptr || world.recording.data != nullptr) return Status::bad_argument;
  const uint32_t bytes = rollback_bytes(get_info(world.world).capacity, def);
  if (bytes == 0) return Status::out_of_range;
  rollback.memory = static_cast<uint8_t*>(malloc(bytes));
  if (rollback.memory == nullptr) return Status::buffer_too_small;
  GameState game;
  if (def.game_bytes != 0) {
    game = {rollback.game = static_cast<uint8_t*>(calloc(def.game_bytes, 1)), def.game_bytes};
    if (game.bytes == nullptr) return Status::buffer_too_small;
  }
  const Status status = rollback.session.begin(world.world, def, {make_tick, &rollback}, rollback.memory, bytes, game);
  if (status == Status::ok) world.rollback = &rollback;
  return status;
}

}  // namespace

/// Takes a RollbackDef of `count` doubles from the desk. The session calls `make` for each tick. On the desk are then:
/// the tick, the address of the inputs, the bits of the predicted players, whether the tick is repeated. Gives the
/// addresses of the session, of Rollback::input, and of the game's bytes. Errors: as RollbackSession::begin();
/// buffer_too_small if there is no memory; bad_argument for a world that is recorded or already has a session.
DETENT_WEB(rollback_open) uint32_t rollback_open(Session* world, void (*make)(Rollback*), uint32_t count) {
  RollbackDef def;
  Taker in(count);
  visit(in, def);
  if (in.status != Status::ok) return static_cast<uint32_t>(in.status);
  void* memory = malloc(sizeof(Rollback));
  if (memory == nullptr) return static_cast<uint32_t>(Status::buffer_too_small);
  Rollback& rollback = *new (memory) Rollback;
  rollback.world = world;
  rollback.make = make;
  rollback.def = def;
  if (const Status status = open(rollback); status != Status::ok) {
    close(&rollback);
    return static_cast<uint32_t>(status);
  }
  Giver out;
  out.word(reinterpret_cast<uint32_t>(&rollback));
  out.word(reinterpret_cast<uint32_t>(rollback.input));
  out.word(reinterpret_cast<uint32_t>(rollback.game));
  return 0;
}
DETENT_WEB(rollback_close) void rollback_close(Rollback* rollback) {
  rollback->world->rollback = nullptr;
  close(rollback);
}

/// Adds Rollback::input as the next input of a local player. Gives the tick in which the input acts.
DETENT_WEB(rollback_add_local_input) uint32_t rollback_add_local_input(Rollback* rollback, uint32_t player) {
  uint64_t tick = 0;
  const Status status = rollback->session.add_local_input(player, rollback->input, tick);
  Giver out;
  out.count64(tick);
  return static_cast<uint32_t>(status);
}
DETENT_WEB(rollback_add_input) uint32_t rollback_add_input(Rollback* rollback, uint32_t player, double tick) {
  return static_cast<uint32_t>(rollback->session.add_input(player, static_cast<uint64_t>(tick), rollback->input));
}
/// Writes a known input of a player to Rollback::input.
DETENT_WEB(rollback_get_input) uint32_t rollback_get_input(Rollback* rollback, uint32_t player, double tick) {
  return static_cast<uint32_t>(rollback->session.get_input(player, static_cast<uint64_t>(tick), rollback->input));
}

/// Repeats the ticks that were simulated with wrong inputs, and then, unless `more` is 0, simulates the next tick.
/// Gives the report.
DETENT_WEB(rollback_advance) uint32_t rollback_advance(Rollback* rollback, uint32_t more) {
  RollbackSession& session = rollback->session;
  World& world = rollback->world->world;
  RollbackReport report;
  const Status status = more != 0 ? session.advance(world, report) : session.correct(world, report);
  Giver out;
  out.count64(report.tick);
  out.word(report.ticks_again);
  out.count64(report.went_back);
  return static_cast<uint32_t>(status);
}

DETENT_WEB(rollback_tick) double rollback_tick(const Rollback* rollback) {
  return static_cast<double>(rollback->session.tick());
}
DETENT_WEB(rollback_confirmed_tick) double rollback_confirmed_tick(const Rollback* rollback) {
  return static_cast<double>(rollback->session.confirmed_tick());
}
DETENT_WEB(rollback_next_input) double rollback_next_input(const Rollback* rollback, uint32_t player) {
  return static_cast<double>(rollback->session.next_input(player));
}

/// Gives the number of checksums, at most `count`, then for each its tick and its value.
DETENT_WEB(rollback_checksums) void rollback_checksums(const Rollback* rollback, uint32_t count) {
  constexpr uint32_t kept = rollback_ticks_kept(k_rollback_window_max);
  TickChecksum last[kept];
  const uint32_t found = rollback->session.checksums(last, count < kept ? count : kept);
  Giver out;
  out.word(found);
  for (uint32_t i = 0; i < found; ++i) {
    out.count64(last[i].tick);
    out.word(last[i].checksum);
  }
}
DETENT_WEB(rollback_add_checksum)
uint32_t rollback_add_checksum(Rollback* rollback, uint32_t player, double tick, uint32_t checksum) {
  return static_cast<uint32_t>(rollback->session.add_checksum(player, {static_cast<uint64_t>(tick), checksum}));
}
/// Gives whether the machines differ, the first tick that is known to differ, the player, and both checksums.
DETENT_WEB(rollback_desync) void rollback_desync(const Rollback* rollback) {
  const Desync& desync = rollback->session.desync();
  Giver out;
  out.flag(desync.found);
  out.count64(desync.tick);
  out.word(desync.player);
  out.word(desync.own);
  out.word(desync.theirs);
}

}  // namespace detent_web
