#pragma once
#include <detent/asset.h>
#include <detent/numbers.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// Convex shapes prepared for the functions that need no world (this header, toi.h, contact.h); distance and overlap of
/// two of them at rest, and casts against one.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A convex shape, prepared for the functions of this header, toi.h and contact.h. The shape is the Minkowski sum of a
/// core and a ball, which rounds the core. All members are integers, the same in every configuration. Lengths are in
/// 2^-30 of the shape's unit of length, 2^exponent m. The unit is the least power of two above the greatest distance of
/// a core point from the origin. Make a Convex with the functions below; do not set the fields directly.
struct Convex {
  ShapeType type = ShapeType::sphere;  ///< the type of the source shape
  int32_t exponent = 0;                ///< the unit of length is 2^exponent m
  /// Box: half extents; capsule: (0, half length, 0); cylinder, cone: (radius, half length, 0); hull: (half thickness,
  /// 0, 0), or 0 if the half thickness is read from the cooked bytes.
  int32_t size[3] = {};
  int32_t core_radius = 0;        ///< greatest distance of a core point from the origin, rounded up
  int32_t radius = 0;             ///< radius of the ball, in units of 2^(radius_exponent - 30) m
  int32_t radius_exponent = 0;    ///< separate from `exponent`: the ball may be far larger than the core
  int32_t corner[3][3] = {};      ///< triangle: its corners
  uint32_t vertex_count = 0;      ///< hull: number of vertices
  const uint8_t* hull = nullptr;  ///< hull: the cooked bytes; they must outlive this Convex
};

/// Prepares a sphere, capsule, box, cylinder, cone or half-space. Sizes: [2^-14, 2^14] m; the half_length of a capsule
/// and the rounding may also be 0. The ratio of a core's largest to its smallest size is at most 2^14.
/// Rounding: each size to nearest, to within 2^-31 of the shape's unit. Errors: out_of_range; bad_argument (another
/// type; or Shape::rounding is not 0 for a sphere, capsule or half-space).
Status make_convex(const Shape& shape, Convex& convex);

/// Prepares a hull cooked by `detent cook`, grown by a ball of radius `rounding`, m (0, or [2^-14, 2^14]). The bytes
/// may come from an untrusted source: all of them are checked. Errors: buffer_misaligned, not_detent, format_unknown,
/// truncated, corrupt, out_of_range.
Status make_hull(const Asset& asset, Real rounding, Convex& convex);

/// Prepares a triangle, grown by a ball of radius `rounding`, m (0, or [2^-14, 2^14]). `corners`: m, in the body's
/// frame; the farthest is 2^-14 to 2^15 m from the origin. The triangle may be degenerate. Errors: out_of_range.
Status make_triangle(const Vec3<Real> (&corners)[3], Real rounding, Convex& convex);

/// The vertices of the last simplex of GJK for a pair, from which the next query of the pair starts. Any content is
/// safe: it changes only the run time, and the choice among equally near points.
struct DistanceCache {
  uint8_t count = 0;         ///< number of vertices of the simplex; 0 when new
  uint8_t vertex_a[4] = {};  ///< vertices of A; the first `count` are in use
  uint8_t vertex_b[4] = {};  ///< vertices of B; the first `count` are in use
};

/// The largest error of a distance, as a fraction of the pair's extent: the core diameters plus the distance of the
/// centres.
inline constexpr double k_distance_error = 0x1p-25;

/// The closest points of two shapes.
struct Closest {
  bool overlap = false;     ///< the shapes (cores rounded by their balls) overlap: the distance is 0
  bool capped = false;      ///< GJK reached its cap: `distance` is a lower bound; if it is 0, overlap is undecided
  Real distance = 0.0;      ///< m, between the surfaces
  Vec3<Unit> normal = {};   ///< direction from A to B, world axes; zero if the cores overlap
  Vec3<Real> point_a = {};  ///< closest point on A's surface, m, from A's position, world axes
  Vec3<Real> point_b = {};  ///< closest point on B's surface, m, from B's position, world axes
  uint32_t iterations = 0;  ///< number of support points computed
};

/// Computes the distance of two convex shapes and their closest points.
/// Precision: k_distance_error times the pair's extent (the core diameters plus the distance of the centres).
/// Range: any poses. Overflow: a distance of 2^17 m or more is clamped to the range of Real.
/// Errors: bad_argument for two half-spaces; not_normalised; out_of_range for NaN, and with a half-space if the two
/// positions are 2^16 m or more apart in a component.
Status closest_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Closest& result,
                      DistanceCache* cache = nullptr);

/// Sets `result` to whether the shapes overlap or touch. For polytopes the test is exact, except that the rounding of
/// their poses causes an error of k_distance_error times the pair's extent. If GJK reaches its iteration cap, or if the
/// rounding of the balls' radii leaves the answer undecided, `result` is true. Errors: as closest_points().
Status overlap(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, bool& result,
               DistanceCache* cache = nullptr);

/// Sets `result` to whether the distance of the shapes exceeds `distance_max`, m. If `result` is true, this is certain.
/// If `result` is false, the distance may exceed `distance_max` by k_distance_error times the pair's extent. Errors: as
/// closest_points(), and out_of_range for distance_max < 0.
Status farther_than(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real distance_max,
                    bool& result, DistanceCache* cache = nullptr);

/// The result of a cast.
struct CastHit {
  bool hit = false;        ///< the cast hits the shape within its displacement
  bool undecided = false;  ///< an iteration cap was reached: no hit before `time`; a later hit is possible
  Fraction time = 0.0;     ///< fraction of the displacement up to the hit, never too large; 1 if there is no hit
  Vec3<Real> point = {};   ///< the hit point on the shape, m, from the shape's position, world axes
  Vec3<Unit> normal = {};  ///< outward normal at `point`, world axes; zero if the cast starts in the shape's core
};

/// Finds where the segment from `origin` (m, from the shape's position, world axes) to `origin` + `displacement` (m)
/// enters the shape. Precision: the hit point lies at most the tolerance of time_of_impact() in front of the surface.
/// Source: van den Bergen, "Ray Casting against General Convex Objects", 2004, with separating axes that are certified.
/// Errors: not_normalised; out_of_range, also for a component of `displacement` of 2^15 m or more. An origin with a
/// component of 2^16 m or more is out of range if the shape is a half-space, or if the segment might hit the shape.
Status cast_ray(const Convex& convex, const Pose& pose, const Vec3<Real>& origin, const Vec3<Real>& displacement,
                CastHit& result);

/// Finds where `moving`, which starts at `start` and is translated by `displacement`, m, without rotation,
/// first hits `convex`. With a sphere as `moving` this is a sphere cast. `normal` points from `convex` to `moving`.
/// Errors: as time_of_impact().
Status cast_shape(const Convex& moving, const Pose& start, const Vec3<Real>& displacement, const Convex& convex,
                  const Pose& pose, CastHit& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
