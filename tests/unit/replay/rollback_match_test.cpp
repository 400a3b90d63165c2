#include "tests/common/oracle/effort.h"
#include "tests/unit/replay/arena.h"
#include "tests/unit/replay/link.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using Random = detent_queries::Random;

constexpr uint32_t k_checksums_sent = 40;

/// A player's machine.
struct Machine {
  Arena arena;
  std::vector<uint64_t> memory;
  RollbackSession session;
  uint32_t player;
  Random random;
  uint8_t held[k_arena_input_bytes] = {5, 0};
  Bytes given;                   ///< all local inputs
  std::vector<uint64_t> target;  ///< by each other machine
  uint32_t waits = 0, desyncs_told = 0;

  Machine(uint32_t players, uint32_t own, uint64_t seed)
      : arena(players), player(own), random(seed * 16 + own), target(players) {
    RollbackDef def;
    def.players = players;
    def.local = 1u << own;
    def.input_bytes = k_arena_input_bytes;
    def.delay = own % 3;
    def.game_bytes = sizeof(Arena::Score);
    def.sparse = own % 2 == 1;
    memory.resize(rollback_bytes(Arena::k_capacity, def) / 8);
    EXPECT_OK(
        session.begin(arena.owned.world, def, arena.maker(), bytes_of(memory), byte_count(memory), arena.state()));
    given.resize(def.delay * k_arena_input_bytes);
  }
  static uint8_t* bytes_of(std::vector<uint64_t>& words) { return reinterpret_cast<uint8_t*>(words.data()); }
  static uint32_t byte_count(const std::vector<uint64_t>& words) { return static_cast<uint32_t>(words.size() * 8); }

  void take(const Packet& packet) {
    if (packet.target > target[packet.player]) target[packet.player] = packet.target;
    const size_t count = packet.inputs.size() / k_arena_input_bytes;
    for (size_t i = 0; i < count; ++i) {
      const Status status = session.add_input(packet.player, packet.first + i, &packet.inputs[i * k_arena_input_bytes]);
      EXPECT_TRUE(status == Status::ok || status == Status::out_of_range) << status_text(status);
    }
    for (const TickChecksum& checksum : packet.checksums) {
      const Status status = session.add_checksum(packet.player, checksum);
      desyncs_told += status == Status::digest_differs ? 1u : 0u;
      EXPECT_TRUE(status == Status::ok || status == Status::out_of_range || session.desync().found);
    }
  }

  Packet packet_for(uint32_t other) {
    Packet packet;
    packet.player = player;
    packet.target = session.next_input(other);
    packet.first = target[other];
    for (uint64_t tick = packet.first; tick < session.next_input(player); ++tick) {
      uint8_t input[k_arena_input_bytes];
      EXPECT_OK(session.get_input(player, tick, input));
      packet.inputs.insert(packet.inputs.end(), input, input + k_arena_input_bytes);
    }
    packet.checksums.resize(k_checksums_sent);
    packet.checksums.resize(session.checksums(packet.checksums.data(), k_checksums_sent));
    return packet;
  }

  /// Holds each input for some ticks, as players do.
  void play_one() {
    if (session.next_input(player) <= session.tick() + player % 3) {
      if (random.chance(0.2)) held[0] = static_cast<uint8_t>(random.below(32));
      held[1] = random.chance(0.03) ? static_cast<uint8_t>(1 + random.below(2)) : uint8_t{0};
      uint64_t tick = 0;
      EXPECT_OK(session.add_local_input(player, held, tick));
      EXPECT_EQ(tick, given.size() / k_arena_input_bytes);
      given.insert(given.end(), held, held + k_arena_input_bytes);
    }
    RollbackReport report;
    const Status status = session.advance(arena.owned.world, report);
    waits += status == Status::waiting ? 1u : 0u;
    EXPECT_TRUE(status == Status::waiting || (status == Status::ok && report.ticks_again <= 8)) << status_text(status);
  }
};

class Match {
 public:
  Match(uint32_t players, uint64_t seed, double loss) : random_(seed) {
    for (uint32_t i = 0; i < players; ++i) machines.push_back(std::make_unique<Machine>(players, i, seed));
    for (uint32_t i = 0; i < players * players; ++i) links_.emplace_back(seed * 64 + i, loss, 6);
  }

