#pragma once
#include <detent/convex.h>

/// @file
/// Distance and overlap of two convex shapes at rest. No world is needed.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The vertices of the last simplex of a pair's query; the next query of the pair starts from them. Any content is
/// safe: it changes only the run time, and which of several equally near points is returned.
struct DistanceCache {
  uint8_t count = 0;         ///< number of vertices in use; 0 when new
  uint8_t vertex_a[4] = {};  ///< vertices of A; the first `count` are in use
  uint8_t vertex_b[4] = {};  ///< vertices of B; the first `count` are in use
};

/// The largest error of a distance, as a fraction of the pair's extent: the core diameters plus the distance of the
/// centres.
inline constexpr double k_distance_error = 0x1p-25;

/// The closest points of two shapes.
struct Closest {
  bool overlap = false;     ///< the cores or the balls that round them overlap: the distance is 0
  bool capped = false;      ///< the iteration cap was reached: `distance` is a lower bound; at 0 overlap is undecided
  Real distance = 0.0;      ///< m, between the surfaces
  Vec3<Unit> normal = {};   ///< from A to B, world axes; zero if the cores overlap
  Vec3<Real> point_a = {};  ///< on A's surface, m, from A's position, world axes
  Vec3<Real> point_b = {};  ///< on B's surface, m, from B's position, world axes
  uint32_t iterations = 0;  ///< number of support points computed
};

/// Computes the distance of two convex shapes and their closest points.
/// Precision: k_distance_error of the pair's extent (the core diameters plus the distance of the centres).
/// Range: any poses; a distance beyond 2^17 m saturates.
/// Errors: bad_argument for two half-spaces; not_normalised; out_of_range for NaN, and for a half-space whose position
/// is 2^16 m or more from that of the other shape in a component.
Status closest_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Closest& result,
                      DistanceCache* cache = nullptr);

/// Whether the shapes overlap or touch. For polytopes the test is exact; only the rounding of their poses causes an
/// error, of k_distance_error. If the iteration cap or the rounding of the balls leaves the answer open, it is true.
/// Errors: as closest_points().
Status overlap(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, bool& result,
               DistanceCache* cache = nullptr);

/// Whether the shapes are farther apart than `distance_max`, m. True is certain; false may be wrong by
/// k_distance_error. Errors: as closest_points(), and out_of_range for reach < 0.
Status farther_than(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real distance_max,
                    bool& result, DistanceCache* cache = nullptr);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
