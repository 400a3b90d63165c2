#pragma once
#include "tests/joint_fuzz/run.h"

/// What became of a scene: whether it gained energy, and how far its joints came apart.
namespace detent_joint_fuzz {

struct Verdict {
  uint64_t seed = 0;
  Kind kind = Kind::pair;
  bool gravity = false;
  std::string types;  ///< of its joints: the one, or mixed
  uint32_t bodies = 0, joints = 0, ticks = 0;
  double mass_ratio = 1, tip_speed = 0, arm_ratio = 0;  ///< of the scene (lines_of)
  double growth = 0;         ///< most energy beyond that of the start and what drives may give, of the scale
  double rise = 0;           ///< most energy beyond the least so far and what drives gave since, of the scale
  uint32_t grown_at = 0;     ///< the first tick with more than k_growth_max, or 0
  bool finite = true;        ///< all states are numbers
  uint64_t saturations = 0;  ///< components clamped
  uint64_t undecided = 0;    ///< StepReport::joint_decisions_left
  Gap gap;                   ///< the greatest after the first half second
  double substeps = 0;       ///< a tick, mean
  double nanoseconds = 0;    ///< of processor time in step()
  std::string problem;       ///< why the scene was refused

  bool grows() const;
  bool grows_tenfold() const { return !finite || growth > 9; }
  /// It grows, and no report says that anything was clamped.
  bool is_silent() const { return grows() && saturations == 0; }
};
inline constexpr double k_growth_max = 0.01;

/// A tick of a run, for whoever follows it.
struct Moment {
  uint32_t tick = 0;
  double energy = 0;  ///< J
  double given = 0;   ///< J, by drives at most, so far
  double scale = 0;   ///< J
  Gap gap;
  Counts counts;
};
using Watch = std::function<void(const Moment&)>;

/// When the play of a scene ends.
struct Stop {
  uint32_t ticks = 600;     ///< after so many
  bool when_grown = false;  ///< or at its first growth
};

/// Plays a scene; `watch` is told of each tick.
Verdict play(const Scene& scene, const Engine& engine, const Settings& settings, const Stop& stop,
             const Watch& watch = {});

}  // namespace detent_joint_fuzz
