#pragma once
#include <detent/rollback.h>

/// @file
/// A match over a network with rollback: everybody simulates with the inputs that are known, repeats the last input of
/// whom it has not heard from, and makes ticks again when an input turns out to be another. The session keeps inputs
/// and states; what carries inputs from machine to machine is the game's. docs/rollback.md.
///
/// Shaped after GGPO (Cannon 2019: inputs in, save, load and advance a frame) and ggrs (checksums that are compared, a
/// sync test, what a session is told while it must wait is kept).
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_rollback_players_max = 16;        ///< of a session
inline constexpr uint32_t k_rollback_window_max = 64;         ///< RollbackDef::window
inline constexpr uint32_t k_rollback_input_bytes_max = 1024;  ///< RollbackDef::input_bytes

/// The game's own state that goes back with the world: plain bytes without pointers, padding or anything that differs
/// from machine to machine, for they are in the checksums.
struct GameState {
  uint8_t* bytes = nullptr;  ///< where the game has them; null if there is none
  uint32_t count = 0;        ///< how many
};

/// What a tick is made with.
struct TickInputs {
  uint64_t tick = 0;                ///< ticks that the world has completed
  const uint8_t* inputs = nullptr;  ///< of all players, one after another
  uint32_t players = 0;             ///< how many
  uint32_t input_bytes = 0;         ///< of each
  uint32_t predicted = 0;           ///< bit p: player p's input is not known, and its last one is repeated
  bool again = false;               ///< the tick was made before: sounds and other effects have been heard
  /// Those of one player.
  const uint8_t* of(uint32_t player) const { return inputs + player * input_bytes; }
};

/// How the game makes a tick: it applies the inputs to the world and steps it, once. The world and the GameState alone
/// may decide what happens, for they alone go back. It must not call the session.
struct TickMaker {
  /// Makes one tick.
  void (*make)(void* context, World& world, const TickInputs& inputs) = nullptr;
  void* context = nullptr;  ///< handed to `make`
};

/// What a session is. But for `local` and `delay` the same on every machine.
struct RollbackDef {
  uint32_t players = 2;            ///< [1, k_rollback_players_max]
  uint32_t local = 1;              ///< bit p: player p plays on this machine; 0: it only watches
  uint32_t input_bytes = 1;        ///< of a player's input for a tick, [1, k_rollback_input_bytes_max]
  uint32_t delay = 0;              ///< ticks from a local input to the tick that it is for, [0, window]
  uint32_t window = 8;             ///< ticks that may be simulated with predicted inputs, [1, k_rollback_window_max]
  uint32_t checksum_interval = 1;  ///< a checksum before every tick that is a multiple of it; 0: none
  uint32_t game_bytes = 0;         ///< GameState::count
};

/// What one call made of the world.
struct RollbackReport {
  uint64_t tick = 0;         ///< ticks that the world has completed
  uint32_t ticks_again = 0;  ///< ticks that were made again
  uint64_t went_back = 0;    ///< the first of them
};

/// A checksum of the state after `tick` ticks: checksum32() of the world, with the GameState's bytes.
struct TickChecksum {
  uint64_t tick = 0;      ///< ticks completed
  uint32_t checksum = 0;  ///< of that state
};

/// The first tick, of those compared, whose states differ from another player's.
struct Desync {
  bool found = false;   ///< whether there is one
  uint64_t tick = 0;    ///< ticks completed
  uint32_t player = 0;  ///< who had another state; the first of several
  uint32_t own = 0;     ///< this machine's checksum
  uint32_t theirs = 0;  ///< and the player's
};

/// Bytes that a session needs for worlds of this capacity; 0 if an argument is out of range.
constexpr uint32_t rollback_bytes(Capacity capacity, const RollbackDef& def);

/// A session: from the world's tick at `begin` on, by the world's ticks. Any call may be made with what a network
/// brings: what is no use is refused.
class RollbackSession {
 public:
  RollbackSession() = default;
  RollbackSession(const RollbackSession&) = delete;
  RollbackSession& operator=(const RollbackSession&) = delete;

  /// Begins with the world as it is, which must have the same digest on every machine. `memory`: 8-byte aligned, at
  /// least rollback_bytes() of the world's capacity, for the session alone as long as it is used.
  /// Errors: out_of_range, bad_argument (no `maker`; a local player who does not play; bytes of `game` that `def` does
  /// not say), buffer_too_small, buffer_misaligned.
  Status begin(const World& world, const RollbackDef& def, TickMaker maker, uint8_t* memory, uint32_t memory_bytes,
               GameState game = {});

