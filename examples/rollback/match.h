#pragma once
#include <detent/rollback.h>

#include <vector>

#include "examples/rollback/game.h"
#include "examples/rollback/guard.h"
#include "examples/rollback/packet.h"

/// One machine's part in a match: a RollbackSession, plus the bytes that it exchanges with the other machines. It uses
/// neither sockets nor clocks.
///
/// Player 0 is the host. Every client exchanges packets with the host only, and the host passes on the inputs that it
/// has. So only the host has to be reachable, no client can send different inputs to different players, and when a
/// client leaves, the host alone decides from which tick on its input is 0. The cost: data between two clients travels
/// through the host.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace pitch {

using detent_rollback::Guard;
using detent_rollback::Verdict;

/// Settings of one machine's part in the match.
struct MatchDef {
  uint32_t match = 0;    ///< identifies the match
  uint32_t player = 0;   ///< the player at this machine, below `players`
  uint32_t players = 2;  ///< [2, k_players_max]
  uint32_t window = 16;  ///< RollbackDef::window
  uint32_t delay = 2;    ///< RollbackDef::delay
  uint32_t ticks = 600;  ///< length of the match
};

/// Counts over the whole match: rollbacks, resimulated ticks, waits and traffic.
struct MatchFigures {
  uint64_t rollbacks = 0, ticks_again = 0, longest_rollback = 0, waits = 0;
  uint64_t packets_in = 0, packets_out = 0, bytes_in = 0, bytes_out = 0, repeated = 0;
};

class Match {
 public:
  explicit Match(const MatchDef& def);
  Match(const Match&) = delete;
  Match& operator=(const Match&) = delete;

  /// The tick that the next local input is for.
  uint64_t input_tick() const { return session_.tick() + def_.delay; }
  /// Makes a tick with this local input, or waits for the inputs of other players. After the last tick it only
  /// corrects.
  void frame(uint8_t input);
  /// Whether this machine exchanges packets with `other`: the host with every player that has not left, a client with
  /// the host.
  bool speaks_with(uint32_t other) const;
  /// Writes the packet for `other` after this frame. Returns the number of bytes, at most k_packet_bytes_max.
  uint32_t write_for(uint32_t other, uint8_t* bytes);
  /// Reads a packet that `from` sent; `now`: s. A refused packet changes nothing but the guard's counts.
  Verdict take(uint32_t from, const uint8_t* bytes, uint32_t count, double now);
  /// Whether the connection to this sender should be closed.
  bool is_hostile(uint32_t from) const { return others_[from].guard.is_hostile(); }
  /// Host only: marks a client as gone. Its input is 0 from the first tick on for which no input has arrived.
  void leave(uint32_t player) { left_ |= 1u << player; }
  bool has_left(uint32_t player) const { return (left_ >> player & 1) != 0; }

  /// Whether every input of every tick is known and simulated.
  bool is_over() const { return confirmed_.size() == size_t{def_.ticks} * def_.players; }
  /// The player whose inputs are known for the fewest ticks: the one to wait for, if this machine waits.
  uint32_t slowest() const;
  /// How many ticks this machine is ahead of the slowest other machine, at least 0; the faster machine should slow
  /// down.
  double ticks_ahead() const;
  /// The longest round trip to another machine, in ticks, including the wait for its next frame.
  double round_trip_ticks() const;

  const MatchDef& def() const { return def_; }
  const World& world() const { return world_; }
  const RollbackSession& session() const { return session_; }
  const MatchFigures& figures() const { return figures_; }
  uint64_t refused() const;
  /// The inputs of all players in the ticks that can no longer change.
  const std::vector<uint8_t>& confirmed_inputs() const { return confirmed_; }

 private:
  struct Other {
    Guard guard;
    uint32_t sequence = 0;  ///< of the last packet sent to this machine
    uint32_t tick = 0;      ///< the newest tick that this machine has reported
    /// For each player: the first input that this machine lacks, as far as we know.
    uint32_t wanted[k_players_max] = {};
    /// How far we are ahead of it by our count, and it ahead of us by its count, ticks; moving averages.
    double ahead = 0, behind = 0;
  };

  bool passes_on(uint32_t player, uint32_t from) const;
  uint64_t known_tick() const;
  bool is_plausible(const detent_rollback::Packet& packet) const;
  void use(const detent_rollback::Packet& packet);
  void play_for_who_left();
  void log_confirmed();
  int32_t ahead_of(const Other& other) const;
  bool add_run(uint32_t player, uint64_t first, detent_rollback::Run& run) const;

  MatchDef def_;
  std::vector<uint64_t> block_, memory_;
  World world_;
  RollbackSession session_;
  Other others_[k_players_max];
  uint32_t left_ = 0;
  std::vector<uint8_t> confirmed_;
  MatchFigures figures_;
};

/// Replays these inputs in a world without rollbacks and records it into `sink`. Returns the final digest, 0 on
/// failure.
uint64_t replay_inputs(const std::vector<uint8_t>& inputs, uint32_t players, Sink sink);

}  // namespace pitch
}  // namespace DETENT_NAMESPACE
}  // namespace detent
