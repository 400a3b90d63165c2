#pragma once
#include "examples/scenes/scene.h"

/// Calls of world.h during the match: a kinematic mover, pushes of each kind, bodies that come and go.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace traffic {

WorldDef world();
void build(Recorder& recorder);
void before_tick(Recorder& recorder, uint32_t tick);

inline constexpr Scene k_scene = {
    "traffic", "calls: a mover, pushes of each kind, bodies that come and go", 300, world, build, before_tick};

}  // namespace traffic
}  // namespace DETENT_NAMESPACE
}  // namespace detent
