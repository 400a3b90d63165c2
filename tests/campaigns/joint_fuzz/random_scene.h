#pragma once
#include "tests/campaigns/joint_fuzz/scene.h"

namespace detent_joint_fuzz {

/// The kind of the scene with this seed: of sixteen consecutive seeds two are pairs, three trees, three loops, three
/// nets, and one each of the other kinds.
Kind kind_of(uint64_t seed);

/// The scene with this seed. Its poses fit all joints. Velocities fit the joints in half of all scenes; they are up to
/// 5 m/s, and in two fifths of the scenes angular velocities are up to 80 rad/s (but at most 200 m/s at the end of two
/// arms). Mass ratios are up to 1e4 in a fifth of the scenes. Arms are up to 16 m long in pairs, trees and ropes, up to
/// 1 m where bodies collide, up to 4 m in the rest, and in most scenes at least 1 cm. Two fifths of the scenes mix the
/// types of joints; three tenths have limits. A third has gravity: nine tenths of these hang on a wall, as does a
/// quarter of the others. Joints that slide have limits, except in half of the pairs.
Scene random_scene(uint64_t seed);

}  // namespace detent_joint_fuzz
