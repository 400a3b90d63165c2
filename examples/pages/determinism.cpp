#include <detent/numbers.h>
#include <detent/world.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

using Storage = WorldStorage<Capacity{.bodies = 8, .contacts = 32}>;

/// Both worlds are built by the same calls in the same order.
void build(Storage& storage, World& world, BodyId& player) {
  check(storage.create({}, world));
  BodyId ground;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  check(create_body(world, {.position = {0.0, 1.0, 0.0}, .shape = sphere(0.5)}, player));
}

/// The data sent between the machines: integers only.
struct Input {
  int16_t push;  ///< 1/256 N s
};

void apply(World& world, BodyId player, const Input& input) {
  Scaled impulse;
  check(scaled_from_host(input.push / 256.0, impulse));  // exact: a power of two
  check(apply_impulse(world, player, {impulse, 0.0, 0.0}));
}

}  // namespace

int main() {
  static Storage here_storage, there_storage;
  World here, there;
  BodyId player_here, player_there;
  build(here_storage, here, player_here);
  build(there_storage, there, player_there);

  for (int tick = 0; tick < 120; ++tick) {
    const Input input = {static_cast<int16_t>(tick * 100)};
    apply(here, player_here, input);
    apply(there, player_there, input);
    step(here);
    step(there);
    check(digest(here) == digest(there));
  }

  check(apply_impulse(here, player_here, {0.0, Scaled(1e-9), 0.0}));  // a nanonewton-second more
  check(digest(here) != digest(there));
}
