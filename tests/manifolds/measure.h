#pragma once
#include <functional>

#include "tests/manifolds/run.h"

namespace detent_manifolds {

/// What is measured of a contact in a tick. Each is 0 at best.
enum class Measure : uint32_t {
  depth,      ///< the deepest point's depth less the least that parts the solids, over the thinner one's thickness
  point,      ///< a point's separation less the gap of the solids over its place, likewise, where one says they touch
  loss,       ///< how far the true patch reaches beyond the outline of the points, over the smaller one's size
  parted,     ///< likewise of solids that are farther apart than a 256th of the thickness: the loss of no other is here
  uncovered,  ///< the part of the true patch's area that the outline of the points does not cover
  outside,    ///< how far a point lies beyond where the solids are within reach of each other, over the size
  jump,   ///< how far support was lost or won in a tick beyond the motion and what the true patch did, over the size
  stale,  ///< how far the outline of points used again is from that of points found anew, over the size
  seam,   ///< as `depth`, where the contact is that of a seam: what else is measured is not, there
};
inline constexpr uint32_t k_measures = 9;
const char* name_of(Measure measure);

/// Of a point: how far beyond where the solids are within reach of each other it lies, m, and the gap there, m, or NaN.
struct PointReading {
  double outside, gap;
};

/// Of one tick; NaN for what is not there.
struct Reading {
  double value[k_measures];
  double gap = 0;         ///< m, of the solids
  double patch_area = 0;  ///< m^2
  Arrow normal{};         ///< of the least translation, from A to B, A's axes
  std::vector<PointReading> points{};
  bool lost = false;  ///< no points though the solids are within 0.9 of the reach, and no seam is why
  bool idle = false;  ///< points though the solids are farther apart
};

struct Worst {
  double value = 0;
  uint32_t tick = 0;
};

struct Verdict {
  uint64_t seed = 0;
  Kind kind = Kind::aligned;
  Motion motion = Motion::still;
  std::string shapes{}, problem{};
  Worst worst[k_measures] = {};
  bool measured[k_measures] = {};  ///< in some tick
  uint32_t ticks = 0, reused = 0, lost = 0, idle = 0, seams = 0, capped = 0;
  /// Of pairs that only the last bit disturbs: names of points, and how many of them were there in the tick before;
  /// as a step goes on, and found from nothing.
  uint32_t names = 0, names_kept = 0, names_anew = 0, names_anew_kept = 0;
  uint32_t most_points = 0;
};

using Visit = std::function<void(uint32_t tick, const Tick&, const Reading&)>;

Verdict judge(const Scene& scene, const Followed& followed, const Visit& visit = nullptr);

}  // namespace detent_manifolds
