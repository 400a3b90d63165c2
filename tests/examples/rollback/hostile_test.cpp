#include "tests/common/oracle/effort.h"
#include "tests/examples/rollback/network.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_rollback::Packet;
using detent_rollback::Seeded;
using detent_rollback::Verdict;

constexpr uint32_t k_bytes_max = detent_rollback::k_packet_bytes_max;

/// What must not change where a packet is refused.
struct Fingerprint {
  uint64_t digest, tick, confirmed, next[3];
  bool desync;
  bool operator==(const Fingerprint&) const = default;
};
Fingerprint fingerprint(const pitch::Match& match) {
  const RollbackSession& session = match.session();
  return {digest(match.world()),
          session.tick(),
          session.confirmed_tick(),
          {session.next_input(0), session.next_input(1), session.next_input(2)},
          session.desync().found};
}

/// Three play; the third has become hostile, and what it sends is what `attack` makes of its packets.
class Siege {
 public:
  Siege() : network({.players = 3, .ticks = 600, .window = 24}) {
    while (host().session().tick() < 200) network.pass();
    network.silent[2] = true;
  }
  pitch::Match& host() { return *network.machines[0]; }
  Verdict attack(const uint8_t* bytes, uint32_t count) {
    const Fingerprint before = fingerprint(host());
    const Verdict verdict = host().take(2, bytes, count, network.now);
    if (verdict != Verdict::used) {
      EXPECT_EQ(fingerprint(host()), before);
    }
    return verdict;
  }
  /// A packet as the third would send it now.
  Packet honest_packet() {
    uint8_t bytes[k_bytes_max];
    Packet packet;
    EXPECT_TRUE(detent_rollback::read_packet(bytes, network.machines[2]->write_for(0, bytes), packet));
    return packet;
  }
  Verdict attack(const Packet& packet) {
    uint8_t bytes[k_bytes_max];
    return attack(bytes, detent_rollback::write_packet(packet, bytes));
  }
  /// The two others play on without it, and agree.
  void end() {
    host().leave(2);
    network.play_to_the_end();
    EXPECT_EQ(digest(network.machines[0]->world()), digest(network.machines[1]->world()));
    EXPECT_EQ(network.machines[0]->confirmed_inputs(), network.machines[1]->confirmed_inputs());
    EXPECT_EQ(network.machines[1]->refused(), 0u);
  }
  Network network;
};

DETENT_TEST(rollback_hostile, packets_that_say_what_cannot_be_are_refused) {
  Siege siege;
  const auto refuses = [&](auto change) {
    Packet packet = siege.honest_packet();
    change(packet);
    return siege.attack(packet) == Verdict::refused;
  };
  EXPECT_TRUE(refuses([](Packet& packet) { packet.match = 8; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.player = 1; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.players = 4; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.runs[0].player = 1; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.runs[0].player = 0; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.runs[0].first += 1000; }));
  EXPECT_TRUE(refuses([](Packet& packet) {  // a gap
    packet.runs[0].first += 60;
    packet.runs[0].count = 1;
  }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.runs[0].count = 128; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.tick += 1000; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.wanted[0] += 1000; }));
  EXPECT_TRUE(refuses([](Packet& packet) { packet.checksum_tick = 7; }));
  EXPECT_FALSE(refuses([](Packet&) {}));
  siege.end();
}

