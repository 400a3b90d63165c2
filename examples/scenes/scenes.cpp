#include "examples/billiards/billiards.h"
#include "examples/dominoes/dominoes.h"
#include "examples/rollback/game.h"
#include "examples/scenes/changes.h"
#include "examples/scenes/jointed.h"
#include "examples/scenes/piles.h"
#include "examples/scenes/terrain.h"
#include "examples/scenes/traffic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr Scene k_scenes[] = {piles::k_tiny,      piles::k_stack,    piles::k_capsules,       piles::k_balls,
                              traffic::k_scene,   changes::k_scene,  jointed::k_scene,        terrain_scene::k_scene,
                              billiards::k_scene, dominoes::k_scene, dominoes::k_scene_short, pitch::k_scene};

bool equal(const char* a, const char* b) {
  for (; *a == *b; ++a, ++b) {
    if (*a == '\0') return true;
  }
  return false;
}

}  // namespace

const Scene* scenes(uint32_t& count) {
  count = sizeof k_scenes / sizeof k_scenes[0];
  return k_scenes;
}

const Scene* find_scene(const char* name) {
  for (const Scene& scene : k_scenes) {
    if (equal(scene.name, name)) return &scene;
  }
  return nullptr;
}

BodyId nth_body(const World& world, uint32_t index) {
  BodyId id = next_body(world, {});
  while (index-- != 0 && !(id == BodyId{})) id = next_body(world, id);
  return id;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
