#pragma once
#include <detent/world.h>

/// @file
/// World states for rollback: copies between worlds, differences of snapshots, and a ring of the states of the last
/// ticks. Rollback sessions for a network game use these. No function of this header allocates.
///
/// In a session each machine simulates with the inputs that have arrived. For a player whose input is missing, the
/// machine predicts that the player's last input is repeated. When an input arrives that differs from its prediction,
/// the machine repeats the ticks from the tick of this input on. The session stores inputs and states; the game sends
/// the inputs between machines. See docs/rollback.md.
///
/// Two libraries were the models: GGPO (Cannon 2019), for the inputs and for saving, loading and advancing a frame;
/// ggrs, for the comparison of checksums, the sync test, and for accepting inputs and checksums while a session waits.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Copies the state of `from` to `to`; their capacities may differ. Afterwards both worlds have the same digest. They
/// step identically as long as no pool of either world is full. `to` keeps its event buffers, assets, filter rules and
/// features. Errors: pool_full (`to` has no room for the state in use), feature_missing, asset_missing, asset_mismatch,
/// rule_missing; after an error `to` is unchanged.
Status copy_world(const World& from, World& to);

/// The digest folded to 32 bits (high half xor low half). Players exchange it to check that their worlds agree.
uint32_t checksum32(const World& world);

/// Largest size of a delta (save_delta()) between two snapshots of this capacity, bytes; 0 if the capacity is out of
/// range.
constexpr uint32_t delta_bytes_max(Capacity capacity);
/// Writes to `delta` the difference between `base`, an earlier snapshot of this world by save(), and the current state
/// of the world. The delta has the same bytes on every target (SPEC.md, "Delta"). Sets `bytes` to the number of bytes
/// written, at most `delta_capacity`.
/// Errors: those of restore(), for the base; buffer_too_small, after which the content of `delta` is unspecified.
Status save_delta(const World& world, const uint8_t* base, uint32_t base_bytes, uint8_t* delta, uint32_t delta_capacity,
                  uint32_t& bytes);
/// Restores the state from which this program wrote `delta`. `base` must be the snapshot that was passed to
/// save_delta().
/// Errors: those of restore() and apply_delta().
Status restore_delta(World& world, const uint8_t* base, uint32_t base_bytes, const uint8_t* delta,
                     uint32_t delta_bytes);
/// Changes `base`, in place, to the snapshot of the state from which the delta was written. The delta may come from an
/// untrusted source: the function checks every length and offset before it changes the base, and load() can check the
/// resulting snapshot. Errors: truncated, not_detent, format_unknown, capacity_differs (the base has another size),
/// bad_argument (the base is of another tick), corrupt.
Status apply_delta(uint8_t* base, uint32_t base_bytes, const uint8_t* delta, uint32_t delta_bytes);

/// Bytes of memory of a SnapshotRing; 0 if an argument is out of range.
constexpr uint32_t snapshot_ring_bytes(Capacity capacity, uint32_t ticks);

/// The states of a world after its last ticks, in the caller's memory. The memory consists of one place for each tick;
/// the state after tick t is in place t modulo the number of places. A place has room for any state of the capacity;
/// the ring writes only the used part of the state, without most of its zeros. The bytes are in the machine's byte
/// order, and only this program can read them.
class SnapshotRing {
 public:
  /// Makes room for `ticks` ticks of worlds of this capacity. `memory`: 8-byte aligned, at least snapshot_ring_bytes()
  /// bytes; only the ring may use it as long as the ring is in use.
  /// Errors: out_of_range, buffer_too_small, buffer_misaligned.
  Status begin(uint8_t* memory, uint32_t memory_bytes, Capacity capacity, uint32_t ticks);
  /// Stores the current state of the world under its tick. It overwrites the state of an older tick in the same place.
  /// Errors: bad_argument (not begun), capacity_differs.
  Status keep(const World& world);
  /// Restores the world's state after `tick` ticks, and drops all later ticks.
  /// Errors: out_of_range (the ring does not have this tick), bad_argument (not begun), capacity_differs,
  /// feature_missing.
  Status restore(World& world, uint64_t tick);
  /// Whether the ring has the state after `tick` ticks.
  bool holds(uint64_t tick) const;

