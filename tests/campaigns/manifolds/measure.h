#pragma once
#include <functional>

#include "tests/campaigns/manifolds/run.h"

namespace detent_manifolds {

/// The measures of a contact in a tick. 0 is the best value of each.
enum class Measure : uint32_t {
  /// Error of the deepest point's depth against the least translation that separates the solids, over the thinner one's
  /// thickness.
  depth,
  /// Error of a point's separation against the solids' gap at its place, over the thickness, if either of them is a
  /// contact.
  point,
  /// How far the true patch extends beyond the outline of the points, over the smaller solid's size.
  loss,
  /// As `loss`, for solids farther apart than a 256th of the thickness; `loss` excludes these.
  parted,
  uncovered,  ///< fraction of the true patch's area outside the outline of the points
  /// How far a point lies outside the region where the solids are within the contact margin, over the size.
  outside,
  /// Support lost or gained in a tick, beyond the motion and the change of the true patch, over the size.
  jump,
  /// Distance of the outline of recycled points from that of newly computed points, over the size.
  stale,
  seam,  ///< as `depth`, for a contact at a seam, which has no other measures
};
inline constexpr uint32_t k_measures = 9;
const char* name_of(Measure measure);

/// For one point: its distance outside the region where the solids are within the contact margin, m, and the gap there,
/// m, or NaN.
struct PointReading {
  double outside, gap;
};

/// The readings of one tick; NaN if not measured.
struct Reading {
  double value[k_measures];
  double gap = 0;         ///< m, between the solids
  double patch_area = 0;  ///< m^2
  Arrow normal{};         ///< of the least translation, from A to B, A's axes
  std::vector<PointReading> points{};
  /// No points although the solids are within 0.9 of the contact margin, and not because of a seam.
  bool lost = false;
  bool idle = false;  ///< points although the solids are beyond the contact margin
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
  /// For pairs that only the last bit disturbs: the number of point names, and of those that existed in the tick
  /// before; with the data of earlier ticks, and computed anew.
  uint32_t names = 0, names_kept = 0, names_anew = 0, names_anew_kept = 0;
  uint32_t most_points = 0;
};

using Visit = std::function<void(uint32_t tick, const Tick&, const Reading&)>;

Verdict judge(const Scene& scene, const Followed& followed, const Visit& visit = nullptr);

}  // namespace detent_manifolds
