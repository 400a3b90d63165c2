#pragma once
#include <algorithm>
#include <vector>

#include "tests/common/oracle/convex_solid.h"

/// Convex polygons in a plane, for the oracle of contact patches.
namespace detent_oracle {

struct Spot {
  Number u, v;
};
inline Spot operator-(const Spot& a, const Spot& b) { return {a.u - b.u, a.v - b.v}; }
inline Number cross(const Spot& a, const Spot& b) { return a.u * b.v - a.v * b.u; }

/// Corners, counter-clockwise; one or two of what has no area.
using Polygon = std::vector<Spot>;

/// Keeps what has across.spot <= limit.
inline void cut(Polygon& polygon, const Spot& across, Number limit) {
  const auto beyond = [&](const Spot& p) { return across.u * p.u + across.v * p.v - limit; };
  if (std::all_of(polygon.begin(), polygon.end(), [&](const Spot& p) { return beyond(p) <= 0; })) return;
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Spot &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Number at_p = beyond(p), at_q = beyond(q);
    if (at_p <= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
      const Number t = at_p / (at_p - at_q);
      kept.push_back({p.u + (q.u - p.u) * t, p.v + (q.v - p.v) * t});
    }
  }
  polygon = kept;
}

inline Polygon outline_of(std::vector<Spot> spots) {
  std::sort(spots.begin(), spots.end(),
            [](const Spot& a, const Spot& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); });
  if (spots.size() < 3) return spots;
  Polygon outline;
  for (int side = 0; side < 2; ++side) {
    const size_t first = outline.size();
    for (const Spot& spot : spots) {
      while (outline.size() >= first + 2 &&
             cross(outline.back() - outline[outline.size() - 2], spot - outline.back()) <= 0)
        outline.pop_back();
      outline.push_back(spot);
    }
    outline.pop_back();  // it starts the other side
    std::reverse(spots.begin(), spots.end());
  }
  if (outline.empty()) outline.push_back(spots[0]);
  return outline;
}

inline Number area_of(const Polygon& polygon) {
  Number twice = 0;
  for (size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2;
}

inline Polygon overlap_of(Polygon polygon, const Polygon& other) {
  if (other.size() < 3) return {};
  for (size_t i = 0; i < other.size() && !polygon.empty(); ++i) {
    const Spot displacement = other[(i + 1) % other.size()] - other[i], across = {displacement.v, -displacement.u};
    cut(polygon, across, across.u * other[i].u + across.v * other[i].v);
  }
  return polygon;
}

/// The nearest place of the polygon, which has a corner: the spot itself inside.
inline Spot nearest_in(const Polygon& polygon, const Spot& spot) {
  bool inside = polygon.size() > 2;
  Spot best = polygon[0];
  Number least = HUGE_VALL;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Spot displacement = polygon[(i + 1) % polygon.size()] - polygon[i], to = spot - polygon[i];
    inside = inside && cross(displacement, to) >= 0;
    const Number square = displacement.u * displacement.u + displacement.v * displacement.v;
    const Number part =
        square > 0 ? std::clamp((displacement.u * to.u + displacement.v * to.v) / square, 0.0L, 1.0L) : 0;
    const Spot place = {polygon[i].u + displacement.u * part, polygon[i].v + displacement.v * part};
    const Number distance = hypotl(spot.u - place.u, spot.v - place.v);
    if (distance >= least) continue;
    least = distance;
    best = place;
  }
  return inside ? spot : best;
}
/// How far a spot lies outside; 0 inside.
inline Number distance_beyond(const Polygon& polygon, const Spot& spot) {
  const Spot nearest = nearest_in(polygon, spot);
  return hypotl(nearest.u - spot.u, nearest.v - spot.v);
}

/// How far it reaches along a unit direction.
inline Number reach_along(const Polygon& polygon, const Spot& direction) {
  Number most = -HUGE_VALL;
  for (const Spot& p : polygon) most = std::max(most, p.u * direction.u + p.v * direction.v);
  return most;
}

}  // namespace detent_oracle