 private:
  uint8_t* place(uint64_t tick) const { return memory_ + static_cast<uint32_t>(tick % ticks_) * place_bytes_; }

  uint8_t* memory_ = nullptr;
  uint32_t place_bytes_ = 0;
  uint32_t ticks_ = 0;
  Capacity capacity_ = {};
};

/// @cond
// Internal.
inline constexpr uint32_t k_delta_header_bytes = 24;
/// @endcond

constexpr uint32_t delta_bytes_max(Capacity capacity) {
  // In the worst case every word of eight bytes differs, and takes one mask byte and eight bytes. Equal words never
  // take more than that.
  const uint64_t bytes = k_delta_header_bytes + uint64_t{snapshot_bytes(capacity)} / 8 * 9;
  return snapshot_bytes(capacity) == 0 || bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}

/// @cond
// Largest size of a packed state (lib/state/packed_state.h), bytes: the snapshot, a count, and one byte for each
// element with optional parts.
constexpr uint32_t packed_bytes_max(Capacity capacity) {
  const uint64_t more = 4 + uint64_t{capacity.bodies} + capacity.contacts + manifold_count(capacity);
  const uint64_t bytes = (snapshot_bytes(capacity) + more + 7) / 8 * 8;
  return snapshot_bytes(capacity) == 0 || bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}
/// @endcond

constexpr uint32_t snapshot_ring_bytes(Capacity capacity, uint32_t ticks) {
  const uint64_t bytes = uint64_t{packed_bytes_max(capacity)} * ticks;
  return bytes > UINT32_MAX ? 0 : static_cast<uint32_t>(bytes);
}

inline constexpr uint32_t k_rollback_players_max = 16;        ///< largest RollbackDef::players
inline constexpr uint32_t k_rollback_window_max = 64;         ///< largest RollbackDef::window
inline constexpr uint32_t k_rollback_input_bytes_max = 1024;  ///< largest RollbackDef::input_bytes

/// The game's own state, which the session stores and restores together with the world. It consists of plain bytes
/// without pointers or padding. They must be equal on all machines, because the checksums cover them.
struct GameState {
  uint8_t* bytes = nullptr;  ///< the game's bytes; null if there are none
  uint32_t count = 0;        ///< number of bytes
};

/// The inputs of one tick.
struct TickInputs {
  uint64_t tick = 0;                ///< ticks that the world has completed
  const uint8_t* inputs = nullptr;  ///< the inputs of all players, one after another
  uint32_t players = 0;             ///< number of players
  uint32_t input_bytes = 0;         ///< bytes of each player's input
  uint32_t predicted = 0;           ///< bit p: the input of player p is a prediction, because it has not arrived
  bool again = false;               ///< the tick is repeated: the game must not repeat sounds and other effects
  /// The input of one player.
  const uint8_t* of(uint32_t player) const { return inputs + player * input_bytes; }
};

/// The game's function that simulates a tick: it applies the inputs to the world and steps the world once. Its results
/// may depend on the world, the GameState and the inputs only, because a rollback restores nothing else. It must not
/// call the session.
struct TickMaker {
  /// Simulates one tick.
  void (*make)(void* context, World& world, const TickInputs& inputs) = nullptr;
  void* context = nullptr;  ///< passed to `make`
};

/// The settings of a session. All but `local`, `delay` and `sparse` must be the same on every machine.
struct RollbackDef {
  uint32_t players = 2;            ///< [1, k_rollback_players_max]
  uint32_t local = 1;              ///< bit p: player p plays on this machine; 0: the machine only watches
  uint32_t input_bytes = 1;        ///< bytes of a player's input for a tick, [1, k_rollback_input_bytes_max]
  uint32_t delay = 0;              ///< ticks from a local input to the tick that uses it, [0, window]
  uint32_t window = 8;             ///< ticks that may be simulated with predicted inputs, [1, k_rollback_window_max]
  uint32_t checksum_interval = 1;  ///< a checksum is taken before each tick whose number is a multiple of it; 0: none
  uint32_t game_bytes = 0;         ///< GameState::count
  /// Sparse rollback: a tick that is repeated simulates only the bodies that the changed inputs reach. The results are
  /// the same. Needs more than twice the memory (docs/rollback.md). Machines may differ in this setting.
  bool sparse = false;
};

