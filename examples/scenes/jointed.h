#pragma once
#include "examples/scenes/scene.h"

/// Joints of every type: a chain from a turning arm, a door with a motor, a lift, a cart on two wheels with springs, a
/// limp figure, a ring, and a rope that breaks; motors and limits are set anew on the way.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace jointed {

WorldDef world();
void build(Recorder& recorder);
void before_tick(Recorder& recorder, uint32_t tick);

inline constexpr Scene k_scene = {
    "jointed", "joints of every type, driven, limited, set anew and broken", 240, world, build, before_tick};

}  // namespace jointed
}  // namespace DETENT_NAMESPACE
}  // namespace detent
