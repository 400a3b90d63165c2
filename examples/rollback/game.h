#pragma once
#include "examples/scenes/scene.h"

/// A physics game for two to four players on a walled pitch. Each player rolls a ball, throws shots, and tries to push
/// the game's ball past loose crates into the opponents' goal. Players 0 and 2 play to the right, 1 and 3 to the left.
///
/// The game stores no state outside the world: the user data of a body gives its kind, the ground's user data holds the
/// score. So the world's snapshots are enough for a rollback, and a recording of the world is a recording of the game.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace pitch {

inline constexpr uint32_t k_players_max = 4;

/// Nine bodies of the pitch, eight crates, the ball, and for each player a ball and a shot.
inline constexpr Capacity k_capacity = {.bodies = 32, .contacts = 64};

/// A player's input in a tick: bits of one byte.
inline constexpr uint8_t k_right = 1, k_left = 2, k_near = 4, k_far = 8;
/// A shot in the direction that the player moves; a player has at most one shot at a time.
inline constexpr uint8_t k_throw = 16;
inline constexpr uint8_t k_inputs = 32;  ///< all inputs are below it

inline constexpr double k_half_length = 9, k_half_width = 5;  ///< half sizes of the pitch along x and z, m

WorldDef world();
/// Lays out the pitch, the crates, the ball and the players.
void build(Recorder& recorder, uint32_t players);
/// Applies the inputs of all players, one byte each, before the world is stepped.
void play(Recorder& recorder, const uint8_t* inputs, uint32_t players);

/// The kind of a body, stored in its user data.
enum class Kind : uint32_t { pitch, player, ball, crate, shot };
Kind kind_of(const World& world, BodyId body);
/// The player that owns this player's ball or shot.
uint32_t owner_of(const World& world, BodyId body);

/// Goals of the players that play to the right, and of those that play to the left.
struct Score {
  uint32_t right, left;
};
Score score(const World& world);

/// The input of a bot: nothing in the first second, then random inputs that depend only on the seed, the player and the
/// tick. A bot that reads the world would read predicted states, and its inputs would then differ between machines.
uint8_t bot_input(uint64_t seed, uint32_t player, uint64_t tick);

/// The scene with four bots.
void build_for_bots(Recorder& recorder);
void play_bots(Recorder& recorder, uint32_t tick);
inline constexpr Scene k_scene = {"match",  "four bots on the pitch of examples/rollback", 600, world, build_for_bots,
                                  play_bots};

}  // namespace pitch
}  // namespace DETENT_NAMESPACE
}  // namespace detent
