#pragma once
#include "examples/scenes/scene.h"

/// What bodies and worlds are is changed during the match: shapes, types, masses, materials, locks, filters, settings;
/// explosions, pushes at points, a platform that is sent to poses, and questions asked of the world.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace changes {

WorldDef world();
void build(Recorder& recorder);
void before_tick(Recorder& recorder, uint32_t tick);

inline constexpr Scene k_scene = {
    "changes", "bodies and worlds changed on the way: shapes, types, locks, filters, settings; explosions, queries",
    240,       world,
    build,     before_tick};

}  // namespace changes
}  // namespace DETENT_NAMESPACE
}  // namespace detent
