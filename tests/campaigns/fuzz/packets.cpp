#include "tests/campaigns/fuzz/packets.h"

#include <gtest/gtest.h>

#include "examples/rollback/packet.h"

namespace detent_fuzz {
namespace {

using namespace detent_rollback;

/// What is let in says the same when it is written.
template <class Message>
bool take_message(bool (*read)(const uint8_t*, uint32_t, Message&), uint32_t (*write)(const Message&, uint8_t*),
                  const Bytes& bytes) {
  Message message;
  if (!read(bytes.data(), static_cast<uint32_t>(bytes.size()), message)) return false;
  Bytes written(k_message_bytes_max);
  written.resize(write(message, written.data()));
  EXPECT_EQ(written, bytes);
  return true;
}

bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  const Bytes message(bytes.begin() + 1, bytes.end());
  switch (bytes[0] % 4) {
    case 0:
      return take_message(read_packet, write_packet, message);
    case 1:
      return take_message(read_hello, write_hello, message);
    case 2:
      return take_message(read_welcome, write_welcome, message);
    default:
      return take_message(read_farewell, write_farewell, message);
  }
}

template <class Message>
Bytes seed(uint8_t tag, uint32_t (*write)(const Message&, uint8_t*), const Message& message) {
  Bytes bytes(1 + k_message_bytes_max, tag);
  bytes.resize(1 + write(message, bytes.data() + 1));
  return bytes;
}

std::vector<Bytes> seeds() {
  Packet packet;
  packet.players = 3;
  packet.tick = 17;
  packet.has_checksum = true;
  packet.checksum_tick = 8;
  packet.checksum = 0x12345678;
  packet.run_count = 2;
  packet.runs[0] = {0, 9, 3, {1, 2, 3}};
  packet.runs[1] = {2, 12, 1, {31}};
  return {seed(0, write_packet, packet), seed(1, write_hello, {5, 1, 77}),
          seed(2, write_welcome, {3, 1, 2, 16, 600, 100, 9}), seed(3, write_farewell, {3, 0x123456789abcdef0})};
}

}  // namespace

const Target k_packets_target = {take, seeds};

}  // namespace detent_fuzz
