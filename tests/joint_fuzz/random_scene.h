#pragma once
#include "tests/joint_fuzz/scene.h"

namespace detent_joint_fuzz {

/// The kind of the scene of a seed: of sixteen seeds in a row two are pairs, three trees, three loops, three nets, and
/// one each of the others.
Kind kind_of(uint64_t seed);

/// The scene of a seed. Its start fits all its joints; its velocities do in half of all scenes, and are of up to 5 m/s,
/// with spins of up to 80 rad/s in two fifths (but no more than 200 m/s at the end of two arms). Bodies weigh up to 1e4
/// times each other in a fifth; arms are of up to 16 m in pairs, trees and ropes, 4 m in the rest, 1 m where bodies
/// meet, and of 1 cm at least in most. Two fifths mix the types of joints; three tenths have limits; a third has
/// gravity, and nine tenths of those hang on a wall, as a quarter of the others does. What slides has limits, but in
/// half of the pairs.
Scene random_scene(uint64_t seed);

}  // namespace detent_joint_fuzz
