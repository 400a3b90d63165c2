#pragma once
#include <math.h>

#include "tests/campaigns/stress/cases.h"
#include "tests/campaigns/stress/measures.h"

namespace detent_stress {

/// A trial's running world: steps it and sums up the overflow counts.
class Ride {
 public:
  /// `stage` is at scale 1. If the engine refuses it, `outcome` has the problem and good() is false.
  Ride(const Trial& trial, const Stage& stage, Outcome& outcome);
  ~Ride();  ///< adds the measures of every ride to the outcome
  Ride(const Ride&) = delete;
  Ride& operator=(const Ride&) = delete;

  bool good() const { return run_ != nullptr; }
  Counts step();
  void skip(uint32_t ticks) {
    for (uint32_t i = 0; i < ticks; ++i) step();
  }
  States states() const { return run_->states(); }
  const Run& run() const { return *run_; }
  const Stage& stage() const { return stage_; }
  double length(double metres) const { return metres / stage_.unit; }
  double speed(double metres_per_second) const { return metres_per_second / sqrt(stage_.unit); }
  double lost_time() const { return lost_time_; }

 private:
  Stage stage_;
  Outcome& outcome_;
  std::unique_ptr<Run> run_;
  double lost_ = 0, saturations_ = 0, lost_time_ = 0;
};

void run_pyramid(const Trial& trial, Outcome& outcome, uint32_t base);
void run_tower(const Trial& trial, Outcome& outcome, uint32_t count);
void run_masses(const Trial& trial, Outcome& outcome, const Stage& stage);
void run_pit(const Trial& trial, Outcome& outcome, uint32_t bodies);
void run_stacks(const Trial& trial, Outcome& outcome, uint32_t stacks, bool sleeping);
void run_far(const Trial& trial, Outcome& outcome, double distance);

enum class Target : uint32_t;
enum class Projectile : uint32_t;
void run_shots(const Trial& trial, Outcome& outcome, Target target, Projectile projectile, double speed);

void run_chain(const Trial& trial, Outcome& outcome, double ratio);
void run_free_rotation(const Trial& trial, Outcome& outcome);
void run_dominoes(const Trial& trial, Outcome& outcome, uint32_t count);
void run_incline(const Trial& trial, Outcome& outcome, double part);
void run_bounce(const Trial& trial, Outcome& outcome);

}  // namespace detent_stress
