#pragma once
#include <enet/enet.h>
#include <stdint.h>

#include <vector>

namespace detent_rollback {

/// Messages between machines over ENet. A small number, the peer, identifies each connected machine.
///
/// ENet drops datagrams of other protocols, those with a wrong CRC-32 and those of unconnected senders. All other
/// messages may still have any content.
class Transport {
 public:
  enum class Kind : uint32_t { nothing, joined, left, message };
  struct Event {
    Kind kind = Kind::nothing;
    uint32_t peer = 0;
    std::vector<uint8_t> bytes;  ///< the message: at most k_message_bytes_max bytes
  };

  Transport() = default;
  ~Transport();
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  /// Listens at a UDP port for at most `peers` connections. False: the port is taken.
  bool listen(uint16_t port, uint32_t peers);
  /// Starts to connect to a listening machine; the event `joined` reports success. False: no such machine.
  bool connect(const char* address, uint16_t port);

  /// The next event, or `nothing` after timeout_ms.
  Event next(uint32_t timeout_ms);
  /// Sends to a connected peer: once and without guarantee, or `reliably`, repeated until it arrives.
  void send(uint32_t peer, const uint8_t* bytes, uint32_t count, bool reliably);
  /// Closes a connection at once.
  void drop(uint32_t peer);
  /// Closes all connections after the reliable messages have arrived; waits at most timeout_ms.
  void close(uint32_t timeout_ms);

  /// Bytes on the wire, including all headers except those of UDP and IP.
  uint64_t bytes_out() const { return host_ != nullptr ? host_->totalSentData : 0; }
  uint64_t bytes_in() const { return host_ != nullptr ? host_->totalReceivedData : 0; }

 private:
  bool open(const ENetAddress* address, uint32_t peers);
  Event event_of(ENetEvent& event);

  ENetHost* host_ = nullptr;
};

}  // namespace detent_rollback
