#include "motion/step_settings.h"

#include <detent/world.h>

#include "math/root.h"
#include "motion/block.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Factors by which WorldDef::damping_ratio is multiplied: for contacts between two dynamic bodies, and for all other
/// contacts.
constexpr Unit k_dynamic_damping = 0.7, k_static_damping = 0.5;

/// The largest ratio of the softness of a contact's row to the row's response to a unit impulse. Contacts with softer
/// settings are made stiffer.
constexpr Real k_contact_softness_max = 15.0;

/// Computes a Softness. `contact_frequency`: frequency of the spring / substep rate. `damping_ratio`: 1 is critical.
Softness softness(Real contact_frequency, Real damping_ratio) {
  const Real phase = k_two_pi * contact_frequency;  // angular frequency x substep
  const Real a1 = scale_by_power(damping_ratio, 1) + phase;
  const Real a2 = phase * a1;
  return {fine(unit_from_real(divide(phase, a1), 0)),
          fine(unit_from_real(min(reciprocal(a2), k_contact_softness_max), 3))};
}

/// The least e with a < 2^e. Range: a > 0.
int exponent_of(Scaled a) {
#if DETENT_FIXED
  return a.exponent + 31;
#else
  return exponent_above(a);
#endif
}

Real real_from(uint32_t count) {
  Real sum = 0.0;
  for (int bit = 0; bit < 17; ++bit) {
    if ((count >> bit & 1) != 0) sum += scale_by_power(Real(1.0), bit);
  }
  return sum;
}

}  // namespace

StepSettings step_settings(const WorldState& world) {
  StepSettings settings;
  settings.substeps_fixed = world.substeps;
  settings.substeps_max = world.substeps_max;
  settings.iterations = world.iterations;
  settings.tick_time = world.tick_time;
  settings.sleeping = world.sleeping != 0;
  settings.continuous = world.continuous != 0;
  settings.lanes = 1;
#if DETENT_TASKS
  settings.team = nullptr;
#endif
  const Scaled rate = divide(scaled_from(world.tick_time), scaled_from(k_two_pi * world.contact_frequency));
  settings.substeps_per_rate = multiply(rate, rate);
  settings.resting_penetration = scaled_from(world.resting_penetration);
  settings.relaxation = fine(unit_from_real(world.relaxation, 0));
  settings.gravity = world.gravity;
  settings.gravity_size = max(length(world.gravity), Real(1.0));
  settings.sunk = scale_by_power(settings.gravity_size * settings.tick_time * settings.tick_time, -2);
  settings.restitution_threshold = world.restitution_threshold;
  settings.contact_margin = world.contact_margin;
  settings.contact_recycle_distance = world.contact_recycle_distance;
  settings.reduction = static_cast<ManifoldReduction>(world.reduction);
  settings.convergence = world.convergence;
  settings.post_stabilises = static_cast<Stabilisation>(world.stabilisation) == Stabilisation::post;
  settings.contact_frequency = world.contact_frequency;
  settings.damping_ratio = world.damping_ratio;
  set_substeps(world.substeps == 0 ? 1 : world.substeps, false, settings);
  return settings;
}

Real fall_speed(const StepSettings& settings, Real extent) {
  return scale_by_power(square_root(scale_by_power(settings.gravity_size, -10) * extent), 5);
}

void set_substeps(uint32_t substeps, bool jointed, StepSettings& settings) {
  settings.substeps = substeps;
  settings.jointed = jointed;
  const Real count = real_from(substeps);
  settings.time = divide(settings.tick_time, count);
  settings.share = divide(Scaled(1.0), scaled_from_count(substeps));
  settings.rate = divide(Scaled(1.0), scaled_from(settings.time));
  settings.gap_max = settings.time * Real(32768.0);
  settings.rate_exponent = exponent_of(settings.rate);
  settings.rate_mantissa = fine(to_unit(scaled_by_power(settings.rate, -settings.rate_exponent)));
  if (settings.post_stabilises) {
    settings.dynamic_softness = settings.static_softness = {Unit(0.0), Unit(1.0 / 256)};
    return;
  }
  Real frequency = settings.contact_frequency;
  if (jointed && substeps < k_jointed_stiffness)
    frequency = frequency * divide(Real(double{k_jointed_stiffness}), count);
  settings.dynamic_softness = softness(frequency, settings.damping_ratio * k_dynamic_damping);
  settings.static_softness = softness(scale_by_power(frequency, 1), settings.damping_ratio * k_static_damping);
}

Scaled scaled_from_count(uint32_t count) {
  constexpr uint32_t k_most = (1u << 17) - 1;
  return scaled_from(real_from(count < k_most ? count : k_most));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
