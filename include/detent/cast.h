#pragma once
#include <detent/toi.h>

/// @file
/// Casts against one convex shape at rest. They need no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a cast met.
struct CastHit {
  bool hit = false;        ///< the shape is met within the way
  bool undecided = false;  ///< the cap was met: nothing is hit up to `time`, and beyond it is not known
  Fraction time = 0.0;     ///< the part of the way until the hit, never late; 1 if there is none
  Vec3<Real> point = {};   ///< of the hit on the shape, m, from its position, world axes
  Vec3<Unit> normal = {};  ///< of the shape there, outward, world axes; zero where the cast starts in the core
};

/// Where the segment from `origin` (m, from the shape's position, world axes) along `way` (m) enters the shape.
/// Precision: the hit is at most the tolerance of time_of_impact() in front of the surface.
/// Source: van den Bergen, "Ray Casting against General Convex Objects", 2004, on certified axes.
/// Errors: not_normalised; out_of_range, also for a way of 2^15 m in a component, and an origin 2^16 m away that the
/// way might lead from to the shape.
Status cast_ray(const Convex& convex, const Pose& pose, const Vec3<Real>& origin, const Vec3<Real>& way,
                CastHit& result);

/// Where `moving`, which starts at `start` and moves along `way`, m, without turning, first meets `convex`.
/// A sphere's radius makes it a swept sphere. `normal` points from `convex` to `moving`. Errors: as time_of_impact().
Status cast_shape(const Convex& moving, const Pose& start, const Vec3<Real>& way, const Convex& convex,
                  const Pose& pose, CastHit& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
