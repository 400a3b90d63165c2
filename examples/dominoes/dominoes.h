#pragma once
#include "examples/scenes/scene.h"

/// A row of dominoes; the first one leans and knocks the others over, one after the other.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace dominoes {

inline constexpr uint32_t k_count = 200;
inline constexpr uint32_t k_count_short = 40;  ///< for small memories and slow machines

/// A floor and the dominoes. Each domino touches the floor and at most three others that lie on it or under it.
constexpr Capacity capacity_of(uint32_t count) { return {.bodies = 1 + count, .contacts = 4 * count}; }

WorldDef world();
WorldDef world_short();
void build(Recorder& recorder);
void build_short(Recorder& recorder);

/// Dominoes that lean by more than 45 degrees.
uint32_t fallen(const World& world);

inline constexpr Scene k_scene = {"dominoes", "200 dominoes fall one after the other", 1800, world, build, nullptr};
inline constexpr Scene k_scene_short = {
    "dominoes_short", "40 dominoes fall one after the other", 600, world_short, build_short, nullptr};

}  // namespace dominoes
}  // namespace DETENT_NAMESPACE
}  // namespace detent
