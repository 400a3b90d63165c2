#include <algorithm>

#include "tests/campaigns/stress/ride.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent_stress {

namespace {

using Point = std::array<double, 3>;

/// Transforms a world point to the target's frame.
Point in_target(const BodyState& target, const Point& point) {
  return to_local(target.rotation, point - Point{target.position[0], target.position[1], target.position[2]});
}

/// Whether the segment crosses the target's plane within `side` of its centre along both axes.
bool crosses(const Point& from, const Point& to, double side) {
  if ((from[2] > 0) == (to[2] > 0)) return false;
  const double part = from[2] / (from[2] - to[2]);
  return fabs(from[0] + (to[0] - from[0]) * part) < side && fabs(from[1] + (to[1] - from[1]) * part) < side;
}

/// The rotation vector from one rotation to another in `time`: of the possible vectors, the one nearest to the angular
/// velocity.
Point turn_between(const BodyState& from, const BodyState& to, double time) {
  constexpr double k_two_pi = 6.28318530717958647693;
  const double *a = to.rotation, *b = from.rotation;
  const Point v = {-a[3] * b[0] + a[0] * b[3] - a[1] * b[2] + a[2] * b[1],
                   -a[3] * b[1] + a[0] * b[2] + a[1] * b[3] - a[2] * b[0],
                   -a[3] * b[2] - a[0] * b[1] + a[1] * b[0] + a[2] * b[3]};
  const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], sine = length(v);
  if (sine < 1e-12) return {0, 0, 0};
  double angle = 2 * atan2(sine, w), along = 0;
  for (size_t i = 0; i < 3; ++i) along += v[i] / sine * to.angular_velocity[i] * time;
  angle += k_two_pi * rint((along - angle) / k_two_pi);
  return {v[0] / sine * angle, v[1] / sine * angle, v[2] / sine * angle};
}

/// The body's state at a fraction of a tick, with constant linear and angular velocity.
BodyState state_between(const BodyState& from, const BodyState& to, const Point& rotation_vector, double part) {
  BodyState state = to;
  const double angle = length(rotation_vector) * part, half = angle > 0 ? sin(angle / 2) / length(rotation_vector) : 0;
  const double q[4] = {rotation_vector[0] * half, rotation_vector[1] * half, rotation_vector[2] * half, cos(angle / 2)},
               *r = from.rotation;
  const double product[4] = {
      q[3] * r[0] + q[0] * r[3] + q[1] * r[2] - q[2] * r[1], q[3] * r[1] - q[0] * r[2] + q[1] * r[3] + q[2] * r[0],
      q[3] * r[2] + q[0] * r[1] - q[1] * r[0] + q[2] * r[3], q[3] * r[3] - q[0] * r[0] - q[1] * r[1] - q[2] * r[2]};
  for (int i = 0; i < 4; ++i) state.rotation[i] = product[i];
  for (int i = 0; i < 3; ++i) state.position[i] = from.position[i] + (to.position[i] - from.position[i]) * part;
  return state;
}

struct Flight {
  bool through = false;     ///< its centre has passed the target and is behind it at the end
  bool skewered = false;    ///< its ends are on different sides
  bool wrong_side = false;  ///< its centre has passed the target at some time
};

