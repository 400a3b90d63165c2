#pragma once
#include "tests/common/oracle/polygon.h"

/// Where two convex solids face each other: how far apart they are over each place across a normal, and the patch where
/// that is no more than a level. Both follow from what the solids are, not from features: the gap over a place is a
/// convex function, so a patch is a convex polygon. In `long double`; nothing is shared with the library.
namespace detent_oracle {

struct FacePlane {
  Arrow normal;  ///< outward, of length 1
  Number limit;  ///< normal.p of its points
};

/// A solid and the planes of its core's faces, all in its own frame.
class FacedSolid {
 public:
  explicit FacedSolid(const ConvexSolid& solid);

  const ConvexSolid& solid() const { return solid_; }
  /// Planes that hold the core. Round sides are tangents, closer to each other towards `direction`: beside the line
  /// that touches there they are a fiftieth of what the side rises too low at most, elsewhere 0.2 % of the radius too
  /// far out. A core that is a point or a rod is grown by 1e-7 of its size.
  std::vector<FacePlane> planes(const Arrow& direction) const;
  /// From where to where p + s direction lies in the solid, for a unit direction; false if it misses.
  bool span(const Arrow& p, const Arrow& direction, Number& from, Number& to) const;

 private:
  ConvexSolid solid_;
  std::vector<FacePlane> faces_{};  ///< of a polytope
};

/// Seen from A's position, world axes.
struct Patch {
  Arrow u = {}, v = {}, normal = {};  ///< from A to B
  Polygon outline{};                  ///< in u and v
  Spot spot(const Arrow& p) const { return {dot(u, p), dot(v, p)}; }
};

/// Where B's surface is no farther above A's than `level`, m, along a unit normal from A to B. Of solids that are
/// rounded by a ball it is the patch of their cores: a ball touches in a point, a capsule along a line. Empty if there
/// is none.
Patch patch_of(const FacedSolid& a, const FacedSolid& b, const Placement& placement, const Arrow& normal, Number level);

/// How far apart the surfaces are on the line through p along the normal: negative where they overlap. False if the
/// line misses a solid.
bool gap_over(const FacedSolid& a, const FacedSolid& b, const Placement& placement, const Arrow& normal, const Arrow& p,
              Number& gap);

}  // namespace detent_oracle
