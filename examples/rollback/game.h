#pragma once
#include "tests/scenes/scene.h"

/// A game of physics for two to four players: on a walled pitch everybody rolls a ball of their own about, throws
/// shots, and tries to get the game's ball through the others' goal, past loose crates. Players 0 and 2 play to the
/// right, 1 and 3 to the left.
///
/// The game keeps nothing outside the world: bodies know what they are by their user data, the ground has the score. So
/// a rollback needs the world's snapshots alone, and a recording of the world is one of the game.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace pitch {

inline constexpr uint32_t k_players_max = 4;

/// Nine bodies of the pitch, eight crates, the ball, and of each player a ball and a shot.
inline constexpr Capacity k_capacity = {.bodies = 32, .contacts = 64};

/// What a player does in a tick: bits of one byte.
inline constexpr uint8_t k_right = 1, k_left = 2, k_near = 4, k_far = 8;
inline constexpr uint8_t k_throw = 16;   ///< a shot, the way that the player goes; one at a time
inline constexpr uint8_t k_inputs = 32;  ///< all inputs are below

inline constexpr double k_half_length = 9, k_half_width = 5;  ///< of the pitch, m, along x and z

WorldDef world();
/// Lays out the pitch, the crates, the ball and the players.
void build(Recorder& recorder, uint32_t players);
/// What everybody's inputs, a byte each, do before the world is stepped.
void play(Recorder& recorder, const uint8_t* inputs, uint32_t players);

/// What a body is. Stored in user data.
enum class Kind : uint32_t { pitch, player, ball, crate, shot };
Kind kind_of(const World& world, BodyId body);
/// Whose a player's ball or a shot is.
uint32_t owner_of(const World& world, BodyId body);

/// Goals of those who play to the right, and of those who play to the left.
struct Score {
  uint32_t right, left;
};
Score score(const World& world);

/// What a player does who has no hands: nothing in the first second, then anything, by the seed, the player and the
/// tick alone. A bot that looked at the world would see predictions, and so play another match on each machine.
uint8_t bot_input(uint64_t seed, uint32_t player, uint64_t tick);

/// Four bots.
void build_for_bots(Recorder& recorder);
void play_bots(Recorder& recorder, uint32_t tick);
inline constexpr Scene k_scene = {"match",  "four bots on the pitch of examples/rollback", 600, world, build_for_bots,
                                  play_bots};

}  // namespace pitch
}  // namespace DETENT_NAMESPACE
}  // namespace detent
