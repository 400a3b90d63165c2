#pragma once
#include <detent/detail/state.h>

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
  uint32_t substeps;
  uint32_t iterations;
  Real tick_time;  ///< s
  Real time;       ///< of a substep, s
  Scaled rate;     ///< substeps a second
  Scaled share;    ///< of a tick that a substep is
  Real relaxation;
  Vec3<Real> gravity;  ///< m/s^2
  Real gravity_size;   ///< m/s^2, at least 1: what speeds are measured against
  Real restitution_threshold;
  Softness dynamic_softness;  ///< of contacts between two dynamic bodies
  Softness static_softness;   ///< of contacts with anything else: twice as stiff, half as damped
};

StepSettings step_settings(const WorldState& world);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
