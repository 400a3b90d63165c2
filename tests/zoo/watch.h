#pragma once
#include <map>
#include <utility>

#include "tests/zoo/mechanics.h"

/// Watches a scene tick by tick: what it gains, opens, loses.
namespace detent_zoo {

/// A greatest value, and where it was.
struct Worst {
  double value = 0;
  uint32_t tick = 0;
  uint32_t index = 0;  ///< of Frame::joints or Frame::bodies, where it is one's

  void take(double measured, uint32_t at, uint32_t of = 0) {
    if (measured <= value) return;  // what is not a number is taken
    value = measured;
    tick = at;
    index = of;
  }
};

struct Figures {
  Worst gain;  ///< of energy over the least before, less the work done by motors and others, parts of its scale
  Worst loss;  ///< of energy and that work since the start, likewise
  Worst gap;   ///< of joints, over the size of the smaller body
  Worst gap_metres;
  Worst angle;     ///< of joints, rad
  Worst limit;     ///< how far a joint was beyond a limit, rad or m
  Worst lost;      ///< in one tick
  Worst speed;     ///< over what the scene's heights, first speeds and motors explain
  Worst momentum;  ///< change, but by calls, over the sum of the bodies' momenta at first or after calls
  Worst spin;      ///< of angular momentum, likewise
  Worst sunk;      ///< depth that a pair of bodies kept for 10 ticks, over the thickness of the thinner dynamic body
  Worst pierced;   ///< depth of a pair in one tick, likewise
  Worst moved;     ///< of a body's centre since tick 30, over its size
  Worst fallen;    ///< of a body's centre below the height 0, m
  Worst risen;     ///< of a body's centre above where it was at first, m
  double rest_speed = 0, rest_spin = 0;  ///< means over the dynamic bodies at the end, m/s, rad/s
  uint32_t asleep_from = 0;              ///< the tick from which all slept, to the end; 0: they did not
  double substeps_mean = 0;
  uint32_t substeps_max = 0;
  double microseconds = 0;  ///< mean of a tick
  uint32_t ticks = 0;
  uint64_t joints = 0, bodies = 0;
};

/// Energy. `scale`: KE(0) + 0.1 m g L, L the diagonal of what the dynamic bodies span. The work that may have been done
/// since the tick before is
///   a motor's      force_max |speed| dt: it pushes no faster than that;
///   a spring's     force in the middle of the tick times the way, as signed; a drive's damping pushes too;
///   a kinematic's  10 times the weight of all (at least with 9.81 m/s^2) times the speed of its points, dt;
///   a call's       what it changed at once. Forces that last a tick are not known: such a scene needs a bound of its
///   own.
class Watch {
 public:
  explicit Watch(const Frame& start);
  /// Calls changed what was to `after`.
  void calls(const Frame& after);
  void tick(const Frame& now, const StepFigures& step);
  const Figures& figures() const { return figures_; }
  /// The figures, with those of the end.
  Figures finish();

 private:
  void take_energy(const Frame& now);
  void take_joints(const Frame& now);
  void take_speeds(const Frame& now);
  void take_momentum(const Frame& now);
  void take_contacts(const Frame& now);
  void take_places(const Frame& now);
  void widen(const Frame& frame);
  double work(const Frame& now) const;
  double mover_power(const Frame& now) const;

  static constexpr uint32_t k_settled_tick = 30;   ///< what a scene starts with is closed by then
  static constexpr uint32_t k_lasting_ticks = 10;  ///< longer than a blow

  Figures figures_;
  Frame before_, first_, settled_;
  uint32_t tick_ = 0;
  double energy_ = 0, allowed_ = 0, least_ = 0, first_energy_ = 0, scale_ = 0;
  double speed_first_ = 0, span_ = 0, motor_speed_ = 0;
  std::map<std::pair<uint32_t, uint32_t>, std::vector<double>> depths_;  ///< of pairs, in the last ticks
  Vector momentum_, spin_;
  double momentum_scale_ = 0, spin_scale_ = 0;
  uint64_t substeps_ = 0;
  double seconds_ = 0;
};

}  // namespace detent_zoo
