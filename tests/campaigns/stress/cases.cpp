#include "tests/campaigns/stress/cases.h"

#include <string.h>

#include <chrono>

#include "tests/campaigns/stress/bounds.h"
#include "tests/campaigns/stress/ride.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent_stress {

Ride::Ride(const Trial& trial, const Stage& stage, Outcome& outcome)
    : stage_(scaled(stage, trial.scale)), outcome_(outcome) {
  run_ = trial.engine.make(stage_, trial.settings, outcome.problem);
}

Ride::~Ride() {
  if (run_ == nullptr) return;
  const auto add = [this](const char* name, double value) {
    for (Measured& measured : outcome_.measured) {
      if (measured.name != name) continue;
      measured.value += value;
      return;
    }
    outcome_.add(name, value);
  };
  add("lost", lost_);
  add("saturations", saturations_);
  outcome_.digest = run_->digest();
}

Counts Ride::step() {
  const auto start = std::chrono::steady_clock::now();
  const Counts counts = run_->step();
  outcome_.step_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++outcome_.ticks;
  lost_ += counts.lost;
  saturations_ += counts.saturations;
  lost_time_ += counts.lost_time;
  return counts;
}

namespace {

std::vector<Case> make_cases() {
  std::vector<Case> cases;
  const auto add = [&cases](const char* group, const std::string& name, auto run, bool extra = false) {
    cases.push_back({group, name, extra, run});
  };
  add("S1", "pyramid", [](const Trial& trial, Outcome& outcome) { run_pyramid(trial, outcome, 20); });
  for (const uint32_t count : {10u, 20u, 40u, 60u, 80u}) {
    add(
        "S2", "tower_" + std::to_string(count),
        [count](const Trial& trial, Outcome& outcome) { run_tower(trial, outcome, count); }, count > 40);
  }
  for (const uint32_t ratio : {10u, 100u, 1000u, 10000u}) {
    add(
        "S3", "cube_" + std::to_string(ratio) + ":1",
        [ratio](const Trial& trial, Outcome& outcome) { run_masses(trial, outcome, mass_cube(ratio)); }, ratio > 1000);
  }
  for (const uint32_t ratio : {10u, 100u, 1000u, 10000u}) {
    add("S3", "slab_" + std::to_string(ratio) + ":1",
        [ratio](const Trial& trial, Outcome& outcome) { run_masses(trial, outcome, mass_slab(ratio)); });
  }
  add("S4", "pit", [](const Trial& trial, Outcome& outcome) { run_pit(trial, outcome, 1000); });
  for (const Target target : {Target::wall, Target::plate}) {
    for (const Projectile projectile : {Projectile::ball, Projectile::rod}) {
      for (const uint32_t speed : {100u, 500u, 2000u}) {
        const std::string name = std::string(target == Target::wall ? "wall" : "plate") +
                                 (projectile == Projectile::ball ? "_ball_" : "_rod_") + std::to_string(speed);
        add("S5", name, [target, projectile, speed](const Trial& trial, Outcome& outcome) {
          run_shots(trial, outcome, target, projectile, speed);
        });
      }
    }
  }
  for (const uint32_t ratio : {100u, 10u, 1u}) {
    add("S6", "chain_" + std::to_string(ratio) + ":1",
        [ratio](const Trial& trial, Outcome& outcome) { run_chain(trial, outcome, ratio); });
  }
  add("S7", "free_rotation", run_free_rotation);
  add("S8", "dominoes", [](const Trial& trial, Outcome& outcome) { run_dominoes(trial, outcome, 200); });
  add("S9", "incline_holds", [](const Trial& trial, Outcome& outcome) { run_incline(trial, outcome, 0.99); });
  add("S9", "incline_slides", [](const Trial& trial, Outcome& outcome) { run_incline(trial, outcome, 1.01); });
  add("S10", "stacks_awake", [](const Trial& trial, Outcome& outcome) { run_stacks(trial, outcome, 1000, false); });
  add("S10", "stacks_asleep", [](const Trial& trial, Outcome& outcome) { run_stacks(trial, outcome, 1000, true); });
  for (const uint32_t kilometres : {1u, 10u, 100u, 10000u}) {
    add("S11", "far_" + std::to_string(kilometres) + "km",
        [kilometres](const Trial& trial, Outcome& outcome) { run_far(trial, outcome, kilometres * 1000.0); });
  }
  add("S12", "bounce", run_bounce);
  add("S12", "bounce_discrete", [](const Trial& trial, Outcome& outcome) {
    Trial discrete = trial;
    discrete.settings.continuous = false;
    run_bounce(discrete, outcome);
  });
  return cases;
}

}  // namespace

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases = make_cases();
  return cases;
}

Outcome run_case(const Case& which, const Trial& trial) {
  Outcome outcome;
  which.run(trial, outcome);
  return outcome;
}

bool is_refused(const std::string& scene, const std::string& config, double scale) {
  for (const Refused& refused : k_refused) {
    if (scene.compare(0, strlen(refused.scene), refused.scene) == 0 &&
        (*refused.config == 0 || config == refused.config) && (refused.scale == 0 || refused.scale == scale))
      return true;
  }
  return false;
}

const Wanted* find_wanted(const std::string& scene, const std::string& measure) {
  for (const Wanted& wanted : k_wanted) {
    if (scene.compare(0, strlen(wanted.scene), wanted.scene) == 0 && measure == wanted.measure) return &wanted;
  }
  return nullptr;
}

const Gap* find_gap(const std::string& scene, const std::string& config, double scale, const std::string& measure) {
  for (const Gap& gap : k_gaps) {
    if (*gap.scene != 0 && scene.compare(0, strlen(gap.scene), gap.scene) == 0 &&
        (*gap.config == 0 || config == gap.config) && (gap.scale == 0 || scale == gap.scale) && measure == gap.measure)
      return &gap;
  }
  return nullptr;
}

}  // namespace detent_stress
