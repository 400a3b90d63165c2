#pragma once
#include "tests/campaigns/joint_fuzz/run.h"

/// The result of a scene: whether it gained energy, and how far its joints came apart.
namespace detent_joint_fuzz {

struct Verdict {
  uint64_t seed = 0;
  Kind kind = Kind::pair;
  bool gravity = false;
  std::string types;  ///< the type of its joints, or "mixed"
  uint32_t bodies = 0, joints = 0, ticks = 0;
  double mass_ratio = 1, tip_speed = 0, arm_ratio = 0;  ///< properties of the scene, as in lines_of()
  /// Greatest energy above that at the start plus the drives' work, relative to the scale.
  double growth = 0;
  /// Greatest energy above the least so far plus the drives' work since then, relative to the scale.
  double rise = 0;
  uint32_t grown_at = 0;     ///< the first tick above k_growth_max, or 0
  bool finite = true;        ///< all states are numbers
  uint64_t saturations = 0;  ///< components clamped
  uint64_t undecided = 0;    ///< StepReport::joints.undecided
  Gap gap;                   ///< the greatest after the first half second
  double substeps = 0;       ///< mean over the ticks
  double nanoseconds = 0;    ///< processor time in step()
  std::string problem;       ///< why the scene was refused

  bool grows() const;
  bool grows_tenfold() const { return !finite || growth > 9; }
  /// Whether it gains energy although no number was clamped.
  bool is_silent() const { return grows() && saturations == 0; }
};
inline constexpr double k_growth_max = 0.01;

/// A tick of a run, passed to Watch.
struct Moment {
  uint32_t tick = 0;
  double energy = 0;  ///< J
  double given = 0;   ///< J, upper bound of the drives' work so far
  double scale = 0;   ///< J
  Gap gap;
  Counts counts;
};
using Watch = std::function<void(const Moment&)>;

/// The condition that ends a run.
struct Stop {
  uint32_t ticks = 600;     ///< after this many ticks
  bool when_grown = false;  ///< also at the first growth
};

/// Plays a scene; calls `watch` for each tick.
Verdict play(const Scene& scene, const Engine& engine, const Settings& settings, const Stop& stop,
             const Watch& watch = {});

}  // namespace detent_joint_fuzz
