#pragma once
#include <detent/asset.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// Shapes prepared for the functions that need no world (distance.h, toi.h, cast.h, contact.h).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A shape prepared for the functions of distance.h, toi.h, cast.h and contact.h: a core, and a ball that rounds the
/// core. All members are integers, the same in every configuration. Lengths are in 2^-30 of the shape's unit of length,
/// 2^exponent m. The unit is the least power of two above the greatest distance of a core point from the origin. Make a
/// Convex with the functions below; do not set the fields directly.
struct Convex {
  ShapeType type = ShapeType::sphere;  ///< the type of the source shape
  int32_t exponent = 0;                ///< the unit of length is 2^exponent m
  /// Box: half extents; capsule: (0, half length, 0); cylinder, cone: (radius, half length, 0); hull: (half thickness,
  /// 0, 0), or 0 where that is read from the cooked bytes.
  int32_t size[3] = {};
  int32_t core_radius = 0;        ///< greatest distance of a core point from the origin, rounded up
  int32_t radius = 0;             ///< of the ball, in 2^-30 2^radius_exponent m
  int32_t radius_exponent = 0;    ///< separate from `exponent`: the ball may be far larger than the core
  int32_t corner[3][3] = {};      ///< triangle: its corners
  uint32_t vertex_count = 0;      ///< hull: number of vertices
  const uint8_t* hull = nullptr;  ///< hull: the cooked bytes; they must outlive this Convex
};

/// Prepares a sphere, capsule, box, cylinder, cone or half-space. Sizes: [2^-14, 2^14] m; the half_length of a capsule
/// and the rounding may also be 0. The ratio of a core's largest to its smallest size is at most 2^14.
/// Rounding: each size to nearest, to within 2^-31 of the shape's unit. Errors: out_of_range; bad_argument (another
/// type, or rounding of a sphere, capsule or half-space).
Status make_convex(const Shape& shape, Convex& convex);

/// Prepares a hull cooked by `detent cook`, grown by a ball of radius `rounding`, m (0, or [2^-14, 2^14]). The bytes
/// may come from an untrusted source: all of them are checked. Errors: buffer_misaligned, not_detent, format_unknown,
/// truncated, corrupt, out_of_range.
Status make_hull(const Asset& asset, Real rounding, Convex& convex);

/// Prepares a triangle, grown by a ball of radius `rounding`, m (0, or [2^-14, 2^14]). `corners`: m, in the body's
/// frame; the farthest is 2^-14 to 2^15 m from the origin. The triangle may be degenerate. Errors: out_of_range.
Status make_triangle(const Vec3<Real> (&corners)[3], Real rounding, Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
