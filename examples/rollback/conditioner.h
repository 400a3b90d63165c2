#pragma once
#include <stdint.h>

#include <algorithm>
#include <vector>

#include "examples/rollback/seeded.h"

namespace detent_rollback {

/// How bad a link is, one way.
struct LinkConditions {
  double loss = 0;       ///< of packets, [0, 1]
  double duplicate = 0;  ///< of packets, [0, 1]
  double latency = 0;    ///< s
  double jitter = 0;     ///< s: each packet is up to so much faster or slower, and so overtakes others
};

/// Holds what is sent for as long as a bad link would, loses some and doubles some: by the seed and the order of the
/// calls alone. The time is the caller's.
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

  /// Calls deliver(to, bytes, count) for all whose time has come.
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
