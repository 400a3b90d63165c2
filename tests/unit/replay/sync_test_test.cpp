#include "tests/unit/replay/arena.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_ticks = 20, k_players = 2;

/// Inputs that push, jump, and create and destroy boxes.
Bytes inputs_of(uint32_t seed) {
  Bytes inputs(k_ticks * k_players * k_arena_input_bytes);
  for (size_t i = 0; i < inputs.size(); ++i) {
    seed = seed * 1664525 + 1013904223;
    inputs[i] = static_cast<uint8_t>(i % 2 == 0 ? seed >> 27 : seed >> 28 & 3);
  }
  return inputs;
}

struct SyncTest {
  Arena arena = Arena(k_players);
  Bytes inputs = inputs_of(1);
  std::vector<uint64_t> memory =
      std::vector<uint64_t>((sync_test_bytes(Arena::k_capacity, k_ticks, sizeof(Arena::Score)) + 7) / 8);
  SyncTestDef def = {k_ticks, inputs.data(), k_players, k_arena_input_bytes};
  SyncTestReport report = {};

  uint8_t* bytes() { return reinterpret_cast<uint8_t*>(memory.data()); }
  uint32_t size() const { return static_cast<uint32_t>(memory.size() * 8); }
  Status run(TickMaker maker, uint8_t* at, uint32_t count) {
    return sync_test(arena.owned.world, def, maker, at, count, arena.state(), report);
  }
};

DETENT_TEST(sync_test, agrees_where_the_state_alone_decides) {
  SyncTest test;
  Arena straight(k_players);
  for (uint32_t tick = 0; tick < k_ticks; ++tick) {
    const uint8_t* const at = &test.inputs[tick * k_players * k_arena_input_bytes];
    Arena::make(&straight, straight.owned.world, {tick, at, k_players, k_arena_input_bytes, 0, false});
  }
  ASSERT_OK(test.run(test.arena.maker(), test.bytes(), test.size()));
  EXPECT_EQ(test.arena.sum(), straight.sum());
  EXPECT_EQ(test.arena.again, k_ticks);
  EXPECT_GT(test.arena.score.boxes, 0u);
}

/// A game with a counter that is not rolled back, which is a fault.
struct Forgetful {
  Arena& arena;
  uint32_t calls = 0;
  static void make(void* context, World& world, const TickInputs& inputs) {
    Forgetful& self = *static_cast<Forgetful*>(context);
    Arena::make(&self.arena, world, inputs);
    if (++self.calls == k_ticks + 8) ++self.arena.score.jumps[0];
  }
};

DETENT_TEST(sync_test, names_the_first_tick_that_differs) {
  SyncTest test;
  Forgetful forgetful{test.arena};
  EXPECT_EQ(test.run({Forgetful::make, &forgetful}, test.bytes(), test.size()), Status::digest_differs);
  EXPECT_EQ(test.report.tick, 8u);
  EXPECT_NE(test.report.first, test.report.second);
  EXPECT_EQ(get_info(test.arena.owned.world).tick, 8u);
}

DETENT_TEST(sync_test, bad_arguments_are_refused) {
  SyncTest test;
  const TickMaker maker = test.arena.maker();
  const uint64_t before = test.arena.sum();
  const uint32_t least = sync_test_bytes(Arena::k_capacity, k_ticks, sizeof(Arena::Score));
  EXPECT_EQ(test.run({}, test.bytes(), test.size()), Status::bad_argument);
  EXPECT_EQ(test.run(maker, nullptr, test.size()), Status::buffer_too_small);
  EXPECT_EQ(test.run(maker, test.bytes(), least - 1), Status::buffer_too_small);
  EXPECT_EQ(test.run(maker, test.bytes() + 4, least), Status::buffer_misaligned);
  const SyncTestDef good = test.def;
  test.def.ticks = 0;
  EXPECT_EQ(test.run(maker, test.bytes(), test.size()), Status::out_of_range);
  test.def.ticks = UINT32_MAX;
  EXPECT_EQ(test.run(maker, test.bytes(), test.size()), Status::out_of_range);
  test.def = good;
  test.def.inputs = nullptr;
  EXPECT_EQ(test.run(maker, test.bytes(), test.size()), Status::bad_argument);
  test.def = good;
  test.def.players = UINT32_MAX;
  EXPECT_EQ(test.run(maker, test.bytes(), test.size()), Status::out_of_range);
  test.def = good;
  EXPECT_EQ(test.arena.sum(), before);
  const TickMaker idle = {[](void*, World&, const TickInputs&) {}, nullptr};
  EXPECT_EQ(test.run(idle, test.bytes(), test.size()), Status::bad_argument);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
