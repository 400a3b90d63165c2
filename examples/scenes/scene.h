#pragma once
#include <detent/recording.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A scripted match, shared by tests, benchmarks, examples and the detent tool. It changes the world through the
/// recorder alone, keeps no state of its own (ids come from the world: see `nth_body`), and is the same on every
/// machine.
struct Scene {
  const char* name;         ///< as given on the command line: lower case, digits, '_'
  const char* description;  ///< one line
  uint32_t ticks;           ///< its length
  WorldDef (*world)();
  void (*build)(Recorder& recorder);  ///< makes the first bodies, before `Recorder::begin`
  void (*before_tick)(Recorder& recorder,
                      uint32_t tick);  ///< the calls before step number `tick` (0, 1 ...); may be null
};

/// What the scenes' worlds have for assets; scenes without make nothing of it. Made of files by scenes.cmake.
AssetTable scene_assets();
inline constexpr uint32_t k_asset_valley = 0;    ///< a mesh, a valley along z of 8 m by 8 m
inline constexpr uint32_t k_asset_hills = 1;     ///< a height field of 12 m by 12 m
inline constexpr uint32_t k_asset_round = 2;     ///< a hull
inline constexpr uint32_t k_asset_dumbbell = 3;  ///< a compound of 1.4 m

/// All scenes, in a fixed order. Never null.
const Scene* scenes(uint32_t& count);
/// The scene of this name, or null.
const Scene* find_scene(const char* name);

/// The body that comes `index`-th in slot order, or null.
BodyId nth_body(const World& world, uint32_t index);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
