#include "examples/rollback/lobby.h"

#include <stdio.h>

#include <vector>

namespace detent_rollback {
namespace {

constexpr uint32_t k_patience_ms = 2000;  ///< wait for the Hello of a guest
constexpr uint32_t k_join_ms = 10000;

Hello own_hello(const Options& options) {
  return {detent::k_simulation_version, static_cast<uint32_t>(detent::k_config), options.key};
}

bool is_our_hello(const Transport::Event& event, const Options& options) {
  Hello hello;
  const Hello own = own_hello(options);
  return read_hello(event.bytes.data(), static_cast<uint32_t>(event.bytes.size()), hello) &&
         hello.simulation == own.simulation && hello.config == own.config && hello.key == own.key;
}

/// The peers that have joined, in the order of their arrival.
class Guests {
 public:
  struct Guest {
    uint32_t peer, since;
    bool welcome;
  };
  void add(uint32_t peer) { guests_.push_back({peer, enet_time_get(), false}); }
  void remove(uint32_t peer) {
    std::erase_if(guests_, [peer](const Guest& guest) { return guest.peer == peer; });
  }
  void accept(uint32_t peer) {
    for (Guest& guest : guests_) guest.welcome = guest.welcome || guest.peer == peer;
  }
  uint32_t accepted() const {
    return static_cast<uint32_t>(
        std::count_if(guests_.begin(), guests_.end(), [](auto& guest) { return guest.welcome; }));
  }
  void drop_the_silent(Transport& transport) {
    std::erase_if(guests_, [&](const Guest& guest) {
      if (guest.welcome || enet_time_get() - guest.since < k_patience_ms) return false;
      transport.drop(guest.peer);
      return true;
    });
  }
  const std::vector<Guest>& all() const { return guests_; }

 private:
  std::vector<Guest> guests_;
};

void receive(Transport& transport, const Options& options, Guests& guests) {
  const Transport::Event event = transport.next(100);
  switch (event.kind) {
    case Transport::Kind::joined:
      guests.add(event.peer);
      break;
    case Transport::Kind::left:
      guests.remove(event.peer);
      break;
    case Transport::Kind::message:
      if (is_our_hello(event, options)) {
        guests.accept(event.peer);
      } else {
        guests.remove(event.peer);
        transport.drop(event.peer);
      }
      break;
    default:
      break;
  }
  guests.drop_the_silent(transport);
}

}  // namespace

bool gather(Transport& transport, const Options& options, const volatile int& stop, Welcome& welcome, Peers& peers) {
  Guests guests;
  while (guests.accepted() + 1 < options.players) {
    if (stop != 0) return false;
    receive(transport, options, guests);
  }
  welcome.match = static_cast<uint32_t>(mix(options.seed + enet_time_get()));
  welcome.players = options.players;
  welcome.window = options.window;
  welcome.ticks = options.ticks;
  welcome.speed = static_cast<uint32_t>(options.speed * 100 + 0.5);
  welcome.seed = options.seed;
  welcome.player = 0;
  for (const auto& guest : guests.all()) {
    if (!guest.welcome || welcome.player + 1 == options.players) {
      transport.drop(guest.peer);
      continue;
    }
    ++welcome.player;
    peers.is_there[welcome.player] = true;
    peers.peer[welcome.player] = guest.peer;
    uint8_t bytes[k_message_bytes_max];
    transport.send(guest.peer, bytes, write_welcome(welcome, bytes), true);
  }
  welcome.player = 0;
  return true;
}

const char* join(Transport& transport, const Options& options, const volatile int& stop, Welcome& welcome,
                 Peers& peers) {
  const uint32_t start = enet_time_get();
  bool joined = false;
  while (stop == 0) {
    if (!joined && enet_time_get() - start > k_join_ms) return "no host answers at this address";
    const Transport::Event event = transport.next(100);
    if (event.kind == Transport::Kind::left) {
      return joined ? "the host refused: no place is free, or its version or key differs"
                    : "no host answers at this address";
    }
    if (event.kind == Transport::Kind::joined) {
      joined = true;
      uint8_t bytes[k_message_bytes_max];
      transport.send(event.peer, bytes, write_hello(own_hello(options), bytes), true);
    }
    if (event.kind != Transport::Kind::message) continue;
    if (!read_welcome(event.bytes.data(), static_cast<uint32_t>(event.bytes.size()), welcome)) continue;
    peers.is_there[0] = true;
    peers.peer[0] = event.peer;
    return nullptr;
  }
  return "stopped";
}

}  // namespace detent_rollback
