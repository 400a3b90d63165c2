#pragma once
#include <detent/contact.h>
#include <detent/detail/state.h>

#include "base/team.h"
#include "math/arithmetic.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Softness of a contact. A contact is a damped spring, solved implicitly. In islands without joints, the frequency of
/// the spring is a fixed fraction of the substep rate, so the members do not depend on the length of the substep. In
/// islands with joints, they depend on it (k_jointed_stiffness).
/// Source: Catto, "Soft Constraints", GDC 2011.
struct Softness {
  Unit rate;           ///< fraction of the overlap that is corrected in a substep
  Unit spring_eighth;  ///< softness of a row / (8 K), where K is the row's response to a unit impulse
};

/// The world's settings in the form that the stages use, derived once per step.
struct StepSettings {
  uint32_t substeps_fixed;  ///< 0: the step chooses the number for each island
  uint32_t substeps_max;
  /// (n / w)^2, s^2, with the number of substeps n and the angular frequency w, rad/s, of contacts between dynamic
  /// bodies. It does not depend on n, because w is proportional to n.
  Scaled substeps_per_rate;
  Scaled resting_penetration;  ///< depth to which a contact at rest may sink / extent of the smaller body
  uint32_t iterations;
  uint32_t convergence;
  bool post_stabilises;
  bool sleeping;
  bool continuous;  ///< continuous collision is on
  /// The most contacts that are solved at once (World::lanes): 1, 4 or 8. The results do not depend on this.
  uint32_t lanes;
#if DETENT_TASKS
  Team* team;  ///< the threads that share loops; null: none. The results do not depend on this.
#else
  static constexpr Team* team = nullptr;
#endif
  Real tick_time;          ///< s
  Real contact_frequency;  ///< WorldDef::contact_frequency
  Real damping_ratio;      ///< WorldDef::damping_ratio
  uint32_t substeps;       ///< per tick; set_substeps() sets this member and those up to static_softness
  bool jointed;            ///< the island has joints
  Real time;               ///< length of a substep, s
  Scaled rate;             ///< substeps per second
  Scaled share;            ///< length of a substep / length of a tick
  Unit rate_mantissa;      ///< rate = rate_mantissa 2^rate_exponent
  int32_t rate_exponent;
  /// The gap, m, that a speed of 2^15 m/s closes in a substep.
  Real gap_max;
  Softness dynamic_softness;  ///< contacts between two dynamic bodies
  Softness static_softness;   ///< all other contacts: twice the frequency and a lower damping ratio
  Unit relaxation;
  Vec3<Real> gravity;  ///< m/s^2
  /// Magnitude of gravity, m/s^2, but at least 1. Used to derive limits of speeds.
  Real gravity_size;
  Real restitution_threshold;
  ManifoldReduction reduction;
  /// Approximate depth, m, to which a resting body sinks into its support: gravity_size x tick_time^2 / 4.
  Real sunk;
  /// Contact margin, as a fraction of the smaller body's extent.
  Real contact_margin;
  /// Greatest relative motion of a pair at which its contact points are recycled, as a fraction of the smaller body's
  /// extent; 0: contact points are found anew in each tick.
  Real contact_recycle_distance;
};

/// Contacts of an island with joints are at least as stiff as contacts of an island without joints that takes this
/// number of substeps.
inline constexpr uint32_t k_jointed_stiffness = 24;

StepSettings step_settings(const WorldState& world);
/// Returns the settings with `team` as the threads that share loops (StepSettings::team).
#if DETENT_TASKS
inline StepSettings shared_settings(const StepSettings& settings, Team* team) {
  StepSettings shared = settings;
  shared.team = team;
  return shared;
}
#else
inline const StepSettings& shared_settings(const StepSettings& settings, Team*) { return settings; }
#endif
/// The speed, m/s, that covers `length`, m, in a substep. Overflow: clamps to +-2^15 m/s.
inline Real speed_over(const StepSettings& settings, Real length) {
  return scale_by_power(clamp(length, -settings.gap_max, settings.gap_max) * settings.rate_mantissa,
                        settings.rate_exponent);
}
/// sqrt(g extent), m/s, with g at least 1 m/s^2: the speed after a fall from rest by half of `extent`, m. The limits of
/// speed in the solver are multiples of this speed. Range: extent <= 2^15 m.
Real fall_speed(const StepSettings& settings, Real extent);
/// Sets the settings that depend on the number of substeps, and on whether the island has joints. Range of `substeps`:
/// 1 to 64.
void set_substeps(uint32_t substeps, bool jointed, StepSettings& settings);
/// Converts a count, clamped to 2^17 - 1, to a Scaled.
Scaled scaled_from_count(uint32_t count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