  /// What a local player does in tick `tick`, the next one and the delay: `def.input_bytes` of it. Once a tick.
  /// Errors: bad_argument (not begun, not a local player, given before, null).
  Status add_local_input(uint32_t player, const uint8_t* input, uint64_t& tick);
  /// What another player did in a tick, in any order; what is known already stays.
  /// Errors: bad_argument (not begun, not another player, null), out_of_range (too far ahead to be kept: it must come
  /// again).
  Status add_input(uint32_t player, uint64_t tick, const uint8_t* input);
  /// The known input of any player, to be sent: those of the last ticks are kept, at least until every machine has
  /// got on. Errors: bad_argument (not begun, no player), out_of_range (not known, or no longer).
  Status get_input(uint32_t player, uint64_t tick, uint8_t* input) const;
  /// The first tick of which the player's input is not known. Sent to the player, it says what need not come again.
  uint64_t next_input(uint32_t player) const { return player < def_.players ? next_[player] : 0; }

  /// Makes one more tick, after making again what was predicted wrong.
  /// Errors, each before anything is done: waiting (`window` ticks were made without an input that is not known yet:
  /// call again when more has come); bad_argument (not begun; a local player's input is missing; the world is not at
  /// the session's tick); capacity_differs, feature_missing (another world than the one it began with). And
  /// bad_argument if the maker did not step the world once, which ends the session.
  Status advance(World& world, RollbackReport& report);
  /// Makes again what was predicted wrong, and no further tick: while waiting, and after the last tick.
  /// Errors: bad_argument, as advance.
  Status correct(World& world, RollbackReport& report);

  /// Ticks that the session has made.
  uint64_t tick() const { return tick_; }
  /// The state after so many ticks stays as it is, on every machine: all inputs before it are known, and used.
  uint64_t confirmed_tick() const;

  /// The last confirmed checksums, the latest first, up to `count`: to be sent, each as often as the network asks for.
  /// Returns how many there are.
  uint32_t checksums(TickChecksum* last, uint32_t count) const;
  /// Another player's checksum, compared as soon as the tick is confirmed here. Errors: bad_argument (not begun, not
  /// another player, not a tick with a checksum), out_of_range (too old or too far ahead to be compared);
  /// digest_differs (desync() tells which tick).
  Status add_checksum(uint32_t player, const TickChecksum& theirs);
  /// Whether the states differ, and where first.
  const Desync& desync() const { return desync_; }

 private:
  struct Checksum;

  bool is_remote(uint32_t player) const { return player < def_.players && (def_.local >> player & 1) == 0; }
  uint32_t place(uint64_t tick) const { return static_cast<uint32_t>(tick % kept_); }
  uint8_t* input_of(uint32_t player, uint64_t tick) const;
  uint8_t* game_at(uint64_t tick) const { return games_ + static_cast<uint32_t>(tick % def_.window) * game_.count; }
  uint64_t& stamp_of(uint32_t player, uint64_t tick) const;
  bool is_known(uint32_t player, uint64_t tick) const {
    return tick != UINT64_MAX && stamp_of(player, tick) == tick + 1;
  }
  uint64_t oldest() const;
  void set_input(uint32_t player, uint64_t tick, const uint8_t* input);
  uint64_t known_tick() const;
  bool is_at(const World& world) const;
  bool lacks_local_input() const;
  uint32_t predict(uint64_t tick);
  void keep(const World& world, uint64_t tick);
  Status make_tick(World& world, uint64_t tick, bool again);
  Status go_back(World& world, RollbackReport& report);
  Checksum& own_checksum(uint64_t tick) const;
  Checksum& their_checksum(uint32_t player, uint64_t tick) const;
  void compare_checksums();
  void compare_checksum(uint32_t player, uint64_t tick);

