#pragma once
#include <stdint.h>

#include <algorithm>
#include <vector>

#include "examples/rollback/seeded.h"

namespace detent_rollback {

/// The quality of a link, in one direction.
struct LinkConditions {
  double loss = 0;       ///< fraction of packets lost, [0, 1]
  double duplicate = 0;  ///< fraction of packets duplicated, [0, 1]
  double latency = 0;    ///< s
  /// s: each packet's latency varies by up to this much in both directions, so packets overtake each other.
  double jitter = 0;
};

/// Simulates a bad link: delays packets, loses some and duplicates some. The result depends only on the seed and the
/// order of the calls. The caller passes the time.
class Conditioner {
 public:
  Conditioner(const LinkConditions& conditions, uint64_t seed) : conditions_(conditions), random_(seed) {}

  void send(uint32_t to, const uint8_t* bytes, uint32_t count, double now) {
    const bool lost = random_.uniform() < conditions_.loss;
    const bool doubled = random_.uniform() < conditions_.duplicate;
    for (uint32_t copy = 0; copy < 2; ++copy) {
      const double off = (2 * random_.uniform() - 1) * conditions_.jitter;
      if (lost || (copy == 1 && !doubled)) continue;
      under_way_.push_back({now + std::max(0.0, conditions_.latency + off), to, {bytes, bytes + count}});
    }
  }

  /// Calls deliver(to, bytes, count) for each packet whose delivery time has come.
  template <class Deliver>
  void deliver_due(double now, Deliver deliver) {
    const auto later = [now](const Item& item) { return item.due > now; };
    const auto due = std::stable_partition(under_way_.begin(), under_way_.end(), later);
    std::stable_sort(due, under_way_.end(), [](const Item& a, const Item& b) { return a.due < b.due; });
    for (auto item = due; item != under_way_.end(); ++item) {
      deliver(item->to, item->bytes.data(), static_cast<uint32_t>(item->bytes.size()));
    }
    under_way_.erase(due, under_way_.end());
  }

 private:
  struct Item {
    double due;
    uint32_t to;
    std::vector<uint8_t> bytes;
  };

  LinkConditions conditions_;
  Seeded random_;
  std::vector<Item> under_way_;
};

}  // namespace detent_rollback
