#pragma once
#include <detent/rollback_session.h>

#include <vector>

#include "examples/rollback/game.h"
#include "examples/rollback/guard.h"
#include "examples/rollback/packet.h"

/// One machine's part in a match: a RollbackSession, and what it takes from and sends to the others as bytes. It knows
/// neither sockets nor clocks.
///
/// Player 0 is the host, and everybody speaks with the host alone, who passes on the inputs that it knows. So only one
/// machine has to be reachable; nobody can tell two players two different things; and when somebody leaves, the host
/// alone says from which tick on they do nothing. The price is the way over the host between two clients.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace pitch {

using detent_rollback::Guard;
using detent_rollback::Verdict;

/// What a machine's part is.
struct MatchDef {
  uint32_t match = 0;    ///< a number that tells it from other matches
  uint32_t player = 0;   ///< who plays here
  uint32_t players = 2;  ///< [2, k_players_max]
  uint32_t window = 16;  ///< RollbackDef::window
  uint32_t delay = 2;    ///< RollbackDef::delay
  uint32_t ticks = 600;  ///< how long it lasts
};

/// What it took.
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
  /// Makes a tick with this local input, or waits for those of others; after the last one only corrects.
  void frame(uint8_t input);
  /// Whom this machine speaks with: the host with everybody who has not left, the others with the host.
  bool speaks_with(uint32_t other) const;
  /// What `other` is to be told after this frame. Returns the number of bytes, at most k_packet_bytes_max.
  uint32_t write_for(uint32_t other, uint8_t* bytes);
  /// What `from` sent, at a time in s. What is refused has changed nothing.
  Verdict take(uint32_t from, const uint8_t* bytes, uint32_t count, double now);
  /// Whether a sender should be thrown out.
  bool is_hostile(uint32_t from) const { return others_[from].guard.is_hostile(); }
  /// At the host: a client is gone, and does nothing from the first tick on of which no input has come.
  void leave(uint32_t player) { left_ |= 1u << player; }
  bool has_left(uint32_t player) const { return (left_ >> player & 1) != 0; }

  /// Every input of every tick is known, and used.
  bool is_over() const { return confirmed_.size() == size_t{def_.ticks} * def_.players; }
  /// The player whose inputs are least known: who is waited for, if anybody is.
  uint32_t slowest() const;
  /// How many ticks this machine is ahead of who is farthest behind; who is ahead should take it slower.
  double ticks_ahead() const;
  /// The longest way to another machine and back, in ticks, frames included.
  double round_trip_ticks() const;

  const MatchDef& def() const { return def_; }
  const World& world() const { return world_; }
  const RollbackSession& session() const { return session_; }
  const MatchFigures& figures() const { return figures_; }
  uint64_t refused() const;
  /// The inputs of the ticks that can no longer change, of all players.
  const std::vector<uint8_t>& confirmed_inputs() const { return confirmed_; }

 private:
  struct Other {
    Guard guard;
    uint32_t sequence = 0;                ///< of the last packet to it
    uint32_t tick = 0;                    ///< the newest that it told
    uint32_t wanted[k_players_max] = {};  ///< the first input of each player that it lacks, as far as we know
    double ahead = 0, behind = 0;  ///< how far we see us before it, and it sees itself before us; means of the last
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

/// The digest after these ticks, in a world that never went back; recorded into `sink` on the way. 0 if that failed.
uint64_t replay_inputs(const std::vector<uint8_t>& inputs, uint32_t players, Sink sink);

}  // namespace pitch
}  // namespace DETENT_NAMESPACE
}  // namespace detent
