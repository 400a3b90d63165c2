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

/// All scenes, in a fixed order. Never null.
const Scene* scenes(uint32_t& count);
/// The scene of this name, or null.
const Scene* find_scene(const char* name);

/// The body that comes `index`-th in slot order, or null.
BodyId nth_body(const World& world, uint32_t index);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
