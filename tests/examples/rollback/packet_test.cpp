#include "examples/rollback/packet.h"

#include <string.h>

#include "examples/rollback/seeded.h"
#include "tests/common/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_rollback;

Packet some_packet() {
  Packet packet;
  packet.match = 0x01020304;
  packet.sequence = 77;
  packet.player = 0;
  packet.tick = 1000;
  packet.ahead = -3;
  packet.has_checksum = true;
  packet.checksum_tick = 990;
  packet.checksum = 0xfedcba98;
  packet.players = 3;
  for (uint32_t i = 0; i < 3; ++i) packet.wanted[i] = 1000 + i;
  packet.run_count = 2;
  packet.runs[0] = {0, 998, 4, {1, 2, 31, 0}};
  packet.runs[1] = {2, 1001, 1, {16}};
  return packet;
}

DETENT_TEST(rollback_packet, is_the_same_bytes_everywhere) {
  uint8_t bytes[k_packet_bytes_max];
  const uint32_t count = write_packet(some_packet(), bytes);
  const uint8_t expected[] = {
      'd',  't',  1,    'p',  4,    3,    2,    1,                     // what it is, and of which match
      77,   0,    0,    0,    0xe8, 3,    0,    0,                     // sequence, tick
      0xde, 3,    0,    0,    0x98, 0xba, 0xdc, 0xfe, 1,               // checksum
      0,    0xfd, 3,                                                   // player, ahead, players
      0xe8, 3,    0,    0,    0xe9, 3,    0,    0,    0xea, 3,  0, 0,  // wanted
      2,    0,    4,    0xe6, 3,    0,    0,    1,    2,    31, 0,     // runs
      2,    1,    0xe9, 3,    0,    0,    16,
  };
  ASSERT_EQ(count, sizeof expected);
  EXPECT_EQ(memcmp(bytes, expected, count), 0);
}

DETENT_TEST(rollback_packet, is_read_as_it_was_written) {
  uint8_t bytes[k_packet_bytes_max], again[k_packet_bytes_max];
  Packet full = some_packet();
  full.players = full.run_count = k_players_max;
  for (uint32_t i = 0; i < k_players_max; ++i) {
    full.runs[i].player = i;
    full.runs[i].count = k_run_inputs_max;
  }
  const Packet packets[] = {some_packet(), full};
  for (const Packet& packet : packets) {
    const uint32_t count = write_packet(packet, bytes);
    ASSERT_LE(count, k_packet_bytes_max);
    Packet read;
    ASSERT_TRUE(read_packet(bytes, count, read));
    EXPECT_EQ(read.ahead, packet.ahead);
    ASSERT_EQ(write_packet(read, again), count);
    EXPECT_EQ(memcmp(bytes, again, count), 0);
  }
  EXPECT_EQ(write_packet(full, bytes), k_packet_bytes_max);
}

DETENT_TEST(rollback_packet, of_any_other_length_is_refused) {
  uint8_t bytes[2 * k_packet_bytes_max] = {};
  const uint32_t count = write_packet(some_packet(), bytes);
  Packet read;
  for (uint32_t length = 0; length < sizeof bytes; ++length) {
    EXPECT_EQ(read_packet(bytes, length, read), length == count) << length;
  }
}

/// All that is read is as it must be, and says again what was read: no byte is passed over. Returns how many are
/// refused.
uint32_t change_each_byte(const Packet& packet) {
  uint8_t bytes[k_packet_bytes_max], again[k_packet_bytes_max];
  const uint32_t count = write_packet(packet, bytes);
  uint32_t refused = 0;
  for (uint32_t at = 0; at < count; ++at) {
    const uint8_t before = bytes[at];
    for (uint32_t change = 1; change < 256; ++change) {
      bytes[at] = static_cast<uint8_t>(before ^ change);
      Packet read;
      if (!read_packet(bytes, count, read)) {
        ++refused;
        continue;
      }
      EXPECT_EQ(write_packet(read, again), count) << at;
      EXPECT_EQ(memcmp(bytes, again, count), 0) << at;
    }
    bytes[at] = before;
  }
  return refused;
}

DETENT_TEST(rollback_packet, with_any_byte_changed_is_refused_or_another_packet) {
  Packet packet = some_packet();
  EXPECT_GT(change_each_byte(packet), 10 * 255u);  // tag, players, runs, inputs
  packet.has_checksum = false;
  packet.checksum_tick = packet.checksum = 0;
  EXPECT_GT(change_each_byte(packet), 10 * 255u);
}

DETENT_TEST(rollback_packet, with_a_number_that_cannot_be_is_refused) {
  const auto is_refused = [](void (*change)(Packet&)) {
    Packet packet = some_packet(), read;
    change(packet);
    uint8_t bytes[2 * k_packet_bytes_max];
    return !read_packet(bytes, write_packet(packet, bytes), read);
  };
  EXPECT_FALSE(is_refused([](Packet&) {}));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.players = 1; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.player = 3; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.tick = k_ticks_max + 1; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.checksum_tick = packet.tick + 1; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.has_checksum = false; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.wanted[1] = ~0u; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.runs[0].player = 2; }));  // twice
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.runs[1].player = 3; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.runs[1].first = ~0u; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.runs[0].inputs[1] = k_inputs; }));
  EXPECT_TRUE(is_refused([](Packet& packet) { packet.runs[0].count = 0; }));
}

DETENT_TEST(rollback_packet, hello_welcome_and_farewell_are_read_as_they_were_written) {
  uint8_t bytes[k_message_bytes_max];
  Hello hello;
  ASSERT_TRUE(read_hello(bytes, write_hello({1, 2, 3}, bytes), hello));
  EXPECT_EQ(hello.simulation * 100 + hello.config * 10 + hello.key, 123u);
  Welcome welcome;
  uint32_t count = write_welcome({9, 2, 3, 16, 600, 800, 0x123456789abcdefu}, bytes);
  ASSERT_TRUE(read_welcome(bytes, count, welcome));
  EXPECT_EQ(welcome.match, 9u);
  EXPECT_EQ(welcome.player, 2u);
  EXPECT_EQ(welcome.ticks, 600u);
  EXPECT_EQ(welcome.seed, 0x123456789abcdefu);
  EXPECT_FALSE(read_welcome(bytes, count - 1, welcome));
  EXPECT_FALSE(read_welcome(bytes, write_welcome({9, 3, 3, 16, 600, 800, 1}, bytes), welcome));
  EXPECT_FALSE(read_welcome(bytes, write_welcome({9, 0, 3, 16, 600, 800, 1}, bytes), welcome));
  EXPECT_FALSE(read_welcome(bytes, write_welcome({9, 1, 3, k_window_max + 1, 600, 800, 1}, bytes), welcome));
  EXPECT_FALSE(read_welcome(bytes, write_welcome({9, 1, 3, 16, 0, 800, 1}, bytes), welcome));
  EXPECT_FALSE(read_welcome(bytes, write_welcome({9, 1, 3, 16, 600, 0, 1}, bytes), welcome));
  Farewell farewell;
  ASSERT_TRUE(read_farewell(bytes, write_farewell({9, 0x123456789abcdefu}, bytes), farewell));
  EXPECT_EQ(farewell.digest, 0x123456789abcdefu);
  EXPECT_FALSE(read_hello(bytes, 16, hello));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
