#pragma once
#include <detent/numbers.h>

#include "contact/terrain_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The result of cast_ray_on_terrain().
struct TerrainHit {
  bool hit = false;
  Fraction time = 0.0;     ///< fraction of the segment at the hit; 1 if there is no hit
  Vec3<Unit> normal = {};  ///< of the triangle, on the side from which the ray comes; world axes
  uint32_t triangle = k_no_triangle;
  uint8_t material = 0;
};

/// Finds the first triangle of terrain (a mesh or height field) at `pose` that a segment hits. The segment goes from
/// `origin` (m, from the terrain's position, world axes) along `displacement` (m). Ties: the triangle with the lower
/// index. One-sided terrain ignores hits from behind. The ends of the segment are rounded to the terrain's grid
/// (grid_shift()), so the hit errs by up to one grid step. The tests against the sides of a triangle are then exact, so
/// no ray passes between two adjacent triangles. A ray in a triangle's plane does not hit the triangle. Errors:
/// not_normalised; out_of_range, also for components of `origin` or `displacement` of 2^15 m or more.
Status cast_ray_on_terrain(const Terrain& terrain, const Pose& pose, const Vec3<Real>& origin,
                           const Vec3<Real>& displacement, TerrainHit& hit);

/// Calls visit(context, triangle) for each triangle whose bounds overlap a box in the terrain's axes, given by `low`
/// and `high`, 2^-46 m. For a swept body, pass the box around its sweep.
void visit_terrain(const Terrain& terrain, const Vec64& low, const Vec64& high,
                   void (*visit)(void* context, uint32_t triangle), void* context);

/// Sets `convex` to one triangle of terrain at `pose`, for time_of_impact(), and `placed` to the pose of this convex
/// shape. The position of `placed` is the triangle's first corner, rounded to coordinates. Errors: not_normalised;
/// out_of_range if this position is out of range.
Status terrain_convex(const Terrain& terrain, const Pose& pose, uint32_t triangle, Pose& placed, Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
