#pragma once
#include "examples/rollback/match.h"
#include "examples/rollback/options.h"
#include "examples/rollback/transport.h"

/// How machines come together before a match.
namespace detent_rollback {

/// Who is who: the peers of the players with whom this machine speaks.
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

/// Waits until everybody has joined and said a Hello of this program's version and the options' key, and tells them
/// that the match begins. Who does not, within two seconds, is dropped. False: `stop` was set.
bool gather(Transport& transport, const Options& options, const volatile int& stop, Welcome& welcome, Peers& peers);
/// Joins a host and waits for its Welcome. Null, or why it came to nothing.
const char* join(Transport& transport, const Options& options, const volatile int& stop, Welcome& welcome,
                 Peers& peers);

}  // namespace detent_rollback
