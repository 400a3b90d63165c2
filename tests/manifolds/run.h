#pragma once
#include <functional>

#include "tests/manifolds/scene.h"

namespace detent_manifolds {

struct FoundPoint {
  Triple from_a = {};     ///< midway between the surfaces, m, from A's position, world axes
  double separation = 0;  ///< m
  uint64_t feature = 0;   ///< distinct within the contact; with the plane's key on a mesh
};

/// What the library says of a pair in one tick.
struct Found {
  Triple normal = {};  ///< from A to B; of several planes the deepest point's
  std::vector<FoundPoint> points{};
  bool seam = false, capped = false;
  bool reused = false;  ///< the points are those of an earlier tick, moved along
};

struct Tick {
  Pose a{}, b{};     ///< as the configuration holds them
  double reach = 0;  ///< m: how far apart they have contact points
  Found stepped{};   ///< as a step goes on from the tick before
  Found anew{};      ///< from nothing
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
