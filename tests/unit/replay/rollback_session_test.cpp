#include <detent/rollback.h>

#include "tests/unit/replay/arena.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A session in which this machine is player 0.
struct Table {
  Arena arena;
  RollbackDef def;
  std::vector<uint64_t> memory;
  RollbackSession session;

  explicit Table(uint32_t players, uint32_t window = 4, uint32_t delay = 0) : arena(players) {
    def.players = players;
    def.input_bytes = k_arena_input_bytes;
    def.window = window;
    def.delay = delay;
    def.game_bytes = sizeof(Arena::Score);
    memory.assign(rollback_bytes(Arena::k_capacity, def) / 8, ~0ull);
    EXPECT_OK(begin(def, bytes(), size(), arena.state()));
  }
  uint8_t* bytes() { return reinterpret_cast<uint8_t*>(memory.data()); }
  uint32_t size() const { return static_cast<uint32_t>(memory.size() * 8); }
  World& world() { return arena.owned.world; }
  Status begin(const RollbackDef& with, uint8_t* at, uint32_t count, GameState game) {
    return session.begin(world(), with, arena.maker(), at, count, game);
  }
  Status give(uint8_t what) {
    const uint8_t input[k_arena_input_bytes] = {what, 0};
    uint64_t tick = 0;
    return session.add_local_input(0, input, tick);
  }
  Status hear(uint32_t player, uint64_t tick, uint8_t what) {
    const uint8_t input[k_arena_input_bytes] = {what, 0};
    return session.add_input(player, tick, input);
  }
  Status advance() { return session.advance(world(), report); }
  RollbackReport report;
};

DETENT_TEST(rollback_session, waits_at_the_end_of_its_window_and_keeps_what_it_has_to_correct) {
  Table table(3);
  for (uint32_t tick = 0; tick < 4; ++tick) {
    ASSERT_OK(table.give(5));
    ASSERT_OK(table.advance());
    EXPECT_EQ(table.report.tick, tick + 1);
    EXPECT_EQ(table.session.confirmed_tick(), 0u);
  }
  ASSERT_OK(table.give(5));
  const uint64_t before = table.arena.sum();
  EXPECT_EQ(table.advance(), Status::waiting);
  for (uint64_t tick = 0; tick < 5; ++tick) EXPECT_OK(table.hear(1, tick, tick < 2 ? 3 : 5));
  EXPECT_EQ(table.advance(), Status::waiting) << "player 2 lacks";
  EXPECT_EQ(table.arena.sum(), before);
  EXPECT_OK(table.hear(2, 1, 12));  // out of order
  EXPECT_EQ(table.advance(), Status::waiting);
  EXPECT_OK(table.hear(2, 0, 0));  // as predicted
  ASSERT_OK(table.advance());
  EXPECT_EQ(table.report.went_back, 0u);
  EXPECT_EQ(table.report.ticks_again, 4u);
  EXPECT_EQ(table.report.tick, 5u);
  EXPECT_EQ(table.session.confirmed_tick(), 2u);
  for (uint64_t tick = 2; tick < 5; ++tick) EXPECT_OK(table.hear(2, tick, 12));
  ASSERT_OK(table.session.correct(table.world(), table.report));
  EXPECT_EQ(table.report.ticks_again, 0u) << "the last input was repeated, and it was the one";
  EXPECT_EQ(table.session.confirmed_tick(), 5u);
  Arena straight(3);
  for (uint64_t tick = 0; tick < 5; ++tick) {
    const uint8_t two = tick == 0 ? 0 : 12, one = tick < 2 ? 3 : 5;
    const uint8_t inputs[3 * k_arena_input_bytes] = {5, 0, one, 0, two, 0};
    Arena::make(&straight, straight.owned.world, {tick, inputs, 3, k_arena_input_bytes, 0, false});
  }
  EXPECT_EQ(table.arena.sum(), straight.sum());
}

