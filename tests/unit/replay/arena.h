#pragma once
#include <detent/rollback.h>

#include "tests/unit/replay/match.h"

/// A game for session tests: players push balls about, and create and destroy boxes.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_arena_input_bytes = 2, k_arena_players_max = 4;

struct Arena {
  static constexpr Capacity k_capacity = {8, 16, 0, true, 1, 0};
  /// The state of the game that is rolled back together with the world.
  struct Score {
    uint32_t jumps[k_arena_players_max];
    uint32_t boxes;
  };

  OwnedWorld owned = OwnedWorld(k_capacity);
  Score score = {};
  uint64_t meddled_tick = UINT64_MAX;  ///< in which something happens that no input says
  uint32_t predicted = 0, again = 0;   ///< ticks

  explicit Arena(uint32_t players) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = half_space();
    BodyId id;
    EXPECT_OK(create_body(owned.world, def, id));
    const Coord places[k_arena_players_max] = {-0.75, 0.0, 0.75, 1.5};
    for (uint32_t i = 0; i < players; ++i) {
      def = {};
      def.position = {places[i], 0.5, i % 2 == 0 ? Coord(0.0) : Coord(0.5)};
      def.linear_damping = 1.0;
      EXPECT_OK(create_body(owned.world, def, id));
    }
  }
  Arena(const Arena&) = delete;

  GameState state() { return {reinterpret_cast<uint8_t*>(&score), sizeof score}; }
  TickMaker maker() { return {make, this}; }
  uint64_t sum() { return digest(owned.world) + 31 * score.boxes + score.jumps[0] + 7 * score.jumps[1]; }

  static void make(void* context, World& world, const TickInputs& inputs) {
    Arena& arena = *static_cast<Arena*>(context);
    arena.predicted += inputs.predicted != 0 ? 1u : 0u;
    arena.again += inputs.again ? 1u : 0u;
    EXPECT_EQ(inputs.tick, get_info(world).tick);
    for (uint32_t player = 0; player < inputs.players; ++player) {
      arena.apply(world, inputs.players, player, inputs.of(player));
    }
    if (inputs.tick == arena.meddled_tick) ++arena.score.boxes;
    step(world);
  }

  /// In slot order.
  static BodyId body_at(const World& world, uint32_t index) {
    BodyId id = next_body(world, {});
    while (index-- != 0) id = next_body(world, id);
    return id;
  }

  void apply(World& world, uint32_t players, uint32_t player, const uint8_t* input) {
    const BodyId ball = body_at(world, 1 + player);
    const Scaled pushes[4] = {-20.0, 0.0, 0.0, 20.0};
    const Vec3<Scaled> push = {pushes[input[0] & 3], input[0] >> 4 == 1 ? Scaled(400.0) : Scaled(0.0),
                               pushes[input[0] >> 2 & 3]};
    EXPECT_OK(apply_impulse(world, ball, push));
    if (input[0] >> 4 == 1) ++score.jumps[player];
    const uint32_t boxes = get_info(world).bodies - 1 - players;
    if (input[1] == 1) {
      BodyDef def;
      def.shape = box({0.25, 0.25, 0.25});
      def.position = {0.0, 3.0, 0.25};
      BodyId id;
      if (create_body(world, def, id) == Status::ok) ++score.boxes;
    } else if (input[1] == 2 && boxes != 0) {
      EXPECT_OK(destroy_body(world, body_at(world, 1 + players + score.boxes % boxes)));
    }
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
