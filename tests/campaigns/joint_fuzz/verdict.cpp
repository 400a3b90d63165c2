#include "tests/campaigns/joint_fuzz/verdict.h"

#include <math.h>
#include <time.h>

#include <algorithm>

#include "tests/campaigns/joint_fuzz/turn.h"

namespace detent_joint_fuzz {

namespace {

/// the gaps in the first ticks come from velocities that do not fit the joints
constexpr uint32_t k_settling_ticks = 30;
constexpr double k_tick = 1.0 / 60;  ///< s

double processor_nanoseconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

void describe(const Scene& scene, Verdict& verdict) {
  double least = INFINITY, most = 0;
  for (const SceneBody& body : scene.bodies) {
    if (body.fixed) continue;
    least = fmin(least, body.mass);
    most = fmax(most, body.mass);
  }
  verdict.mass_ratio = most / least;
  const auto take = [&](const SceneBody& body, const Triple& anchor) {
    if (body.fixed) return;
    const double arm = length(anchor);
    verdict.tip_speed = fmax(verdict.tip_speed, length(body.linear_velocity) + length(body.angular_velocity) * arm);
    verdict.arm_ratio = fmax(verdict.arm_ratio, arm / *std::max_element(body.size.begin(), body.size.end()));
  };
  for (const SceneJoint& joint : scene.joints) {
    take(scene.bodies[joint.a], joint.anchor_a);
    take(scene.bodies[joint.b], joint.anchor_b);
  }
}

/// The velocities of bodies with joints are those in the middle of the last substep. The number of substeps is known if
/// there is one island.
double lag_of(const Counts& counts) {
  return counts.islands == 1 && counts.substeps_max != 0 ? k_tick / (2 * counts.substeps_max) : 0;
}

}  // namespace

bool Verdict::grows() const { return !finite || growth > k_growth_max; }

Verdict play(const Scene& scene, const Engine& engine, const Settings& settings, const Stop& stop, const Watch& watch) {
  Verdict verdict;
  verdict.seed = scene.seed;
  verdict.kind = scene.kind;
  verdict.gravity = scene.gravity > 0;
  verdict.types = types_of(scene);
  verdict.bodies = static_cast<uint32_t>(scene.bodies.size());
  verdict.joints = static_cast<uint32_t>(scene.joints.size());
  describe(scene, verdict);
  const std::unique_ptr<Run> run = engine.make(scene, settings, verdict.problem);
  if (run == nullptr) return verdict;
  const std::vector<Inertia> inertia = run->inertia();
  States states;
  run->states(states);
  const States first = states;
  const double scale = scale_of(scene, inertia, states), start = energy_of(scene, inertia, states);
  // The energy that grows is the lesser of two: with the heights at the end of the tick it fluctuates in a swing, and
  // with those at the time of the velocities it jumps when the number of substeps changes in a fall.
  double starts[2] = {start, start}, least[2] = {start, start};
  double given = 0, power = power_max(scene, states);
  if (watch) watch({0, start, 0, scale, greatest_gap(scene, states), {}});
  for (uint32_t tick = 1; tick <= stop.ticks; ++tick) {
    const double before = processor_nanoseconds();
    const Counts counts = run->step();
    verdict.nanoseconds += processor_nanoseconds() - before;
    run->states(states);
    if (tick == 1) starts[1] = least[1] = energy_of(scene, inertia, first, lag_of(counts));
    const double energy = energy_of(scene, inertia, states), power_now = power_max(scene, states);
    given += std::max(power, power_now) * k_tick;
    power = power_now;
    const Gap gap = greatest_gap(scene, states);
    verdict.saturations += counts.saturations;
    verdict.undecided += counts.joint_decisions_left;
    verdict.substeps += counts.substeps_max;
    if (!isfinite(energy)) verdict.finite = false;
    const double own[2] = {energy - given, energy_of(scene, inertia, states, lag_of(counts)) - given};
    verdict.growth = fmax(verdict.growth, fmin(own[0] - starts[0], own[1] - starts[1]) / scale);
    verdict.rise = fmax(verdict.rise, fmin(own[0] - least[0], own[1] - least[1]) / scale);
    for (int i = 0; i < 2; ++i) least[i] = fmin(least[i], own[i]);
    if (verdict.grown_at == 0 && verdict.grows()) verdict.grown_at = tick;
    if (tick > k_settling_ticks) {
      verdict.gap.length = fmax(verdict.gap.length, gap.length);
      verdict.gap.angle = fmax(verdict.gap.angle, gap.angle);
    }
    verdict.ticks = tick;
    if (watch) watch({tick, energy, given, scale, gap, counts});
    if (stop.when_grown && verdict.grown_at != 0) break;
  }
  verdict.substeps /= std::max(verdict.ticks, 1u);
  return verdict;
}

}  // namespace detent_joint_fuzz
