#pragma once
#include <detent/fraction.h>

#include "contact/surface_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct SurfaceHit {
  bool hit = false;
  Fraction time = 0.0;     ///< the part of the way; 1 if there is none
  Vec3<Unit> normal = {};  ///< of the triangle, towards where the ray came from, world axes
  uint32_t triangle = k_no_triangle;
  uint8_t material = 0;
};

/// The first triangle of a surface at `pose` that the segment from `origin` (m, from the surface's position, world
/// axes) along `way` (m) meets; of equals the one of the lower index. One-sided surfaces let through what comes from
/// behind. No ray gets through an edge between two triangles: sides are exact, of ends rounded to the grid, so that the
/// hit errs by a step of it. A ray in a triangle's plane does not meet it. Errors: not_normalised; out_of_range, also
/// for components of 2^15 m.
Status cast_ray_on_surface(const Surface& surface, const Pose& pose, const Vec3<Real>& origin, const Vec3<Real>& way,
                           SurfaceHit& hit);

/// Calls visit(context, triangle) for each triangle whose bounds meet a box in the surface's axes; `low` and `high`,
/// 2^-46 m. For a swept body: the box around its sweep.
void visit_surface(const Surface& surface, const Vec64& low, const Vec64& high,
                   void (*visit)(void* context, uint32_t triangle), void* context);

/// The triangle as a convex shape of its own, at `placed`, for time_of_impact(): its position is the coordinate nearest
/// to its first corner. Errors: not_normalised; out_of_range if the position is.
Status surface_convex(const Surface& surface, const Pose& pose, uint32_t triangle, Pose& placed, Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
