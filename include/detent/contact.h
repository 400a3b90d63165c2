#pragma once
#include <detent/distance.h>
#include <detent/reduction.h>

/// @file
/// Contact of two convex shapes at rest. It needs no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Points that a manifold holds.
inline constexpr uint32_t k_contact_points_max = 4;

/// Where two surfaces face each other along a manifold's normal.
struct ManifoldPoint {
  Vec3<Real> from_a = {};  ///< midway between the surfaces, m, from A's position, world axes
  Vec3<Real> from_b = {};  ///< the same place from B's position
  Real separation = 0.0;   ///< m, along the normal; negative where the shapes overlap
  /// Which features of A and B meet here. Never 0; distinct within a manifold; the same as long as the same ones meet,
  /// and but for its halves when A and B change places.
  uint32_t feature = 0;
};

/// Where two shapes touch: one normal and up to four points.
struct ContactManifold {
  Vec3<Unit> normal = {};  ///< from A to B, world axes; zero if there are no points
  uint32_t count = 0;      ///< of the points, at most k_contact_points_max
  bool capped = false;     ///< an iteration cap was met: the normal may be another than the least way out
  ManifoldPoint point[k_contact_points_max];  ///< the first `count` are in use
};

/// Where two convex shapes touch or are within `reach`, m, of it: the normal, and up to four points of the area.
///
/// The normal is that of the closest points, or of the least translation that parts overlapping cores. It is a face's
/// own within 2^-13 rad of that; and, of cores that overlap or are nearly touching, where the face parts them as well
/// but for a 64th of the thinner one's least half extent; of cores whose edges cross also that of a face which leans by
/// less than 2^-3 rad, where it parts them but for a 16th and its points are no more than a 64th deeper. Faces of a hull
/// that are level within a 64th of its half thickness count as one, whose normal is that of their outline.
///
/// The points are corners of the area where the two supporting faces or edges face each other, which may reach a 64th
/// of the smaller one beyond its sides. Of more than four, those that `reduction` names. A face of more than 32
/// vertices counts by 32 extremes, the flat side of a cylinder or cone by 8 points of its rim and the one that is
/// deepest.
///
/// Precision: as closest_points(). Errors: bad_argument for two half-spaces; not_normalised; out_of_range for reach < 0
/// and NaN.
Status contact_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real reach,
                      ContactManifold& manifold, DistanceCache* cache = nullptr,
                      ManifoldReduction reduction = ManifoldReduction::projected_extremes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
