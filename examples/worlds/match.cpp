#include "examples/worlds/match.h"

#include "examples/rollback/game.h"
#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace worlds {

Match::Match() : block(world_bytes(pitch::k_capacity) / sizeof(uint64_t)) {
  uint8_t* const bytes = reinterpret_cast<uint8_t*>(block.data());
  must(create_world(bytes, world_bytes(pitch::k_capacity), pitch::world(), {}, world));
}

Match::Match(uint64_t of_seed) : Match() {
  seed = of_seed;
  Recorder recorder(world, {}, nullptr, 0);  // the pitch is made through a recorder; this one writes nothing
  pitch::build(recorder, pitch::k_players_max);
}

void Match::play(uint32_t ticks) {
  Recorder recorder(world, {}, nullptr, 0);
  for (uint32_t i = 0; i < ticks; ++i) {
    uint8_t inputs[pitch::k_players_max];
    const uint64_t tick = get_info(world).tick;
    for (uint32_t player = 0; player < pitch::k_players_max; ++player) {
      inputs[player] = pitch::bot_input(seed, player, tick);
    }
    pitch::play(recorder, inputs, pitch::k_players_max);
    step(world);
  }
}

}  // namespace worlds
}  // namespace DETENT_NAMESPACE
}  // namespace detent
