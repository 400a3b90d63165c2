#pragma once
#include <stdint.h>

#include <algorithm>

namespace detent_rollback {

/// The result of checking a packet.
enum class Verdict : uint32_t {
  used,
  /// Received before, or older than the last 64 sequence numbers. Networks duplicate and delay packets, so the sender
  /// is not blamed.
  repeated,
  refused,  ///< not a valid packet, impossible content, or above the rate limit
};

/// Checks the packets of one sender.
class Guard {
 public:
  /// Counts one more packet; whether it is above the rate limit. A sender sends one packet a frame, 60 a second. After
  /// a pause of this machine, all packets of the pause arrive at once.
  bool is_flood(double now) {
    tokens_ = std::min(k_burst, tokens_ + std::max(0.0, now - time_) * k_rate);
    time_ = std::max(time_, now);
    if (tokens_ < 1) return true;
    tokens_ -= 1;
    return false;
  }
  /// Whether a packet with this number was received before, or may have been: only the last 64 numbers are stored.
  bool is_repeated(uint32_t sequence) const {
    const uint32_t back = newest_ - sequence;
    return sequence <= newest_ && (back >= 64 || (seen_ >> back & 1) != 0);
  }
  void remember(uint32_t sequence) {
    if (sequence <= newest_) {
      seen_ |= uint64_t{1} << (newest_ - sequence);
      return;
    }
    const uint32_t on = sequence - newest_;
    seen_ = (on < 64 ? seen_ << on : 0) | 1;
    newest_ = sequence;
  }

  void refuse() { ++refused_; }
  uint32_t refused() const { return refused_; }
  /// Whether the sender has sent more refused packets than accidents explain.
  bool is_hostile() const { return refused_ > k_refused_max; }

 private:
  /// Allowed packets a second, and allowed packets at once, as after a pause of a minute.
  static constexpr double k_rate = 180, k_burst = 3600;
  static constexpr uint32_t k_refused_max = 100;

  double tokens_ = k_burst, time_ = 0;
  uint32_t newest_ = 0;  ///< the first sequence number is 1
  uint64_t seen_ = 1;
  uint32_t refused_ = 0;
};

}  // namespace detent_rollback