DETENT_TEST(rollback_session, an_input_counts_after_its_delay_and_nothing_is_done_before) {
  Table table(2, 4, 3);
  EXPECT_EQ(table.session.next_input(0), 3u);
  uint8_t input[k_arena_input_bytes] = {9, 9};
  EXPECT_OK(table.session.get_input(0, 2, input));
  EXPECT_EQ(input[0], 0);
  EXPECT_EQ(table.session.get_input(0, 3, input), Status::out_of_range);
  ASSERT_OK(table.give(16));
  EXPECT_OK(table.session.get_input(0, 3, input));
  EXPECT_EQ(input[0], 16);
  EXPECT_EQ(table.give(16), Status::bad_argument) << "given already";
  for (uint32_t tick = 0; tick < 4; ++tick) {
    EXPECT_EQ(table.arena.score.jumps[0], 0u);
    ASSERT_OK(table.advance());
    if (tick == 3) break;
    ASSERT_OK(table.give(0));
  }
  EXPECT_EQ(table.arena.score.jumps[0], 1u);
}

DETENT_TEST(rollback_session, inputs_are_kept_as_long_as_another_may_ask_and_none_are_taken_beyond) {
  Table table(2);
  const uint64_t room = 6 * 4 + 2;
  EXPECT_OK(table.hear(1, room - 1, 1));
  EXPECT_EQ(table.hear(1, room, 1), Status::out_of_range);
  EXPECT_EQ(table.hear(1, UINT64_MAX, 1), Status::out_of_range);
  for (uint64_t tick = 0; tick < 100; ++tick) {
    ASSERT_OK(table.give(static_cast<uint8_t>(tick % 4)));
    ASSERT_OK(table.hear(1, tick, static_cast<uint8_t>(tick % 4)));
    ASSERT_OK(table.hear(1, tick, 31)) << "what is known stays";
    ASSERT_OK(table.advance());
    EXPECT_EQ(table.session.confirmed_tick(), tick + 1);
    for (uint64_t back = 0; back <= 8 && back <= tick; ++back) {
      uint8_t input[k_arena_input_bytes];
      ASSERT_OK(table.session.get_input(0, tick - back, input));
      ASSERT_EQ(input[0], (tick - back) % 4);
      if (tick - back == room - 1) continue;
      ASSERT_OK(table.session.get_input(1, tick - back, input));
      ASSERT_EQ(input[0], (tick - back) % 4);
    }
  }
  EXPECT_EQ(table.arena.predicted, 0u);
  EXPECT_EQ(table.arena.again, 0u);
  const uint64_t oldest = 100 - 2 * 4;
  uint8_t input[k_arena_input_bytes];
  EXPECT_EQ(table.hear(1, oldest + room, 1), Status::out_of_range);
  EXPECT_OK(table.hear(1, oldest + room - 1, 1));
  EXPECT_OK(table.session.get_input(1, oldest, input));
  // Checksums that share a place in the ring are refused in the same way.
  EXPECT_EQ(table.session.add_checksum(1, {100 - room - 1, 0}), Status::out_of_range) << "no longer kept here";
  EXPECT_OK(table.session.add_checksum(1, {84 + room, 0}));
  EXPECT_EQ(table.session.add_checksum(1, {84, 0}), Status::out_of_range) << "a later one is there";
}

