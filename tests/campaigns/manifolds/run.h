#pragma once
#include <functional>

#include "tests/campaigns/manifolds/scene.h"

namespace detent_manifolds {

struct FoundPoint {
  Triple from_a = {};     ///< midway between the surfaces, m, from A's position, world axes
  double separation = 0;  ///< m
  /// Distinct within the contact; on a mesh it includes the plane's key.
  uint64_t feature = 0;
};

/// The library's contact of a pair in one tick.
struct Found {
  Triple normal = {};  ///< from A to B; with several planes, that of the deepest point
  std::vector<FoundPoint> points{};
  bool seam = false, capped = false;
  bool reused = false;  ///< the points were recycled from an earlier tick
};

struct Tick {
  Pose a{}, b{};            ///< as rounded by the configuration
  double distance_max = 0;  ///< m: the contact margin, up to which the pair has contact points
  Found stepped{};          ///< continued from the tick before, as in a step
  Found anew{};             ///< computed without earlier data
};

struct Followed {
  std::string problem{};  ///< why the library refused the pair
  std::vector<Tick> ticks{};
};

struct Engine {
  std::string config;
  std::function<Followed(const Scene& scene)> follow;
};

}  // namespace detent_manifolds
