#pragma once
#include <detent/rollback.h>

#include <vector>

#include "tests/common/queries/random.h"

/// A network in one process.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A message from one machine to another: the inputs from the first one that the receiver lacks, and checksums of the
/// sender's states.
struct Packet {
  uint32_t player = 0;  ///< whose they are
  uint64_t target = 0;  ///< the first tick of which the sender lacks the receiver's input
  uint64_t first = 0;   ///< the tick of the first input
  std::vector<uint8_t> inputs;
  std::vector<TickChecksum> checksums;
};

/// A one-way connection between two machines. It loses, delays, reorders and duplicates packets.
class Link {
 public:
  Link(uint64_t seed, double loss, uint32_t delay_max) : random_(seed), loss_(loss), delay_max_(delay_max) {}

  void send(const Packet& packet, uint64_t now) {
    if (random_.chance(loss_)) return;
    for (uint32_t copies = random_.chance(0.05) ? 2 : 1; copies != 0; --copies)
      under_way_.push_back({now + 1 + random_.below(delay_max_), packet});
  }
  std::vector<Packet> receive(uint64_t now) {
    std::vector<Packet> arrived;
    for (size_t i = 0; i < under_way_.size();) {
      if (under_way_[i].due > now) {
        ++i;
        continue;
      }
      arrived.push_back(under_way_[i].packet);
      under_way_.erase(under_way_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return arrived;
  }

 private:
  struct Item {
    uint64_t due;
    Packet packet;
  };
  detent_queries::Random random_;
  const double loss_;
  const uint32_t delay_max_;
  std::vector<Item> under_way_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