/// The result of one call.
struct RollbackReport {
  uint64_t tick = 0;         ///< number of ticks that the world has completed
  uint32_t ticks_again = 0;  ///< number of ticks that were repeated
  uint64_t went_back = 0;    ///< the first repeated tick; 0 if no tick was repeated
  /// Awake bodies simulated in the repeated ticks, summed over these ticks. 0 without RollbackDef::sparse.
  uint64_t bodies_again = 0;
  uint32_t ticks_whole = 0;  ///< number of repeated ticks in which all awake bodies were simulated
};

/// A checksum of the state after `tick` ticks: of the world, as checksum32(), and of the GameState's bytes.
struct TickChecksum {
  uint64_t tick = 0;      ///< ticks completed
  uint32_t checksum = 0;  ///< checksum of the state after these ticks
};

/// The first compared tick after which another player's state differs from this machine's.
struct Desync {
  bool found = false;   ///< whether there is such a tick
  uint64_t tick = 0;    ///< ticks completed in the first compared state that differs
  uint32_t player = 0;  ///< the player whose state differs; the first if there are several
  uint32_t own = 0;     ///< this machine's checksum
  uint32_t theirs = 0;  ///< the checksum of `player`
};

/// Bytes of memory that a session needs for worlds of this capacity; 0 if an argument is out of range.
constexpr uint32_t rollback_bytes(Capacity capacity, const RollbackDef& def);

/// @cond
class SparseRollback;
/// @endcond

/// A rollback session. It starts at the tick that the world has at `begin`, and uses the tick numbers of the world.
/// Every call is safe with untrusted data from a network: it returns an error if the data are invalid.
class RollbackSession {
 public:
  RollbackSession() = default;
  RollbackSession(const RollbackSession&) = delete;
  RollbackSession& operator=(const RollbackSession&) = delete;

  /// Begins with the world's current state, which must have the same digest on every machine. `memory`: 8-byte aligned,
  /// at least rollback_bytes() for the world's capacity; only the session may use it as long as the session is in use.
  /// Errors: out_of_range, bad_argument (no `maker`; a local player outside `def.players`; `game.count` is not
  /// `def.game_bytes`), buffer_too_small, buffer_misaligned.
  Status begin(const World& world, const RollbackDef& def, TickMaker maker, uint8_t* memory, uint32_t memory_bytes,
               GameState game = {});

  /// Adds the input of a local player, `def.input_bytes` bytes, for the tick that comes `def.delay` ticks after the
  /// next one. Returns this tick in `tick`. Call the function once per tick and local player.
  /// Errors: bad_argument (not begun, not a local player, already added, null).
  Status add_local_input(uint32_t player, const uint8_t* input, uint64_t& tick);
  /// Adds the input of a remote player for a tick. Inputs may be added in any order. An input that is already known
  /// does not change. Errors: bad_argument (not begun, not a remote player, null), out_of_range (the tick is too far
  /// ahead for the input to be stored: the sender must send it again).
  Status add_input(uint32_t player, uint64_t tick, const uint8_t* input);
  /// Reads the known input of any player, to send it. An input is kept at least until every machine has it. Errors:
  /// bad_argument (not begun, no such player), out_of_range (not known yet, or no longer kept).
  Status get_input(uint32_t player, uint64_t tick, uint8_t* input) const;
  /// The first tick for which the player's input is not known here. Send this number to the player's machine: it need
  /// not send earlier inputs again.
  uint64_t next_input(uint32_t player) const { return player < def_.players ? next_[player] : 0; }

  /// Repeats the ticks from the first wrong prediction on, then simulates one more tick.
  /// Errors before anything changes: waiting (an input is missing, and `window` ticks were simulated without it: call
  /// again when more inputs have arrived); bad_argument (not begun; a local player's input is missing; the world is not
  /// at the session's tick); capacity_differs, feature_missing (not the world that the session began with).
  /// Error afterwards: bad_argument if the maker did not step the world exactly once; this ends the session.
  Status advance(World& world, RollbackReport& report);
  /// Repeats the ticks from the first wrong prediction on, and simulates no further tick: for use while waiting, and
  /// after the last tick. Errors: bad_argument, as advance.
  Status correct(World& world, RollbackReport& report);

