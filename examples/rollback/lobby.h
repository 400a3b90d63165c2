#pragma once
#include "examples/rollback/match.h"
#include "examples/rollback/options.h"
#include "examples/rollback/transport.h"

/// Brings the machines together before a match.
namespace detent_rollback {

/// The players that this machine exchanges packets with, and the transport peer of each.
struct Peers {
  bool is_there[k_players_max] = {};
  uint32_t peer[k_players_max] = {};
  /// The player at this peer, or k_players_max.
  uint32_t player_at(uint32_t number) const {
    uint32_t player = 0;
    while (player < k_players_max && !(is_there[player] && peer[player] == number)) ++player;
    return player;
  }
};

/// Waits until all players have joined and sent a Hello with this program's version and the options' key; then sends
/// each its Welcome. Drops a guest that sends no such Hello within two seconds. Returns false if `stop` was set.
bool gather(Transport& transport, const Options& options, const volatile int& stop, Welcome& welcome, Peers& peers);
/// Joins a host and waits for its Welcome. Returns null, or the reason of the failure.
const char* join(Transport& transport, const Options& options, const volatile int& stop, Welcome& welcome,
                 Peers& peers);

}  // namespace detent_rollback
