#include <algorithm>

#include "tests/campaigns/stress/ride.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent_stress {

void run_chain(const Trial& trial, Outcome& outcome, double ratio) {
  const Stage stage = varied(chain(30, ratio), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  std::vector<double> stretches(trial.pick(stage.ticks, 600, 180));
  for (double& each : stretches) {
    ride.step();
    each = stretch(ride.stage(), ride.states());
  }
  outcome.add("stretch_max", *std::max_element(stretches.begin(), stretches.end()));
  outcome.add("stretch_late", late_mean(stretches));
}

void run_free_rotation(const Trial& trial, Outcome& outcome) {
  constexpr double k_flips = 74, k_degree = 3.14159265358979 / 180;
  const Stage stage = varied(free_rotation(), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const Sums start = sums_of(ride.stage(), ride.states());
  int flips = 0, side = 1;
  double energy = 0, momentum = 0, direction = 0;
  for (uint32_t tick = 1; tick <= stage.ticks; ++tick) {
    ride.step();
    const States states = ride.states();
    const double* angular_velocity = states[0].angular_velocity;
    if (to_local(states[0].rotation, {angular_velocity[0], angular_velocity[1], angular_velocity[2]})[1] * side <
        -5 / sqrt(ride.stage().unit)) {
      ++flips;
      side = -side;
    }
    if (tick % 10 != 0) continue;
    const Sums now = sums_of(ride.stage(), states);
    energy = fmax(energy, fabs(now.energy / start.energy - 1));
    momentum = fmax(momentum, fabs(length(now.angular) / length(start.angular) - 1));
    direction = fmax(direction, angle_between(now.angular, start.angular) / k_degree);
  }
  outcome.add("flips", fabs(flips - k_flips));
  outcome.add("energy", energy);
  outcome.add("momentum", momentum);
  outcome.add("direction", direction);
}

void run_dominoes(const Trial& trial, Outcome& outcome, uint32_t count) {
  // Cosines of the tilt that counts as hit by the wave (0.1 rad; the first starts at 0.2), and of the tilt that counts
  // as fallen.
  constexpr double k_struck = 0.995, k_upright = 0.7071;
  const Stage stage = varied(dominoes(trial.pick(count, count / 5, count / 20)), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  // The bodies in the order of the row, which starts at the tilted domino. Body 0 is the floor.
  const Stage& placed = ride.stage();
  const auto upright_at_start = [&](size_t i) { return to_world(placed.bodies[i].rotation, {0, 1, 0})[1]; };
  size_t first = 1;
  for (size_t i = 2; i < placed.bodies.size(); ++i) {
    if (upright_at_start(i) < upright_at_start(first)) first = i;
  }
  const auto from_first = [&](size_t i) {
    const double x = placed.bodies[i].position[0] - placed.bodies[first].position[0];
    const double z = placed.bodies[i].position[2] - placed.bodies[first].position[2];
    return std::array<double, 3>{x, 0, z};
  };
  std::vector<size_t> row;
  for (size_t i = 1; i < placed.bodies.size(); ++i) row.push_back(i);
  std::sort(row.begin(), row.end(), [&](size_t i, size_t j) { return length(from_first(i)) < length(from_first(j)); });

  std::vector<uint32_t> struck(row.size(), 0), fell(row.size(), 0);
  const uint32_t ticks = trial.pick(stage.ticks, 600, 300);
  for (uint32_t tick = 1; tick <= ticks; ++tick) {
    ride.step();
    const States states = ride.states();
    for (size_t i = 0; i < row.size(); ++i) {
      const double upright = to_world(states[row[i]].rotation, {0, 1, 0})[1];
      if (struck[i] == 0 && upright < k_struck) struck[i] = tick;
      if (fell[i] == 0 && upright < k_upright) fell[i] = tick;
    }
  }
  uint32_t standing = 0, disorder = 0, last = 0;
  for (size_t i = 0; i < row.size(); ++i) {
    standing += fell[i] == 0 ? 1u : 0u;
    disorder += i > 0 && struck[i] < struck[i - 1] ? 1u : 0u;
    last = std::max(last, fell[i]);
  }
  const std::array<double, 3> displacement = from_first(row.back());
  const States states = ride.states();
  double sideways = 0;
  for (const size_t i : row) {
    const double x = states[i].position[0] - placed.bodies[i].position[0];
    const double z = states[i].position[2] - placed.bodies[i].position[2];
    sideways = fmax(sideways, fabs(x * displacement[2] - z * displacement[0]) / length(displacement));
  }
  outcome.add("standing", standing);
  outcome.add("disorder", disorder);
  outcome.add("last_fell", last * placed.tick / sqrt(placed.unit));
  outcome.add("sideways", ride.length(sideways));
}

void run_incline(const Trial& trial, Outcome& outcome, double part) {
  constexpr double k_friction = 0.5;
  const Stage stage = varied(incline(k_friction, part), trial.seed);
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  const std::array<double, 3> down = to_world(stage.bodies[0].rotation, {1, 0, 0});
  const auto along = [&](const double(&v)[3]) { return v[0] * down[0] + v[1] * down[1] + v[2] * down[2]; };
  ride.skip(60);
  const BodyState start = ride.states()[1];
  const uint32_t ticks = trial.pick(3600, 600, 600);
  ride.skip(ticks);
  const double displacement = ride.length(along(ride.states()[1].position) - along(start.position));
  if (part < 1) {
    outcome.add("creep", fabs(displacement));
    return;
  }
  const double tangent = k_friction * part, cosine = 1 / sqrt(1 + tangent * tangent);
  const double pull = stage.gravity * cosine * (tangent - k_friction), time = ticks / 60.0;
  const double right = ride.speed(along(start.linear_velocity)) * time + pull * time * time / 2;
  outcome.add("distance", fabs(displacement / right - 1));
}

void run_bounce(const Trial& trial, Outcome& outcome) {
  constexpr double k_height = 5;
  const Stage stage = bounce(k_height, trial.pick(1000, 100, 20));
  Ride ride(trial, stage, outcome);
  if (!ride.good()) return;
  double error = 0, apex = 0, before = 0;
  uint32_t bounces = 0;
  for (uint32_t tick = 1; tick <= stage.ticks; ++tick) {
    ride.step();
    const BodyState ball = ride.states()[1];
    const double height = ride.length(ball.position[1]), rise = ride.speed(ball.linear_velocity[1]);
    if (before <= 0 && rise > 0) ++bounces;
    if (before > 0 && rise <= 0) {
      // The height at the tick nearest to the apex, plus the remaining rise or the drop since the apex.
      apex = height + rise * rise / (2 * stage.gravity);
      error = fmax(error, fabs(apex - k_height));
    }
    before = rise;
  }
  // A ball that never bounces has no apex.
  outcome.add("apex", bounces == 0 ? k_height : error);
  outcome.add("apex_last", apex);
  outcome.add("bounces", bounces);
}

}  // namespace detent_stress
