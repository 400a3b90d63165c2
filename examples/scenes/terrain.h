#pragma once
#include "examples/scenes/scene.h"

/// Bodies of every shape dropped into a valley made of a mesh and on hills of a height field, shot at both through
/// sensors, and a valley that turns.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace terrain_scene {

WorldDef world();
void build(Recorder& recorder);
void before_tick(Recorder& recorder, uint32_t tick);

inline constexpr Scene k_scene = {
    "terrain",  "all shapes on a mesh and a height field, and shots at them through sensors", 240, world, build,
    before_tick};

}  // namespace terrain_scene
}  // namespace DETENT_NAMESPACE
}  // namespace detent
