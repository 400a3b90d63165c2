#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Finds when shapes that move with two bodies collide, one pair of shapes after another. Values that do not depend on
/// the shapes are computed once. The rotations are computed only if the bounding spheres of a pair touch during the
/// motion.
class MovingShapes {
 public:
  MovingShapes(const Motion& a, const Motion& b) : motion_a_(a), motion_b_(b) {}
  MovingShapes(const MovingShapes&) = delete;
  MovingShapes& operator=(const MovingShapes&) = delete;

  /// Finds the time of impact of two shapes, as time_of_impact() does, but with less work if the shapes stay apart.
  /// Both shapes must be in the frames of their bodies. `axis`: a direction from A to B that may separate the shapes,
  /// or zero; it saves work and does not change the outcome. `until`: a fraction of the motion; an impact after it may
  /// be reported as no impact. Returns false if a value is out of range.
  bool find(const Convex& a, const Convex& b, const Vec3<Unit>& axis, Fraction until, TimeOfImpact& impact);

 private:
  bool turn();

  const Motion &motion_a_, &motion_b_;
  bool placed_ = false, turned_ = false;
  Turning turning_a_, turning_b_;
  MovingPair pair_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
