#pragma once
#include <detent/toi.h>

/// @file
/// Casts against one convex shape at rest. They need no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The result of a cast.
struct CastHit {
  bool hit = false;        ///< the cast hits the shape within its displacement
  bool undecided = false;  ///< the iteration cap was reached: no hit up to `time`, unknown beyond it
  Fraction time = 0.0;     ///< fraction of the displacement up to the hit, never late; 1 if there is no hit
  Vec3<Real> point = {};   ///< the hit point on the shape, m, from the shape's position, world axes
  Vec3<Unit> normal = {};  ///< of the shape at `point`, outward, world axes; zero if the cast starts in the core
};

/// Finds where the segment from `origin` (m, from the shape's position, world axes) to `origin` + `displacement` (m)
/// enters the shape. Precision: the hit is at most the tolerance of time_of_impact() in front of the surface. Source:
/// van den Bergen, "Ray Casting against General Convex Objects", 2004, on certified axes. Errors: not_normalised;
/// out_of_range, also for a component of `displacement` of 2^15 m or more. An origin with a component of 2^16 m or more
/// is out of range if the segment might hit the shape, and always if the shape is a half-space.
Status cast_ray(const Convex& convex, const Pose& pose, const Vec3<Real>& origin, const Vec3<Real>& displacement,
                CastHit& result);

/// Finds where `moving`, which starts at `start` and moves by the displacement `displacement`, m, without rotation,
/// first hits `convex`. With a sphere as `moving` this is a sphere cast. `normal` points from `convex` to `moving`.
/// Errors: as time_of_impact().
Status cast_shape(const Convex& moving, const Pose& start, const Vec3<Real>& displacement, const Convex& convex,
                  const Pose& pose, CastHit& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
