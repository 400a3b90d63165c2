#pragma once
#include <detent/convex.h>

/// @file
/// Questions about two convex shapes at rest. They need no world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The vertices where a pair's last query ended, for the next one to start from. Any content is safe: it alters how
/// fast an answer comes, and which of several equally near points is named.
struct DistanceCache {
  uint8_t count = 0;         ///< 0 when new
  uint8_t vertex_a[4] = {};  ///< of A, the first `count` in use
  uint8_t vertex_b[4] = {};  ///< of B
};

/// The error of a distance, in parts of the pair's extent: the core diameters and the distance of the centres.
inline constexpr double k_distance_error = 0x1p-25;

/// The closest points of two shapes.
struct Closest {
  bool overlap = false;     ///< the cores or their balls meet: distance 0
  bool capped = false;      ///< the cap was met: `distance` is a lower bound; 0 leaves open whether they meet
  Real distance = 0.0;      ///< m, between the surfaces
  Vec3<Unit> normal = {};   ///< from A to B, world axes; zero if the cores meet
  Vec3<Real> point_a = {};  ///< on A's surface, m, from A's position, world axes
  Vec3<Real> point_b = {};  ///< on B's surface, m, from B's position, world axes
  uint32_t iterations = 0;  ///< support points asked for
};

/// The distance of two convex shapes, with the closest points.
/// Precision: k_distance_error of the pair's extent (their core diameters and the distance of their centres).
/// Range: any poses; beyond 2^17 m of distance it saturates.
/// Errors: bad_argument for two half-spaces; not_normalised; out_of_range for NaN, and for a half-space whose position
/// is 2^16 m from the other shape's.
Status closest_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Closest& result,
                      DistanceCache* cache = nullptr);

/// Whether the shapes meet or touch. Of polytopes exact but for their placing, which errs by k_distance_error; where a
/// cap or the rounding of balls leaves it open, true.
Status overlap(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, bool& result,
               DistanceCache* cache = nullptr);

/// Whether the shapes are farther apart than `reach`, m: true is certain, false may err by k_distance_error.
Status farther_than(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real reach, bool& result,
                    DistanceCache* cache = nullptr);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
