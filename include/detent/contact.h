#pragma once
#include <detent/distance.h>
#include <detent/reduction.h>

/// @file
/// Contact points of two convex shapes at rest. No world is needed.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The largest number of points in a manifold.
inline constexpr uint32_t k_contact_points_max = 4;

/// A contact point: a place where the two surfaces face each other along the manifold's normal.
struct ManifoldPoint {
  Vec3<Real> from_a = {};  ///< midway between the surfaces, m, from A's position, world axes
  Vec3<Real> from_b = {};  ///< the same place from B's position
  Real separation = 0.0;   ///< m, along the normal; negative where the shapes overlap
  /// Names the features of A and B that meet here. Never 0; distinct within a manifold; constant as long as the same
  /// features meet. Exchanging A and B exchanges its two 12-bit halves.
  uint32_t feature = 0;
};

/// The contact of two shapes: one normal and up to four points.
struct ContactManifold {
  Vec3<Unit> normal = {};  ///< from A to B, world axes; zero if there are no points
  uint32_t count = 0;      ///< number of points, at most k_contact_points_max
  bool capped = false;     ///< an iteration cap was reached: `normal` may not be the direction of least penetration
  ManifoldPoint point[k_contact_points_max];  ///< the first `count` are in use
};

/// Finds the contact manifold of two convex shapes that overlap, or whose distance is at most `distance_max`, m (the
/// search distance): the normal, and up to four points of the contact area. Without contact, `manifold` has no points.
///
/// The contact axis is the direction between the closest points or, if the cores overlap, the direction of the least
/// translation that separates them. The normal is this axis, except that the normal of a face replaces it in three
/// cases. Here h is the least half extent of the thinner core:
/// - The face normal is within 2^-13 rad of the axis.
/// - The cores overlap or nearly touch, and the face normal separates them as well as the axis, to within h / 64.
/// - The cores overlap or nearly touch at crossing edges, the face normal is within 2^-3 rad of the axis and separates
///   the cores as well as the axis, to within h / 16, and the points on the face are at most h / 64 deeper.
///
/// Faces of a hull that are coplanar to within 1/64 of its half thickness count as one face; its normal is that of
/// their outline.
///
/// The points are corners of the area in which the two supporting faces or edges overlap along the normal. The area may
/// extend beyond the sides of a face by 1/64 of the size of the smaller one. `reduction` selects four points if there
/// are more. A face of more than 32 vertices is represented by 32 extreme vertices. The flat side of a cylinder or cone
/// is represented by 8 points of its rim and the deepest point.
///
/// Precision: as closest_points(). Errors: bad_argument for two half-spaces; not_normalised; out_of_range for reach < 0
/// and NaN, and as closest_points() for a half-space.
Status contact_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real distance_max,
                      ContactManifold& manifold, DistanceCache* cache = nullptr,
                      ManifoldReduction reduction = ManifoldReduction::projected_extremes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
