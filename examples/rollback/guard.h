#pragma once
#include <stdint.h>

#include <algorithm>

namespace detent_rollback {

/// What has become of a packet.
enum class Verdict : uint32_t {
  used,
  repeated,  ///< came before, or is older than the memory of what came: networks do that, so nobody is blamed
  refused,   ///< is none, says what cannot be, or is one too many
};

/// Watches over what one sender sends.
class Guard {
 public:
  /// Whether a packet more is too many. A frame sends one, so a second brings 60, or after a pause of
  /// this machine's all of the pause's.
  bool is_flood(double now) {
    tokens_ = std::min(k_burst, tokens_ + std::max(0.0, now - time_) * k_rate);
    time_ = std::max(time_, now);
    if (tokens_ < 1) return true;
    tokens_ -= 1;
    return false;
  }
  /// Whether a packet of this number came before, or may have: remembered are the last 64.
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
  /// Has sent so much that was refused that it is no accident.
  bool is_hostile() const { return refused_ > k_refused_max; }

 private:
  static constexpr double k_rate = 180, k_burst = 3600;  ///< packets a second; packets, of a minute
  static constexpr uint32_t k_refused_max = 100;

  double tokens_ = k_burst, time_ = 0;
  uint32_t newest_ = 0;  ///< sequences begin at 1
  uint64_t seen_ = 1;
  uint32_t refused_ = 0;
};

}  // namespace detent_rollback