DETENT_TEST(rollback_session, checksums_are_of_confirmed_ticks_at_their_interval) {
  Table table(2, 8);
  table.def.checksum_interval = 3;
  ASSERT_OK(table.begin(table.def, table.bytes(), table.size(), table.arena.state()));
  TickChecksum found[8];
  for (uint64_t tick = 0; tick < 8; ++tick) {
    ASSERT_OK(table.give(5));
    ASSERT_OK(table.advance());
  }
  ASSERT_EQ(table.session.checksums(found, 8), 1u) << "the start is confirmed";
  EXPECT_EQ(found[0].tick, 0u);
  for (uint64_t tick = 0; tick < 7; ++tick) ASSERT_OK(table.hear(1, tick, 1));
  ASSERT_EQ(table.session.checksums(found, 8), 1u) << "states that were predicted wrong have none";
  ASSERT_OK(table.session.correct(table.world(), table.report));
  ASSERT_EQ(table.session.checksums(found, 8), 3u);
  EXPECT_EQ(found[0].tick, 6u);
  EXPECT_EQ(found[1].tick, 3u);
  EXPECT_EQ(table.session.checksums(found, 2), 2u);
  EXPECT_EQ(table.session.checksums(nullptr, 2), 0u);
  EXPECT_EQ(table.session.add_checksum(1, {4, 0}), Status::bad_argument);
  EXPECT_EQ(table.session.add_checksum(0, found[0]), Status::bad_argument);
  EXPECT_EQ(table.session.add_checksum(2, found[0]), Status::bad_argument);
  EXPECT_EQ(table.session.add_checksum(1, {3 * 100, 0}), Status::out_of_range);
  EXPECT_EQ(table.session.add_checksum(1, {UINT64_MAX, 0}), Status::out_of_range);
  EXPECT_OK(table.session.add_checksum(1, found[0]));
  EXPECT_OK(table.session.add_checksum(1, {9, 1})) << "not made yet";
  EXPECT_FALSE(table.session.desync().found);
  EXPECT_EQ(table.session.add_checksum(1, {3, found[1].checksum + 1}), Status::digest_differs);
  EXPECT_EQ(table.session.desync().tick, 3u);
  EXPECT_EQ(table.session.desync().own, found[1].checksum);
}

DETENT_TEST(rollback_session, a_machine_that_only_watches_needs_no_input_of_its_own) {
  Table table(2);
  table.def.local = 0;
  ASSERT_OK(table.begin(table.def, table.bytes(), table.size(), table.arena.state()));
  for (uint64_t tick = 0; tick < 20; ++tick) {
    ASSERT_OK(table.hear(0, tick, 1));
    ASSERT_OK(table.hear(1, tick, 4));
    ASSERT_OK(table.advance());
  }
  EXPECT_EQ(table.session.confirmed_tick(), 20u);
}

DETENT_TEST(rollback_session, a_machine_that_watches_from_afar_loses_no_input) {
  Table table(2);
  table.def.local = 0;
  ASSERT_OK(table.begin(table.def, table.bytes(), table.size(), table.arena.state()));
  Arena straight(2);
  const auto what = [](uint32_t player, uint64_t tick) { return static_cast<uint8_t>((7 * tick + player) % 32); };
  for (uint64_t tick = 0; tick < 60; ++tick) {
    for (uint32_t player = 0; player < 2; ++player) {
      uint64_t next = table.session.next_input(player);
      while (table.hear(player, next, what(player, next)) == Status::ok) ++next;
      EXPECT_EQ(next, (tick < 8 ? 0 : tick - 8) + 6 * 4 + 2) << "what it has no room for comes again";
    }
    ASSERT_OK(table.advance());
    const uint8_t inputs[2 * k_arena_input_bytes] = {what(0, tick), 0, what(1, tick), 0};
    Arena::make(&straight, straight.owned.world, {tick, inputs, 2, k_arena_input_bytes, 0, false});
    ASSERT_EQ(table.arena.sum(), straight.sum()) << tick;
  }
}

