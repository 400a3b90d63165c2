#include "tests/bench/world/watch.h"

#include <math.h>
#include <string.h>

#include <algorithm>

namespace detent_bench {

namespace {

using detent_stress::BodyState;
using detent_stress::Role;

bool same_pose(const BodyState& a, const BodyState& b) {
  return memcmp(a.position, b.position, sizeof a.position) == 0 &&
         memcmp(a.rotation, b.rotation, sizeof a.rotation) == 0;
}

/// The cosine between the body's y axis and the vertical.
double upright(const BodyState& state) { return detent_stress::to_world(state.rotation, {0, 1, 0})[1]; }

double energy_of(const Stage& stage, const States& states) {
  const detent_stress::Sums sums = sums_of(stage, states);
  return sums.energy + sums.potential;
}

/// From the pit of scene S4: beyond the middle of a wall, or as deep in the floor.
uint32_t escaped(const Stage& stage, const States& states) {
  const double wall = fabs(stage.bodies[1].position[0]);
  uint32_t count = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    const auto& position = states[i].position;
    count += stage.bodies[i].role == Role::dynamic &&
             (position[1] < -0.5 || fabs(position[0]) > wall || fabs(position[2]) > wall);
  }
  return count;
}

double sideways(const Stage& stage, const States& states) {
  double result = 0;
  for (size_t i = 0; i < states.size(); ++i)
    result = std::max(result, fabs(states[i].position[2] - stage.bodies[i].position[2]));
  return result;
}

}  // namespace

Watch::Watch(const Stage& stage, const detent_stress::DepthMeter& depths) : stage_(stage), depths_(depths) {
  for (const auto& body : stage.bodies) {
    if (body.role == Role::dynamic) mass_ += mass_of(body);
  }
}

void Watch::begin(const States& states) {
  last_ = states;
  energy_ = energy_of(stage_, states);
  fallen_.assign(states.size(), false);
  stretches_.clear();
}

void Watch::tick(const States& states, uint32_t tick) {
  for (size_t i = 0; i < states.size(); ++i) {
    if (stage_.bodies[i].role != Role::dynamic) continue;
    if (!same_pose(states[i], last_[i])) ticks_until_still_ = tick + 1;
    if (fallen_[i] || upright(states[i]) > 0.5) continue;
    fallen_[i] = true;
    ticks_until_fallen_ = tick + 1;
  }
  last_ = states;
  if (!stage_.joints.empty()) stretches_.push_back(stretch(stage_, states));
}

void Watch::begin_window() {
  samples_ = 0;
  depth_pairs_ = 0;
  speed_sum_ = depth_sum_ = depth_max_ = 0;
}

void Watch::sample(const States& states) {
  if (!stage_.collisions) return;  // what hangs together swings and overlaps as it should
  ++samples_;
  speed_sum_ += speed_mean(stage_, states);
  const detent_stress::Depths depths = depths_.measure(states);
  depth_sum_ += depths.mean * depths.pairs;
  depth_pairs_ += depths.pairs;
  depth_max_ = std::max(depth_max_, depths.max);
}

std::vector<std::pair<std::string, double>> Watch::measures(const States& states) const {
  std::vector<std::pair<std::string, double>> result;
  const auto add = [&result](const char* name, double value) { result.emplace_back(name, value); };
  if (stage_.name == "pit") {
    add("escaped", escaped(stage_, states));
  } else if (stage_.name == "dominoes") {
    add("drift", sideways(stage_, states));
    add("fallen", static_cast<double>(std::count(fallen_.begin(), fallen_.end(), true)));
    add("last_fall_s", ticks_until_fallen_ * stage_.tick);
  } else if (stage_.name == "chain") {
    add("stretch_max", *std::max_element(stretches_.begin(), stretches_.end()));
    add("stretch_late", detent_stress::late_mean(stretches_));
  } else {
    add("drift", drift(stage_, states));
    add("sag", sag(stage_, states));
  }
  if (stage_.collisions) {
    add("penetration_mean", depth_pairs_ == 0 ? 0 : depth_sum_ / static_cast<double>(depth_pairs_));
    add("penetration_max", depth_max_);
    add("speed_mean", samples_ == 0 ? 0 : speed_sum_ / samples_);
  }
  add("energy", (energy_of(stage_, states) - energy_) / mass_);
  if (stage_.sleeping) add("ticks_until_asleep", ticks_until_still_);
  return result;
}

}  // namespace detent_bench