Flight fly(Ride& ride) {
  const StageBody& slab = ride.stage().bodies[0];
  const StageBody& shot = ride.stage().bodies[1];
  const bool rod = shot.solid == Solid::box;
  const double distance_max = rod ? shot.size[1] : shot.size[0];
  // Nearer to the rim, the projectile may pass beside the target.
  const double side = slab.size[0] - distance_max;
  Flight flight;
  // A rotating target moves away from the projectile's straight path within a tick, so each tick is tested in parts.
  constexpr uint32_t k_parts = 64;
  const auto centre_in = [](const BodyState& target, const BodyState& body) {
    return in_target(target, {body.position[0], body.position[1], body.position[2]});
  };
  States states = ride.states();
  for (uint32_t tick = 0; tick < ride.stage().ticks; ++tick) {
    const States before = states;
    ride.step();
    states = ride.states();
    const Point rotation_vector = turn_between(before[0], states[0], ride.stage().tick);
    Point from = centre_in(before[0], before[1]);
    for (uint32_t i = 1; i <= k_parts; ++i) {
      const double part = static_cast<double>(i) / k_parts;
      const BodyState target = i == k_parts ? states[0] : state_between(before[0], states[0], rotation_vector, part);
      const Point to = centre_in(target, state_between(before[1], states[1], {0, 0, 0}, part));
      if (crosses(from, to, side)) {
        flight.wrong_side = true;
        flight.through = !flight.through;
      }
      from = to;
    }
  }
  if (rod) {
    const Point half = to_world(states[1].rotation, {0, shot.size[1] - 2 * shot.size[0], 0});
    Point ends[2];
    for (size_t i = 0; i < 3; ++i) {
      ends[0][i] = states[1].position[i] + half[i];
      ends[1][i] = states[1].position[i] - half[i];
    }
    flight.skewered = crosses(in_target(states[0], ends[0]), in_target(states[0], ends[1]), side);
  }
  return flight;
}

/// The difference of the ball's velocity from that after an impact without rebound, relative to its speed.
double rebound_error(const Ride& ride) {
  const Stage& stage = ride.stage();
  const BodyState now = ride.states()[1];
  const Point normal = to_world(stage.bodies[0].rotation, {0, 0, 1});
  double along = 0;
  for (size_t i = 0; i < 3; ++i) along += normal[i] * stage.bodies[1].linear_velocity[i];
  Point tangential;
  for (size_t i = 0; i < 3; ++i) tangential[i] = stage.bodies[1].linear_velocity[i] - along * normal[i];
  // Friction slows the ball until it rolls; then 2/7 of its speed along the wall are lost.
  const double speed = length(tangential), friction = stage.bodies[1].friction;
  const double left = speed > 0 ? 1 - fmin(friction * fabs(along) / speed, 2.0 / 7) : 0;
  double square = 0, whole = 0;
  for (size_t i = 0; i < 3; ++i) {
    square += (now.linear_velocity[i] - tangential[i] * left) * (now.linear_velocity[i] - tangential[i] * left);
    whole += stage.bodies[1].linear_velocity[i] * stage.bodies[1].linear_velocity[i];
  }
  return sqrt(square / whole);
}

}  // namespace

void run_shots(const Trial& trial, Outcome& outcome, Target target, Projectile projectile, double speed) {
  const uint32_t shots = trial.pick(200, 20, 5);
  uint32_t through = 0, skewered = 0, wrong_side = 0;
  double lost_time = 0, rebound = 0, momentum = 0, energy = 0;
  for (uint32_t i = 0; i < shots; ++i) {
    Ride ride(trial, paper_shot(target, projectile, speed, trial.seed * 1000 + i), outcome);
    if (!ride.good()) return;
    const Sums before = sums_of(ride.stage(), ride.states());
    const Flight flight = fly(ride);
    through += flight.through ? 1 : 0;
    skewered += flight.skewered ? 1 : 0;
    wrong_side += flight.wrong_side ? 1 : 0;
    lost_time += ride.lost_time();
    const Sums after = sums_of(ride.stage(), ride.states());
    energy = fmax(energy, after.energy / before.energy - 1);
    if (target == Target::wall) {
      rebound = fmax(rebound, rebound_error(ride));
    } else {
      momentum = fmax(momentum, length(after.linear - before.linear) / length(before.linear));
    }
  }
  outcome.add("through", through);
  outcome.add("skewered", skewered);
  outcome.add("wrong_side", wrong_side);
  outcome.add("lost_time", lost_time);
  outcome.add("energy_gained", energy);
  if (target == Target::plate) outcome.add("momentum", momentum);
  if (target == Target::wall && projectile == Projectile::ball) outcome.add("rebound", rebound);
}

}  // namespace detent_stress
