#pragma once
#include "examples/scenes/scene.h"

/// Small scenes in which bodies fall, pile up and come to rest.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace piles {

WorldDef tiny_world();
WorldDef stack_world();
WorldDef capsules_world();
WorldDef balls_world();
void build_tiny(Recorder& recorder);
void build_stack(Recorder& recorder);
void build_capsules(Recorder& recorder);
void build_balls(Recorder& recorder);

inline constexpr Scene k_tiny = {"tiny", "four boxes in contact, for a machine of 16 KB", 300, tiny_world, build_tiny,
                                 nullptr};
inline constexpr Scene k_stack = {"stack", "five boxes stacked on the ground", 300, stack_world, build_stack, nullptr};
inline constexpr Scene k_capsules = {"capsules", "ten capsules dropped crosswise", 300, capsules_world, build_capsules,
                                     nullptr};
inline constexpr Scene k_balls = {
    "balls", "twenty balls of four sizes thrown at a slope", 300, balls_world, build_balls, nullptr};

}  // namespace piles
}  // namespace DETENT_NAMESPACE
}  // namespace detent
