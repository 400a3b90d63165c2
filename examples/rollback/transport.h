#pragma once
#include <enet/enet.h>
#include <stdint.h>

#include <vector>

namespace detent_rollback {

/// Messages between machines over ENet. Those to one machine are told apart by a small number, its peer.
///
/// ENet throws away datagrams that are none of its own, have a wrong CRC-32 or come from where nobody has joined; what
/// is left may still be anything.
class Transport {
 public:
  enum class Kind : uint32_t { nothing, joined, left, message };
  struct Event {
    Kind kind = Kind::nothing;
    uint32_t peer = 0;
    std::vector<uint8_t> bytes;  ///< of a message: at most k_message_bytes_max
  };

  Transport() = default;
  ~Transport();
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  /// Listens at a UDP port for so many at once. False: the port is taken.
  bool listen(uint16_t port, uint32_t peers);
  /// Goes to join who listens there; `joined` tells when it is done. False: no such machine.
  bool connect(const char* address, uint16_t port);

  /// The next that happened, or nothing within so many ms.
  Event next(uint32_t timeout_ms);
  /// Sends to a peer that has joined: once, and perhaps in vain; or `reliably`, as often as it takes.
  void send(uint32_t peer, const uint8_t* bytes, uint32_t count, bool reliably);
  /// Ends a connection at once.
  void drop(uint32_t peer);
  /// Ends all connections once what was sent reliably has come; waits at most so long.
  void close(uint32_t timeout_ms);

  /// Bytes on the wire, with all headers but UDP's own.
  uint64_t bytes_out() const { return host_ != nullptr ? host_->totalSentData : 0; }
  uint64_t bytes_in() const { return host_ != nullptr ? host_->totalReceivedData : 0; }

 private:
  bool open(const ENetAddress* address, uint32_t peers);
  Event event_of(ENetEvent& event);

  ENetHost* host_ = nullptr;
};

}  // namespace detent_rollback