DETENT_TEST(rollback_session, bad_arguments_are_refused) {
  Table table(2);
  RollbackSession unbegun;
  RollbackReport report;
  const uint8_t input[k_arena_input_bytes] = {};
  uint8_t read[k_arena_input_bytes];
  uint64_t tick = 0;
  EXPECT_EQ(unbegun.add_local_input(0, input, tick), Status::bad_argument);
  EXPECT_EQ(unbegun.add_input(1, 0, input), Status::bad_argument);
  EXPECT_EQ(unbegun.get_input(0, 0, read), Status::bad_argument);
  EXPECT_EQ(unbegun.advance(table.world(), report), Status::bad_argument);
  EXPECT_EQ(unbegun.correct(table.world(), report), Status::bad_argument);
  EXPECT_EQ(unbegun.add_checksum(1, {}), Status::bad_argument);
  EXPECT_EQ(unbegun.confirmed_tick(), 0u);
  TickChecksum checksum;
  EXPECT_EQ(unbegun.checksums(&checksum, 1), 0u);

  EXPECT_EQ(table.session.add_local_input(1, input, tick), Status::bad_argument);
  EXPECT_EQ(table.session.add_local_input(2, input, tick), Status::bad_argument);
  EXPECT_EQ(table.session.add_local_input(0, nullptr, tick), Status::bad_argument);
  EXPECT_EQ(table.session.add_input(0, 0, input), Status::bad_argument);
  EXPECT_EQ(table.session.add_input(2, 0, input), Status::bad_argument);
  EXPECT_EQ(table.session.add_input(1, 0, nullptr), Status::bad_argument);
  EXPECT_EQ(table.session.get_input(2, 0, read), Status::bad_argument);
  EXPECT_EQ(table.session.get_input(1, 0, nullptr), Status::bad_argument);
  EXPECT_EQ(table.session.get_input(1, UINT64_MAX, read), Status::out_of_range);
  EXPECT_EQ(table.session.next_input(2), 0u);
  EXPECT_EQ(table.advance(), Status::bad_argument) << "no local input";
  ASSERT_OK(table.give(5));
  OwnedWorld other(OwnedWorld::def_of({3, 3, 0}));
  EXPECT_EQ(table.session.advance(other.world, report), Status::capacity_differs);
  step(table.world());
  EXPECT_EQ(table.advance(), Status::bad_argument) << "stepped by another";
  EXPECT_EQ(table.session.correct(table.world(), report), Status::bad_argument);
}

DETENT_TEST(rollback_session, begins_with_what_is_in_range_alone) {
  Table table(2);
  const auto refused = [&](RollbackDef def, Status expected) {
    EXPECT_EQ(table.begin(def, table.bytes(), table.size(), table.arena.state()), expected);
    const bool counted = rollback_bytes(Arena::k_capacity, def) != 0;
    EXPECT_EQ(counted, expected != Status::out_of_range);
  };
  for (uint32_t i = 0; i < 9; ++i) {
    RollbackDef def = table.def;
    if (i == 0) def.players = 0;
    if (i == 1) def.players = 17;
    if (i == 2) def.window = 0;
    if (i == 3) def.window = 65;
    if (i == 4) def.delay = 5;
    if (i == 5) def.input_bytes = 0;
    if (i == 6) def.input_bytes = 1025;
    if (i == 7) def.game_bytes = 1u << 31;
    if (i == 8) def.window = UINT32_MAX;
    refused(def, Status::out_of_range);
  }
  RollbackDef def = table.def;
  def.local = 4;
  refused(def, Status::bad_argument);
  def = table.def;
  def.game_bytes = 1;
  refused(def, Status::bad_argument);
  EXPECT_EQ(rollback_bytes({0, 0, 0}, table.def), 0u);
  uint8_t* const at = table.bytes();
  const GameState game = table.arena.state();
  EXPECT_EQ(table.begin(table.def, nullptr, table.size(), game), Status::buffer_too_small);
  EXPECT_EQ(table.begin(table.def, at, table.size() - 1, game), Status::buffer_too_small);
  EXPECT_EQ(table.begin(table.def, at + 4, table.size(), game), Status::buffer_misaligned);
  EXPECT_EQ(table.begin(table.def, at, table.size(), {nullptr, game.count}), Status::bad_argument);
  EXPECT_EQ(table.session.begin(table.world(), table.def, {}, at, table.size(), game), Status::bad_argument);
  EXPECT_OK(table.begin(table.def, at, table.size(), game));
}

DETENT_TEST(rollback_session, a_maker_that_does_not_step_once_ends_the_session) {
  Table table(2);
  const TickMaker idle = {[](void*, World&, const TickInputs&) {}, nullptr};
  ASSERT_OK(table.session.begin(table.world(), table.def, idle, table.bytes(), table.size(), table.arena.state()));
  ASSERT_OK(table.give(5));
  EXPECT_EQ(table.advance(), Status::bad_argument);
  EXPECT_EQ(table.give(5), Status::bad_argument);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