  /// The number of ticks completed, by the world's tick numbers.
  uint64_t tick() const { return tick_; }
  /// The number of ticks whose inputs are all known and used. The state after these ticks is final.
  uint64_t confirmed_tick() const;

  /// Writes the last checksums of confirmed ticks to `last`, the latest first, at most `count` of them. Returns the
  /// number written. Send each checksum as often as the network requires.
  uint32_t checksums(TickChecksum* last, uint32_t count) const;
  /// Adds a checksum of a remote player. The session compares it as soon as its tick is confirmed here. Errors:
  /// bad_argument (not begun, not a remote player, not a tick with a checksum), out_of_range (too old or too far ahead
  /// to be compared), digest_differs (a difference is known, from this checksum or from an earlier one: see desync()).
  Status add_checksum(uint32_t player, const TickChecksum& theirs);
  /// Whether the states of the machines differ, and the first tick after which they differ.
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
  Status keep(const World& world, uint64_t tick);
  Status restore(World& world, uint64_t tick);
  void take_checksum(const World& world, const GameState& game, uint64_t tick);
  void take_confirmed_checksums();
  Status make_tick(World& world, uint64_t tick, bool again);
  Status go_back(World& world, RollbackReport& report);
  Checksum& own_checksum(uint64_t tick) const;
  Checksum& their_checksum(uint32_t player, uint64_t tick) const;
  void compare_checksums();
  void compare_checksum(uint32_t player, uint64_t tick);

  RollbackDef def_ = {};
  TickMaker maker_ = {};
  GameState game_ = {};
  SnapshotRing states_;                                ///< states of the last ticks; unused if `sparse_` is not null
  [[maybe_unused]] SparseRollback* sparse_ = nullptr;  ///< null: all bodies are simulated again
  uint8_t* games_ = nullptr;                           ///< game states of the ticks in `states_`
  uint8_t* inputs_ = nullptr;                          ///< [tick][player]: the known or predicted input
  uint64_t* stamps_ = nullptr;                         ///< [tick][player]: tick + 1 if the input is known
  Checksum* sums_ = nullptr;                           ///< [tick][machine]: this machine's first, then each player's
  uint32_t kept_ = 0;                                  ///< number of ticks whose inputs and checksums are kept
  bool begun_ = false;
  uint64_t start_ = 0;           ///< the tick at `begin`
  uint64_t tick_ = 0;            ///< ticks completed
  uint64_t wrong_ = UINT64_MAX;  ///< the first tick that was simulated with a wrong input
  uint64_t next_[k_rollback_players_max] = {};
  Desync desync_ = {};
};

/// @cond
struct RollbackSession::Checksum {
  uint64_t stamp;  ///< tick + 1; 0: empty
  uint32_t value;
  uint32_t compared;
};

inline constexpr uint32_t k_sparse_control_bytes = 1024, k_tick_head_bytes = 768, k_sparse_sets = 5;

// Offsets of the parts of sparse rollback (lib/replay/sparse_rollback.h), bytes.
struct SparseLayout {
  uint32_t images, image_bytes, records, record_bytes;
  uint32_t reach, movers, solved, part_inside, part_visible, contact_events, joint_events, sensor_events,
      body_events;  // this line and the line above: offsets from the start of a record
  uint32_t boxes, reach_now, units, list, sets, joint_sets;
  uint64_t bytes;
};

