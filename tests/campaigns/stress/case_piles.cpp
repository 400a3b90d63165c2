#include "tests/campaigns/stress/ride.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent_stress {

namespace {

constexpr uint32_t k_sample = 10;        ///< ticks between checks of a pile
constexpr uint32_t k_depth_sample = 60;  ///< ticks between measurements of its depths

/// Measures of a pile that should be at rest.
struct Rest {
  double sag_max = 0, speed = 0;
  Depths depths;  ///< the largest measured
};

/// Steps `ticks`, and measures the mean speed and the depths in the last `last` of them.
Rest rest_for(Ride& ride, uint32_t ticks, uint32_t last) {
  const DepthMeter meter(ride.stage());
  Rest rest;
  uint32_t samples = 0;
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    ride.step();
    if (tick % k_sample != 0) continue;
    const States states = ride.states();
    rest.sag_max = fmax(rest.sag_max, sag(ride.stage(), states));
    if (tick + last <= ticks) continue;
    rest.speed += speed_mean(ride.stage(), states);
    ++samples;
    if ((ticks - tick) % k_depth_sample != 0) continue;
    const Depths depths = meter.measure(states);
    rest.depths.mean = fmax(rest.depths.mean, depths.mean);
    rest.depths.max = fmax(rest.depths.max, depths.max);
    rest.depths.pairs = depths.pairs;
  }
  if (samples != 0) rest.speed /= samples;
  return rest;
}

/// The number of bodies that have moved farther than `distance` from their start.
uint32_t fallen(const Stage& stage, const States& states, double distance) {
  uint32_t count = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (stage.bodies[i].role != Role::dynamic) continue;
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      const double displacement = states[i].position[k] - stage.bodies[i].position[k];
      square += displacement * displacement;
    }
    count += square <= distance * distance ? 0 : 1;
  }
  return count;
}

void add_rest(const Ride& ride, Effort effort, const Rest& rest, double fall, Outcome& outcome) {
  const States states = ride.states();
  outcome.add("fallen", fallen(ride.stage(), states, fall * ride.stage().unit));
  outcome.add("drift", ride.length(drift(ride.stage(), states)));
  outcome.add("penetration", ride.length(rest.depths.max));
  outcome.add("sag_max", ride.length(rest.sag_max));
  outcome.add("sag_end", ride.length(sag(ride.stage(), states)));
  // The target speed applies only after the scene's full time.
  outcome.add(effort == Effort::full ? "speed" : "speed_settling", ride.speed(rest.speed));
}

}  // namespace

void run_pyramid(const Trial& trial, Outcome& outcome, uint32_t base) {
  const Stage stage = varied(pyramid(trial.pick(base, base / 2, base / 4)), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const Rest rest = rest_for(ride, trial.pick(stage.ticks, 300, 180), trial.pick(120, 120, 60));
  add_rest(ride, trial.effort, rest, 1.2, outcome);
}

void run_tower(const Trial& trial, Outcome& outcome, uint32_t count) {
  const Stage stage = tower(count, trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const Rest rest = rest_for(ride, trial.pick(stage.ticks, 600, 180), trial.pick(600, 120, 60));
  add_rest(ride, trial.effort, rest, 1.2, outcome);
}

void run_masses(const Trial& trial, Outcome& outcome, const Stage& scene) {
  const Stage stage = varied(scene, trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const Rest rest = rest_for(ride, trial.pick(stage.ticks, 600, 180), trial.pick(120, 120, 60));
  add_rest(ride, trial.effort, rest, 0.5, outcome);
}

void run_pit(const Trial& trial, Outcome& outcome, uint32_t bodies) {
  const Stage stage = pit(trial.pick(bodies, bodies / 10, bodies / 40), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const Rest rest = rest_for(ride, trial.pick(stage.ticks, stage.ticks, 240), trial.pick(150, 150, 60));
  const States states = ride.states();
  uint32_t escaped = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (ride.stage().bodies[i].role != Role::dynamic) continue;
    const double* p = states[i].position;
    const double side = 5 * ride.stage().unit;
    escaped += fabs(p[0]) <= side && fabs(p[2]) <= side && p[1] >= 0 ? 0 : 1;
  }
  outcome.add("escaped", escaped);
  outcome.add("penetration_mean", ride.length(rest.depths.mean));
  outcome.add("penetration_max", ride.length(rest.depths.max));
  outcome.add("speed", ride.speed(rest.speed));
}

void run_stacks(const Trial& trial, Outcome& outcome, uint32_t stacks, bool sleeping) {
  const Stage stage = varied(sleep_stacks(trial.pick(stacks, stacks / 50, 2), 5, sleeping), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const uint32_t lead_in = trial.pick(600, 300, 120), timed = stage.ticks - 600;
  uint32_t asleep_after = 0, awake = 0;
  double rest_seconds = 0;
  for (uint32_t tick = 1; tick <= lead_in + timed; ++tick) {
    const double before = outcome.step_seconds;
    awake = ride.step().awake;
    if (awake == 0 && asleep_after == 0) asleep_after = tick;
    if (tick > lead_in) rest_seconds += outcome.step_seconds - before;
  }
  add_rest(ride, trial.effort, rest_for(ride, k_depth_sample, k_depth_sample), 0.5, outcome);
  outcome.add("awake", awake);
  if (sleeping) outcome.add("asleep_after", asleep_after);
  outcome.add("us_a_step", rest_seconds / timed * 1e6);
}

void run_far(const Trial& trial, Outcome& outcome, double distance) {
  const Stage stage = varied(pyramid(trial.pick(20, 8, 4)), trial.seed);
  // The stage must be on the grid that moved() uses after it is scaled.
  Trial unscaled = trial;
  unscaled.scale = 1;
  const Stage placed = scaled(stage, trial.scale);
  Ride ride(unscaled, moved(placed, 0), outcome);
  if (!ride.good()) return;
  Ride other(unscaled, moved(placed, distance), outcome);
  if (!other.good()) return;
  uint32_t differ = 0, first = 0;
  const uint32_t ticks = trial.pick(stage.ticks, 60, 30);
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    ride.step();
    other.step();
    if (ride.run().relative_digest() == other.run().relative_digest()) continue;
    if (differ++ == 0) first = tick;
  }
  outcome.add("ticks_differ", differ);
  if (differ != 0) outcome.add("first_difference", first);
}

}  // namespace detent_stress