  RollbackDef def_ = {};
  TickMaker maker_ = {};
  GameState game_ = {};
  SnapshotRing states_;
  uint8_t* games_ = nullptr;    ///< of the ticks in `states_`
  uint8_t* inputs_ = nullptr;   ///< [tick][player]: known, or what was predicted
  uint64_t* stamps_ = nullptr;  ///< likewise: tick + 1 if the input is known
  Checksum* sums_ = nullptr;    ///< [tick][this machine, then each player]
  uint32_t kept_ = 0;           ///< ticks of which inputs and checksums are kept
  bool begun_ = false;
  uint64_t start_ = 0;           ///< the tick at `begin`
  uint64_t tick_ = 0;            ///< ticks made
  uint64_t wrong_ = UINT64_MAX;  ///< the first tick that was made with another input than is known now
  uint64_t next_[k_rollback_players_max] = {};
  Desync desync_ = {};
};

/// @cond
struct RollbackSession::Checksum {
  uint64_t stamp;  ///< tick + 1, or 0
  uint32_t value;
  uint32_t compared;
};

// Places of the session's parts in its memory.
struct RollbackLayout {
  uint32_t games, inputs, stamps, sums, kept;
  uint64_t bytes;  ///< 0: out of range
};

// Of the first tick that a machine does not know all of: it is up to a window ahead of that, another player a delay and
// a window ahead of it, and this player's input a delay ahead of that; and it may be asked for its own inputs from a
// window and a delay before. A delay is no longer than a window.
constexpr uint32_t rollback_ticks_kept(uint32_t window) { return 6 * window + 2; }

constexpr RollbackLayout rollback_layout(Capacity capacity, const RollbackDef& def) {
  RollbackLayout layout{};
  const uint32_t states = snapshot_ring_bytes(capacity, def.window);
  if (def.players < 1 || def.players > k_rollback_players_max || def.window < 1 || def.window > k_rollback_window_max ||
      def.input_bytes < 1 || def.input_bytes > k_rollback_input_bytes_max || def.delay > def.window || states == 0) {
    return layout;
  }
  layout.kept = rollback_ticks_kept(def.window);
  uint64_t end = states;
  const auto place = [&end](uint64_t bytes) {
    const uint64_t start = end;
    end = (end + bytes + 7) / 8 * 8;
    return static_cast<uint32_t>(start);
  };
  layout.games = place(uint64_t{def.game_bytes} * def.window);
  layout.inputs = place(uint64_t{def.input_bytes} * def.players * layout.kept);
  layout.stamps = place(uint64_t{8} * def.players * layout.kept);
  layout.sums = place(uint64_t{16} * (def.players + 1) * layout.kept);
  layout.bytes = end > UINT32_MAX ? 0 : end;
  return layout;
}
/// @endcond

constexpr uint32_t rollback_bytes(Capacity capacity, const RollbackDef& def) {
  return static_cast<uint32_t>(rollback_layout(capacity, def).bytes);
}

/// What sync_test() is to do.
struct SyncTestDef {
  uint32_t ticks = 1;               ///< to step, then to step again
  const uint8_t* inputs = nullptr;  ///< of each tick, of each player; null if there are none
  uint32_t players = 0;             ///< TickInputs::players
  uint32_t input_bytes = 0;         ///< TickInputs::input_bytes
};

/// What sync_test() found.
struct SyncTestReport {
  uint64_t tick = 0;    ///< digest_differs: ticks completed, of the first state that differs
  uint64_t first = 0;   ///< its digest when the tick was made
  uint64_t second = 0;  ///< and when it was made again
};

/// Bytes of memory that sync_test() needs; 0 if an argument is out of range.
constexpr uint32_t sync_test_bytes(Capacity capacity, uint32_t ticks, uint32_t game_bytes = 0) {
  const uint64_t bytes = uint64_t{snapshot_ring_bytes(capacity, 1)} + uint64_t{8} * ticks + game_bytes;
  return ticks == 0 || bytes > UINT32_MAX || snapshot_ring_bytes(capacity, 1) == 0 ? 0 : static_cast<uint32_t>(bytes);
}

/// Makes ticks, goes back, makes them again, and compares their digests: what a session's maker must withstand. The
/// world and `game` are then those of the second time.
/// Errors: digest_differs (`report` says where; the world stands there); out_of_range, buffer_too_small,
/// buffer_misaligned, bad_argument (no maker, inputs without bytes, a maker that did not step the world once).
Status sync_test(World& world, const SyncTestDef& def, TickMaker maker, uint8_t* memory, uint32_t memory_bytes,
                 SyncTestReport& report, GameState game = {});

}  // namespace DETENT_NAMESPACE
}  // namespace detent