constexpr SparseLayout sparse_layout(Capacity capacity, uint32_t window) {
  SparseLayout layout{};
  uint64_t end = 0;
  const auto place = [&end](uint64_t bytes) {
    const uint64_t start = end;
    end = (end + bytes + 7) / 8 * 8;
    return static_cast<uint32_t>(start);
  };
  const uint64_t bounds = uint64_t{sizeof(Bounds)} * capacity.bodies, set = uint64_t{4} * slot_words(capacity.bodies);
  place(k_tick_head_bytes);
  layout.reach = place(bounds);
  layout.movers = place(set);
  layout.solved = place(set);
  layout.part_inside = place(set);
  layout.part_visible = place(set);
  layout.contact_events = place(sizeof(ContactEvent) * uint64_t{capacity.contacts});
  layout.joint_events = place(sizeof(JointEvent) * uint64_t{capacity.joints});
  layout.sensor_events = place(sizeof(SensorEvent) * 2 * uint64_t{capacity.sensed});
  layout.body_events = place(sizeof(BodyEvent) * uint64_t{capacity.bodies});
  const uint64_t record = end;
  layout.record_bytes = static_cast<uint32_t>(record);
  end = 0;
  place(k_sparse_control_bytes);
  layout.image_bytes = snapshot_bytes(capacity);
  // window + 1 states between ticks, window states just before the steps of these ticks (after the calls of the game),
  // and one spare state.
  layout.images = place(uint64_t{layout.image_bytes} * (2 * window + 2));
  layout.records = place(record * window);
  layout.boxes = place(bounds);
  layout.reach_now = place(bounds);
  layout.units = place(uint64_t{4} * capacity.bodies);
  layout.list = place(uint64_t{4} * capacity.bodies);
  layout.sets = place(set * k_sparse_sets);
  layout.joint_sets = place(uint64_t{8} * slot_words(capacity.joints));
  layout.bytes = end;
  return layout;
}

// Offsets of the session's parts in its memory, bytes.
struct RollbackLayout {
  uint32_t games, inputs, stamps, sums, kept;
  uint64_t bytes;  ///< 0: out of range
};

// The number of ticks whose inputs are kept. Let t be the first tick for which a machine lacks an input. After t, the
// machine is up to one window ahead. A remote player is up to one delay and one window ahead of the machine, and its
// inputs are one delay ahead of the player. Before t, the machine may have to send its own inputs of the last window
// and delay again. A delay is at most one window, so at most 4 windows after t and 2 windows before t are needed.
constexpr uint32_t rollback_ticks_kept(uint32_t window) { return 6 * window + 2; }

constexpr RollbackLayout rollback_layout(Capacity capacity, const RollbackDef& def) {
  RollbackLayout layout{};
  uint64_t states = snapshot_ring_bytes(capacity, def.window);
#if DETENT_SPARSE
  if (def.sparse && states != 0 && def.window <= k_rollback_window_max)
    states = sparse_layout(capacity, def.window).bytes;
#endif
  if (def.players < 1 || def.players > k_rollback_players_max || def.window < 1 || def.window > k_rollback_window_max ||
      def.input_bytes < 1 || def.input_bytes > k_rollback_input_bytes_max || def.delay > def.window || states == 0 ||
      states > UINT32_MAX) {
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

/// The settings of sync_test().
struct SyncTestDef {
  uint32_t ticks = 1;               ///< number of ticks to simulate and to repeat
  const uint8_t* inputs = nullptr;  ///< [tick][player]: the inputs; null if there are none
  uint32_t players = 0;             ///< TickInputs::players
  uint32_t input_bytes = 0;         ///< TickInputs::input_bytes
};

/// The result of sync_test().
struct SyncTestReport {
  uint64_t tick = 0;    ///< after digest_differs: ticks completed in the first state that differs
  uint64_t first = 0;   ///< digest of this state when the tick was simulated first
  uint64_t second = 0;  ///< digest of this state when the tick was repeated
};

/// Bytes of memory that sync_test() needs; 0 if an argument is out of range.
constexpr uint32_t sync_test_bytes(Capacity capacity, uint32_t ticks, uint32_t game_bytes = 0) {
  const uint64_t bytes = uint64_t{snapshot_ring_bytes(capacity, 1)} + uint64_t{8} * ticks + game_bytes;
  return ticks == 0 || bytes > UINT32_MAX || snapshot_ring_bytes(capacity, 1) == 0 ? 0 : static_cast<uint32_t>(bytes);
}

/// Tests the TickMaker of a session: simulates ticks, restores the state before them, repeats them, and compares the
/// digests after each tick. `game`: the state besides the world that the maker changes; {}: none. Afterwards the world
/// and `game` have the state after the repeated ticks.
/// Errors: digest_differs (`report` has the tick; the world is at this tick), out_of_range, buffer_too_small,
/// buffer_misaligned, bad_argument (no maker; inputs without bytes; a maker that did not step the world exactly once).
Status sync_test(World& world, const SyncTestDef& def, TickMaker maker, uint8_t* memory, uint32_t memory_bytes,
                 GameState game, SyncTestReport& report);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
