#pragma once
#include <detent/rollback.h>

#include "base/digest.h"

/// Operations on a game's own bytes (GameState), for rollback sessions and sync_test().
namespace detent {
inline namespace DETENT_NAMESPACE {

inline bool is_game_state(const GameState& game, uint32_t bytes) {
  return game.count == bytes && (bytes == 0 || game.bytes != nullptr);
}

inline uint64_t digest_of(const World& world, const GameState& game) {
  const uint64_t whole = digest(world);
  return game.count == 0 ? whole : digest_bytes(game.bytes, game.count, whole);
}

inline bool same_bytes(const uint8_t* a, const uint8_t* b, uint32_t count) {
  uint32_t difference = 0;
  for (uint32_t i = 0; i < count; ++i) difference |= static_cast<uint32_t>(a[i] ^ b[i]);
  return difference == 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
