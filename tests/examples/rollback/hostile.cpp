// hostile PORT SECONDS [--player]: attacks who hosts a match of examples/rollback at this port of this machine.
// As somebody from outside: garbage by UDP of all sizes, and connections that say all but a valid hello, or one too
// late. As a player: joins with a valid hello, then sends malformed, oversized, impossible, old and too many packets.
// Its exit code is 0 if it was thrown out.
#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include <vector>

#include "examples/rollback/lobby.h"

namespace {

using namespace detent_rollback;

constexpr uint32_t k_datagram_max = 65507;

/// Datagrams that ENet was never asked for. Some begin as its own do.
class Garbage {
 public:
  explicit Garbage(uint16_t port) : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
    there_.sin_family = AF_INET;
    there_.sin_port = htons(port);
    there_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  ~Garbage() { close(socket_); }
  Garbage(const Garbage&) = delete;
  Garbage& operator=(const Garbage&) = delete;

  void send(Seeded& random) {
    const uint64_t shape = random.next();
    const size_t count = shape % 8 == 0 ? k_datagram_max - shape / 8 % 4000 : shape / 8 % 1500;
    std::vector<uint8_t> bytes(count + 8);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
    if (shape % 3 == 0) memcpy(bytes.data(), "\x0f\xff\0\0", 4);  // a peer that has not joined
    if (shape % 3 == 1) memcpy(bytes.data(), "\0\1\0\0", 4);      // one that may have
    sent_ += sendto(socket_, bytes.data(), count, 0, reinterpret_cast<const sockaddr*>(&there_), sizeof there_) > 0;
  }
  uint64_t sent() const { return sent_; }

 private:
  int socket_;
  sockaddr_in there_ = {};
  uint64_t sent_ = 0;
};

std::vector<uint8_t> random_message(Seeded& random) {
  std::vector<uint8_t> bytes(k_message_bytes_max + 3000);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next());
  uint32_t count = static_cast<uint32_t>(random.next() % bytes.size());
  if (random.next() % 2 == 0) count = write_hello({detent::k_simulation_version, 0, 999999}, bytes.data());
  bytes.resize(count);
  return bytes;
}

int attack_from_outside(uint16_t port, double seconds) {
  Garbage garbage(port);
  Seeded random(1);
  uint64_t messages = 0, joined = 0;
  const uint32_t start = enet_time_get();
  while (enet_time_get() - start < seconds * 1000) {
    Transport transport;
    if (!transport.connect("127.0.0.1", port)) return 2;
    const uint32_t until = enet_time_get() + 100;
    while (static_cast<int32_t>(enet_time_get() - until) < 0) {
      garbage.send(random);
      const Transport::Event event = transport.next(1);
      joined += event.kind == Transport::Kind::joined ? 1 : 0;
      if (event.kind == Transport::Kind::left) break;
      if (event.kind != Transport::Kind::joined) continue;
      for (uint32_t i = 0; i < 20; ++i, ++messages) {
        const std::vector<uint8_t> bytes = random_message(random);
        transport.send(0, bytes.data(), static_cast<uint32_t>(bytes.size()), i % 2 == 0);
      }
    }
  }
  printf("datagrams %llu, connections %llu, messages %llu\n", static_cast<unsigned long long>(garbage.sent()),
         static_cast<unsigned long long>(joined), static_cast<unsigned long long>(messages));
  return joined != 0 && garbage.sent() != 0 ? 0 : 1;
}

/// Of five kinds, in turn. The good ones come again and again.
std::vector<uint8_t> players_message(Seeded& random, const Welcome& welcome, uint32_t rotation_vector) {
  Packet packet;
  packet.match = welcome.match;
  packet.sequence = static_cast<uint32_t>(1 + random.next() % 40);
  packet.player = welcome.player;
  packet.players = welcome.players;
  packet.run_count = 1;
  packet.runs[0] = {welcome.player, 0, 1, {1}};
  if (rotation_vector % 5 == 1) packet.runs[0].first = 1000000;
  if (rotation_vector % 5 == 2) packet.runs[0].player = 0;
  if (rotation_vector % 5 == 3) packet.wanted[0] = 1000000;
  std::vector<uint8_t> bytes(k_packet_bytes_max);
  bytes.resize(write_packet(packet, bytes.data()));
  if (rotation_vector % 5 == 4) bytes[random.next() % bytes.size()] ^= 0x40;
  return bytes;
}

int attack_as_player(uint16_t port, double seconds) {
  Transport transport;
  Options options;
  Welcome welcome;
  Peers peers;
  const volatile int stop = 0;
  if (!transport.connect("127.0.0.1", port) || join(transport, options, stop, welcome, peers) != nullptr) return 2;
  Seeded random(2);
  const uint32_t start = enet_time_get();
  for (uint32_t rotation_vector = 0; enet_time_get() - start < seconds * 1000; ++rotation_vector) {
    const std::vector<uint8_t> bytes = players_message(random, welcome, rotation_vector);
    transport.send(0, bytes.data(), static_cast<uint32_t>(bytes.size()), false);
    if (transport.next(rotation_vector % 10 == 0 ? 1 : 0).kind == Transport::Kind::left) {
      printf("thrown out after %u packets\n", rotation_vector);
      return 0;
    }
  }
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const uint16_t port = static_cast<uint16_t>(strtol(argv[1], nullptr, 10));
  const double seconds = strtod(argv[2], nullptr);
  return argc > 3 ? attack_as_player(port, seconds) : attack_from_outside(port, seconds);
}
