#pragma once
#include <string>
#include <utility>

#include "tests/campaigns/stress/measures.h"

namespace detent_bench {

using detent_stress::Stage;
using detent_stress::States;

/// Follows a run by poses and velocities alone, the same for all engines, and tells what the stress tests measure.
class Watch {
 public:
  Watch(const Stage& stage, const detent_stress::DepthMeter& depths);
  void begin(const States& states);
  /// After every tick, for what happens once: when the last body fell, and when the last one came to a halt.
  void tick(const States& states, uint32_t tick);
  void begin_window();
  void sample(const States& states);
  /// Speeds and penetration are of the window's samples, all else is of these states, at its end.
  std::vector<std::pair<std::string, double>> measures(const States& states) const;

 private:
  const Stage& stage_;
  const detent_stress::DepthMeter& depths_;
  States last_;
  double energy_ = 0;  ///< J; at the start
  double mass_ = 0;    ///< kg; of what can move
  std::vector<bool> fallen_;
  uint32_t ticks_until_fallen_ = 0, ticks_until_still_ = 0;
  uint32_t samples_ = 0;
  double speed_sum_ = 0, depth_sum_ = 0, depth_max_ = 0;
  uint64_t depth_pairs_ = 0;
  std::vector<double> stretches_;  ///< after each tick, where there are joints
};

}  // namespace detent_bench
