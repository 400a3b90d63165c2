#pragma once
#include <map>
#include <utility>

#include "tests/campaigns/zoo/mechanics.h"

/// Measures a scene tick by tick: energy gains, gaps, overflow counts and more.
namespace detent_zoo {

/// A greatest value, and its place.
struct Worst {
  double value = 0;
  uint32_t tick = 0;
  uint32_t index = 0;  ///< of the joint or body that was measured, if any

  void take(double measured, uint32_t at, uint32_t of = 0) {
    if (measured <= value) return;  // NaN is taken too
    value = measured;
    tick = at;
    index = of;
  }
};

struct Figures {
  /// Energy above the least before, less the work of motors and other sources, relative to its scale.
  Worst gain;
  /// Energy lost since the start, including that work, relative to its scale.
  Worst loss;
  Worst gap;  ///< of joints, relative to the smaller body's size
  Worst gap_metres;
  Worst angle;                 ///< of joints, rad
  Worst limit;                 ///< greatest excess of a joint beyond a limit, rad or m
  Worst lost;                  ///< in one tick
  const char* lost_most = "";  ///< the greatest of the counts in `lost`
  Worst speed;                 ///< over the speed that the scene's heights, first speeds and motors explain
  /// Change without calls, relative to the sum of the bodies' momenta at the start or after calls.
  Worst momentum;
  Worst angular_momentum;  ///< of angular momentum, as `momentum`
  /// Depth of a pair that lasts for 10 ticks, relative to the thickness of the thinner dynamic body.
  Worst sunk;
  Worst pierced;         ///< depth of a pair in one tick, relative to the same thickness
  Worst moved;           ///< displacement of a body's centre since tick 30, relative to its size
  Worst fallen;          ///< of a body's centre below the height 0, m
  Worst risen;           ///< of a body's centre above its start, m
  Worst impacts, tests;  ///< of continuous collision, in one tick
  double rest_speed = 0, rest_angular_velocity = 0;  ///< means over the dynamic bodies at the end, m/s, rad/s
  uint32_t asleep_from = 0;                          ///< the tick from which all slept to the end; 0: not all
  double substeps_mean = 0;
  uint32_t substeps_max = 0;
  double microseconds = 0;  ///< mean over the ticks
  uint32_t ticks = 0;
  uint64_t joints = 0, bodies = 0;
};

/// Measures a scene. The scale of its energy is KE(0) + 0.1 m g L; L is the diagonal of the dynamic bodies' extent.
/// The work that may have been done since the tick before is
///   a motor's      force_max |speed| dt: it does not push faster than that;
///   a spring's     force in the middle of the tick times the displacement, signed; a drive's damping does work too;
///   a kinematic's  10 times the weight of all (at least with 9.81 m/s^2) times the speed of its points, dt;
///   a call's       its immediate change. Forces that act during a tick are unknown: such a scene needs a bound of its
///   own.
class Watch {
 public:
  explicit Watch(const Frame& start);
  /// Calls changed the state to `after`.
  void calls(const Frame& after);
  void tick(const Frame& now, const StepFigures& step);
  const Figures& figures() const { return figures_; }
  /// The figures, including those of the end.
  Figures finish();

 private:
  void take_energy(const Frame& now, double lag);
  void take_joints(const Frame& now);
  void take_speeds(const Frame& now);
  void take_momentum(const Frame& now);
  void take_contacts(const Frame& now);
  void take_places(const Frame& now);
  void widen(const Frame& frame);
  double work(const Frame& now) const;
  double mover_power(const Frame& now) const;

  static constexpr uint32_t k_settled_tick = 30;   ///< the errors of a scene's start are corrected by then
  static constexpr uint32_t k_lasting_ticks = 10;  ///< longer than an impact

  Figures figures_;
  Frame before_, first_, settled_;
  uint32_t tick_ = 0;
  double energy_ = 0, allowed_ = 0, least_ = 0, first_energy_ = 0, scale_ = 0;
  double speed_first_ = 0, span_ = 0, motor_speed_ = 0;
  std::map<std::pair<uint32_t, uint32_t>, std::vector<double>> depths_;  ///< of pairs, in the last ticks
  Vector momentum_, angular_momentum_;
  double momentum_scale_ = 0, angular_momentum_scale_ = 0;
  uint64_t substeps_ = 0;
  double seconds_ = 0;
};

}  // namespace detent_zoo
