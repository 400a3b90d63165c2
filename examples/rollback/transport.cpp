#include "examples/rollback/transport.h"

#include "examples/rollback/packet.h"

namespace detent_rollback {

Transport::~Transport() {
  if (host_ != nullptr) {
    enet_host_destroy(host_);
    enet_deinitialize();
  }
}

bool Transport::open(const ENetAddress* address, uint32_t peers) {
  if (enet_initialize() != 0) return false;
  host_ = enet_host_create(address, peers, 1, 0, 0);
  if (host_ == nullptr) {
    enet_deinitialize();
    return false;
  }
  host_->checksum = enet_crc32;
  host_->maximumPacketSize = k_message_bytes_max;
  host_->maximumWaitingData = 64 * k_message_bytes_max;
  return true;
}

bool Transport::listen(uint16_t port, uint32_t peers) {
  const ENetAddress address = {ENET_HOST_ANY, port};
  return open(&address, peers);
}

bool Transport::connect(const char* address, uint16_t port) {
  ENetAddress there = {0, port};
  return open(nullptr, 1) && enet_address_set_host(&there, address) == 0 &&
         enet_host_connect(host_, &there, 1, 0) != nullptr;
}

Transport::Event Transport::event_of(ENetEvent& event) {
  Event result;
  if (event.type == ENET_EVENT_TYPE_NONE) return result;
  result.peer = static_cast<uint32_t>(event.peer - host_->peers);
  switch (event.type) {
    case ENET_EVENT_TYPE_CONNECT:
      result.kind = Kind::joined;
      // By default ENet sends less to a peer that answers late, as on a bad link. A match sends little, so this is
      // disabled.
      enet_peer_throttle_configure(event.peer, ENET_PEER_PACKET_THROTTLE_INTERVAL, ENET_PEER_PACKET_THROTTLE_SCALE, 0);
      break;
    case ENET_EVENT_TYPE_DISCONNECT:
      result.kind = Kind::left;
      break;
    default:
      result.kind = Kind::message;
      result.bytes.assign(event.packet->data, event.packet->data + event.packet->dataLength);
      enet_packet_destroy(event.packet);
      break;
  }
  return result;
}

Transport::Event Transport::next(uint32_t timeout_ms) {
  // A datagram larger than ENet's read buffer makes enet_host_service return an error and is dropped. It comes from an
  // attacker, because the datagrams of a match are small. So an error does not end the loop.
  ENetEvent event = {};
  for (uint32_t errors = 0; errors < 64; ++errors) {
    if (enet_host_service(host_, &event, timeout_ms) >= 0) return event_of(event);
  }
  return {};
}

void Transport::send(uint32_t peer, const uint8_t* bytes, uint32_t count, bool reliably) {
  const uint32_t flags = reliably ? ENET_PACKET_FLAG_RELIABLE : ENET_PACKET_FLAG_UNSEQUENCED;
  ENetPacket* const packet = enet_packet_create(bytes, count, flags);
  if (packet != nullptr && enet_peer_send(&host_->peers[peer], 0, packet) != 0) enet_packet_destroy(packet);
}

void Transport::drop(uint32_t peer) { enet_peer_disconnect_now(&host_->peers[peer], 0); }

void Transport::close(uint32_t timeout_ms) {
  if (host_ == nullptr) return;
  for (size_t i = 0; i < host_->peerCount; ++i) enet_peer_disconnect_later(&host_->peers[i], 0);
  const uint32_t start = enet_time_get();
  while (host_->connectedPeers != 0 && enet_time_get() - start < timeout_ms) next(10);
}

}  // namespace detent_rollback
