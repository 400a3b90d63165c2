#pragma once
#include "examples/billiards/shots.h"
#include "examples/scenes/scene.h"

/// A match of eight-ball on a nine-foot table, from the break on, at 1000 ticks a second. README.md describes the
/// table, the simplifications and their reasons.
///
/// The scene stores no state outside the world: the number of shots played is the cloth's user data, and each ball's
/// user data contains its number. So a match that continues from a snapshot plays the right next shot.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {

inline constexpr uint32_t k_ball_count = 16;  ///< the cue ball and fifteen object balls

/// A cloth, six cushions and the balls; each ball touches the cloth and at most two cushions, and the rack has
/// thirty pairs of balls.
inline constexpr Capacity k_capacity = {.bodies = 1 + 6 + k_ball_count, .contacts = 96};

WorldDef world();
/// Lays out the cloth, the cushions, the cue ball on the head spot and the rack on the foot spot.
void build(Recorder& recorder);
/// Removes pocketed balls from the table. When all others lie still, puts a pocketed cue ball back on the head string
/// and plays the next shot.
void before_tick(Recorder& recorder, uint32_t tick);

/// Shots played so far, at most k_shot_count.
uint32_t shots_played(const World& world);
/// The first ball after `previous` (null to begin) in slot order, or null at the end.
BodyId next_ball(const World& world, BodyId previous);
/// The number on the ball, [1, 15], or 0 for the cue ball.
uint32_t ball_number(const World& world, BodyId ball);

inline constexpr Scene k_scene = {"billiards", "a break and seven shots on a nine-foot pool table", 24000, world, build,
                                  before_tick};

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