DETENT_TEST(rollback_hostile, inputs_beyond_what_the_session_keeps_are_refused) {
  // With a long delay more is known than has been made, and what is kept goes with the ticks that were made.
  pitch::Match client({7, 1, 2, 16, 16, 600});
  Packet packet;
  packet.match = 7;
  packet.players = 2;
  packet.run_count = 1;
  const auto send = [&](uint64_t end) {
    packet.runs[0].first = static_cast<uint32_t>(client.session().next_input(0));
    packet.runs[0].count = static_cast<uint32_t>(end - packet.runs[0].first);
    packet.tick = static_cast<uint32_t>(client.session().tick());
    ++packet.sequence;
    uint8_t bytes[k_bytes_max];
    return client.take(0, bytes, detent_rollback::write_packet(packet, bytes), packet.sequence / 60.0);
  };
  for (uint64_t tick = 0; tick < 100; ++tick) {
    ASSERT_EQ(send(tick + 17), Verdict::used);
    client.frame(0);
  }
  uint64_t refused_from = client.session().next_input(0);
  while (refused_from < 200 && send(refused_from + 1) == Verdict::used) ++refused_from;
  EXPECT_LT(refused_from, 200u);
  const uint64_t before = digest(client.world());
  EXPECT_EQ(send(client.session().next_input(0) + 60), Verdict::refused);
  EXPECT_EQ(digest(client.world()), before);
}

DETENT_TEST(rollback_hostile, random_and_oversized_bytes_are_refused) {
  Siege siege;
  Seeded random(1);
  std::vector<uint8_t> bytes(65536);
  for (uint32_t i = 0; i < 150 + detent_oracle::rounds(250); ++i) {
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
    const uint32_t count = i % 2 == 0 ? static_cast<uint32_t>(random.next() % k_bytes_max)
                                      : static_cast<uint32_t>(random.next() % bytes.size());
    EXPECT_EQ(siege.attack(bytes.data(), count), Verdict::refused);
  }
  EXPECT_TRUE(siege.host().is_hostile(2));
  siege.end();
}

DETENT_TEST(rollback_hostile, mutants_of_good_packets_change_at_most_what_their_sender_does) {
  Siege siege;
  Seeded random(2);
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    uint8_t bytes[k_bytes_max];
    const uint32_t count = siege.network.machines[2]->write_for(0, bytes);
    for (uint64_t changes = 1 + random.next() % 3; changes != 0; --changes) {
      bytes[random.next() % count] ^= static_cast<uint8_t>(1 << random.next() % 8);
    }
    const Fingerprint before = fingerprint(siege.host());
    siege.attack(bytes, count);
    const Fingerprint after = fingerprint(siege.host());
    EXPECT_EQ(after.next[0], before.next[0]);
    EXPECT_EQ(after.next[1], before.next[1]);
    siege.network.pass();
  }
  EXPECT_GT(siege.host().refused(), 100u);
  siege.end();
}

DETENT_TEST(rollback_hostile, packets_that_come_again_do_nothing_and_floods_are_cut_off) {
  Siege siege;
  std::vector<Packet> old;
  for (uint32_t i = 0; i < 100; ++i) old.push_back(siege.honest_packet());
  for (const Packet& packet : old) EXPECT_EQ(siege.attack(packet), Verdict::used);
  const uint64_t repeated = siege.host().figures().repeated;
  for (const Packet& packet : old) EXPECT_EQ(siege.attack(packet), Verdict::repeated);
  EXPECT_EQ(siege.host().figures().repeated, repeated + old.size());
  EXPECT_EQ(siege.host().refused(), 0u);

  uint32_t sent = 0;
  for (; sent < 10000 && !siege.host().is_hostile(2); ++sent) siege.attack(old[sent % old.size()]);
  EXPECT_GT(sent, 3000u);
  EXPECT_LT(sent, 3800u);  // what is left of the burst, and who goes on after it
  siege.end();
}

DETENT_TEST(rollback_hostile, who_takes_back_an_input_is_not_heard) {
  Siege siege;
  Packet packet = siege.honest_packet();
  ASSERT_EQ(siege.attack(packet), Verdict::used);
  const std::vector<uint8_t> confirmed = siege.host().confirmed_inputs();
  Packet other = siege.honest_packet();
  for (uint8_t& input : other.runs[0].inputs) input ^= 1;
  siege.attack(other);
  for (uint32_t i = 0; i < packet.runs[0].count; ++i) {
    uint8_t input = 0;
    EXPECT_OK(siege.host().session().get_input(2, packet.runs[0].first + i, &input));
    EXPECT_EQ(input, packet.runs[0].inputs[i]);
  }
  siege.end();
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