  /// Plays until all machines have made this number of ticks and know all inputs of them.
  void play(uint64_t ticks) {
    for (uint64_t round = 0; round < 20 * ticks + 1000; ++round) {
      bool done = true;
      for (const auto& machine : machines) {
        pass(*machine, round, ticks);
        done = done && machine->session.tick() == ticks && machine->session.confirmed_tick() == ticks;
        if (testing::Test::HasFailure()) return;
      }
      if (done) return;
    }
    ADD_FAILURE() << "the match stands still";
  }

  std::vector<std::unique_ptr<Machine>> machines;

 private:
  uint32_t count() const { return static_cast<uint32_t>(machines.size()); }
  Link& link(uint32_t from, uint32_t to) { return links_[from * count() + to]; }

  /// The work of a machine in one frame.
  void pass(Machine& machine, uint64_t round, uint64_t ticks) {
    for (uint32_t other = 0; other < count(); ++other) {
      for (const Packet& packet : link(other, machine.player).receive(round)) machine.take(packet);
    }
    const bool stalls = random_.chance(0.02);
    if (machine.session.tick() < ticks) {
      if (!stalls) machine.play_one();
    } else {
      RollbackReport report;
      EXPECT_OK(machine.session.correct(machine.arena.owned.world, report));
    }
    for (uint32_t other = 0; other < count(); ++other) {
      if (other != machine.player) link(machine.player, other).send(machine.packet_for(other), round);
    }
  }

  Random random_;
  std::vector<Link> links_;
};

/// The digest of a world that makes all ticks with the inputs of all players, without rollback.
uint64_t straight(const Match& match, uint64_t ticks) {
  const uint32_t players = static_cast<uint32_t>(match.machines.size());
  Arena arena(players);
  Bytes inputs(players * k_arena_input_bytes);
  for (uint64_t tick = 0; tick < ticks; ++tick) {
    for (uint32_t player = 0; player < players; ++player)
      std::copy_n(&match.machines[player]->given[static_cast<size_t>(tick) * k_arena_input_bytes], k_arena_input_bytes,
                  &inputs[player * k_arena_input_bytes]);
    Arena::make(&arena, arena.owned.world, {tick, inputs.data(), players, k_arena_input_bytes, 0, false});
  }
  return arena.sum();
}

void play_and_compare(uint32_t players, uint64_t seed, uint64_t ticks) {
  Match match(players, seed, 0.3);
  match.play(ticks);
  const uint64_t expected = straight(match, ticks);
  for (const auto& machine : match.machines) {
    EXPECT_EQ(machine->arena.sum(), expected) << machine->player;
    EXPECT_FALSE(machine->session.desync().found) << machine->session.desync().tick;
    EXPECT_GT(machine->arena.predicted, ticks / 2);
    EXPECT_GT(machine->arena.again, ticks / 4);
    EXPECT_GT(machine->waits, 0u);
  }
}

DETENT_TEST(rollback_match, of_two_over_a_bad_link_ends_as_if_all_inputs_had_been_known) {
  play_and_compare(2, 1, detent_oracle::rounds(10000));
}

DETENT_TEST(rollback_match, of_four_over_bad_links_ends_as_if_all_inputs_had_been_known) {
  play_and_compare(4, 2, detent_oracle::rounds(10000));
}

DETENT_TEST(rollback_match, a_state_that_differs_is_told_to_everybody_by_its_tick) {
  for (uint32_t players = 2; players <= 4; players += 2) {
    Match match(players, 3, 0.15);
    match.machines[1]->arena.meddled_tick = 300;
    match.play(400);
    for (const auto& machine : match.machines) {
      const Desync& desync = machine->session.desync();
      EXPECT_TRUE(desync.found);
      EXPECT_EQ(desync.tick, 301u);
      EXPECT_EQ(desync.player, machine->player == 1 ? 0u : 1u);
      EXPECT_NE(desync.own, desync.theirs);
      EXPECT_GT(machine->desyncs_told, 0u);
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
