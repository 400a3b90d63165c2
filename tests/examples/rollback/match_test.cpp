#include "tests/common/oracle/effort.h"
#include "tests/examples/rollback/network.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

void play_and_compare(const NetworkDef& def, uint64_t waits_max) {
  Network network(def);
  network.play_to_the_end();
  const uint64_t expected = network.expected_digest();
  for (const auto& machine : network.machines) {
    EXPECT_EQ(digest(machine->world()), expected) << machine->def().player;
    EXPECT_FALSE(machine->session().desync().found);
    EXPECT_EQ(pitch::replay_inputs(machine->confirmed_inputs(), def.players, {}), expected);
    EXPECT_EQ(machine->refused(), 0u);
    if (def.ticks >= 1000) {
      EXPECT_GT(machine->figures().repeated, def.ticks / 500u);
    }
    EXPECT_GT(machine->figures().ticks_again, def.ticks / 8);
    EXPECT_LE(machine->figures().longest_rollback, def.window);
    EXPECT_LE(machine->figures().waits, waits_max);
  }
}

DETENT_TEST(rollback_example, two_end_with_the_digest_of_all_inputs_known) {
  const uint32_t ticks = detent_oracle::rounds(4000);
  play_and_compare({.players = 2, .ticks = ticks}, ticks / 200);
}

DETENT_TEST(rollback_example, four_end_with_the_digest_of_all_inputs_known) {
  const uint32_t ticks = detent_oracle::rounds(2000);
  play_and_compare({.players = 4, .ticks = ticks, .window = 24}, ticks / 100);
}

DETENT_TEST(rollback_example, a_window_that_is_too_small_makes_them_wait_and_nothing_else) {
  Network network({.players = 2, .ticks = 400, .window = 3});
  network.play_to_the_end();
  EXPECT_GT(network.machines[0]->figures().waits, 50u);
  EXPECT_EQ(digest(network.machines[0]->world()), network.expected_digest());
}

DETENT_TEST(rollback_example, who_leaves_does_nothing_from_there_on_and_the_others_agree) {
  Network network({.players = 3, .ticks = 600, .window = 24});
  while (network.machines[0]->session().tick() < 300) network.pass();
  network.silent[2] = true;
  network.machines[0]->leave(2);
  network.play_to_the_end();
  EXPECT_EQ(digest(network.machines[0]->world()), digest(network.machines[1]->world()));
  const std::vector<uint8_t>& inputs = network.machines[0]->confirmed_inputs();
  EXPECT_EQ(inputs, network.machines[1]->confirmed_inputs());
  uint32_t last = 0;
  for (uint32_t tick = 0; tick < 600; ++tick) {
    const uint8_t input = inputs[tick * 3 + 2];
    EXPECT_TRUE(input == 0 || input == network.input(2, tick)) << tick;
    if (input != 0) last = tick;
  }
  EXPECT_GT(last, 250u);
  EXPECT_LT(last, 310u);
  EXPECT_EQ(network.machines[0]->refused(), 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
