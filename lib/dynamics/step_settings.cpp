#include "dynamics/step_settings.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_two_pi = 6.28318530717958647693;

/// `stiffness`: the spring's frequency over the substep rate; `damping_ratio`: of critical damping.
Softness softness(Real stiffness, Real damping_ratio) {
  const Real one = 1.0;
  const Real phase = k_two_pi * stiffness;  // angular frequency x substep
  const Real a1 = scale_by_power(damping_ratio, 1) + phase;
  const Real a2 = phase * a1;
  const Real inverse = reciprocal(one + a2);
  return {unit_from_real(divide(phase, a1), 0), unit_from_real(a2 * inverse, 0), unit_from_real(inverse, 0)};
}

Real real_from(uint32_t count) {
  Real sum = 0.0;
  for (int bit = 0; bit < 8; ++bit) {
    if ((count >> bit & 1) != 0) sum += scale_by_power(Real(1.0), bit);
  }
  return sum;
}

}  // namespace

StepSettings step_settings(const WorldState& world) {
  StepSettings settings;
  settings.substeps = world.substeps;
  settings.iterations = world.iterations;
  settings.tick_time = world.tick_time;
  settings.time = divide(world.tick_time, real_from(world.substeps));
  settings.share = divide(Scaled(1.0), scaled_from(real_from(world.substeps)));
  settings.rate = divide(Scaled(1.0), scaled_from(settings.time));
  settings.relaxation = world.relaxation;
  settings.gravity = world.gravity;
  settings.gravity_size = max(length(world.gravity), Real(1.0));
  settings.restitution_threshold = world.restitution_threshold;
  settings.dynamic_softness = softness(world.stiffness, world.damping_ratio);
  settings.static_softness = softness(scale_by_power(world.stiffness, 1), scale_by_power(world.damping_ratio, -1));
  return settings;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
