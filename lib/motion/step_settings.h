#pragma once
#include <detent/detail/state.h>
#include <detent/reduction.h>

#include "math/arithmetic.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Softness of a contact: a damped spring solved implicitly, in numbers that do not depend on the substep's length.
/// Source: Catto, "Soft Constraints", GDC 2011.
struct Softness {
  Unit rate;           ///< share of the overlap corrected in a substep
  Unit mass_scale;     ///< of the effective mass
  Unit impulse_scale;  ///< share of the accumulated impulse that the spring gives back
};

/// The world's settings as the stages use them, derived once a step.
struct StepSettings {
  uint32_t substeps_fixed;  ///< 0: each island has its own
  uint32_t substeps_max;
  Scaled substeps_per_rate;  ///< (substeps / contact frequency, rad/s)^2: of contacts between dynamic bodies, s^2
  uint32_t iterations;
  uint32_t convergence;
  bool post_stabilises;
  bool sleeping;
  bool continuous;     ///< impacts are looked for
  bool quads;          ///< four contacts at once where they may; the caller's choice, of no consequence for the result
  Real tick_time;      ///< s
  uint32_t substeps;   ///< as set_substeps() has it, like the next three
  Real time;           ///< of a substep, s
  Scaled rate;         ///< substeps a second
  Scaled share;        ///< of a tick that a substep is
  Unit rate_mantissa;  ///< rate = rate_mantissa 2^rate_exponent
  int32_t rate_exponent;
  Real gap_max;  ///< what a speed of 2^15 m/s closes in a substep, m
  Unit relaxation;
  Vec3<Real> gravity;  ///< m/s^2
  Real gravity_size;   ///< m/s^2, at least 1: what speeds are measured against
  Real restitution_threshold;
  ManifoldReduction reduction;
  Real sunk;                  ///< how deep what rests is sunk in, about: a quarter of what gravity moves in a tick, m
  Real breaking;              ///< of the smaller extent, like the next one
  Real reuse;                 ///< 0: contact points are found anew in each tick
  Softness dynamic_softness;  ///< of contacts between two dynamic bodies
  Softness static_softness;   ///< of contacts with anything else: twice as stiff, less damped
};

StepSettings step_settings(const WorldState& world);
/// A length that is made up for in a substep, as a speed, m/s; held to +-2^15 m/s.
inline Real speed_over(const StepSettings& settings, Real length) {
  return scale_by_power(clamp(length, -settings.gap_max, settings.gap_max) * settings.rate_mantissa,
                        settings.rate_exponent);
}
/// The speed of a fall by `extent`, m/s: what speeds are measured against. Range: extent <= 2^15 m.
Real fall_speed(const StepSettings& settings, Real extent);
/// Makes them those of an island of so many substeps. Range: [1, 64].
void set_substeps(uint32_t substeps, StepSettings& settings);
/// Held to 2^17 - 1.
Scaled scaled_from_count(uint32_t count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
