#pragma once
#include <detent/asset.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// Shapes made ready for questions without a world.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A shape made ready for the questions of distance.h and toi.h: a core and a ball that rounds it. All integers, the
/// same in every configuration. Lengths are in 2^-30 of the shape's own unit of length, 2^exponent m, the least power
/// of two above the greatest distance of a core point from the origin. Make one with the functions below; the fields
/// are theirs.
struct Convex {
  ShapeType type = ShapeType::sphere;  ///< what it was made from
  int32_t exponent = 0;                ///< of the unit of length, m
  int32_t size[3] = {};  ///< box: half extents; capsule: (0, half length, 0); cylinder, cone: (radius, half length, 0);
                         ///< hull: (half thickness, 0, 0), or zero
  int32_t core_radius = 0;        ///< greatest distance of a core point from the origin, rounded up
  int32_t radius = 0;             ///< of the ball, in 2^-30 2^radius_exponent m
  int32_t radius_exponent = 0;    ///< the ball may be far larger than the core
  int32_t corner[3][3] = {};      ///< of a triangle
  uint32_t vertex_count = 0;      ///< of a hull
  const uint8_t* hull = nullptr;  ///< the cooked bytes; they must outlive this
};

/// Makes a sphere, capsule, box, cylinder, cone or half-space ready. Sizes, m: within [2^-14, 2^14], half_length of a
/// capsule and rounding also 0; the ratio of a core's largest to its smallest size at most 2^14.
/// Rounding: each size to nearest, 2^-31 of the shape's unit. Errors: out_of_range, bad_argument.
Status make_convex(const Shape& shape, Convex& convex);

/// Makes a hull cooked by `detent cook` ready, grown by a ball of `rounding`, m. The bytes may come from anywhere: all
/// of them are checked. Errors: buffer_misaligned, not_detent, format_unknown, truncated, corrupt, out_of_range.
Status make_hull(const Asset& asset, Real rounding, Convex& convex);

/// Makes a triangle ready, by its corners, m, in its body's frame, grown by a ball of `rounding`. It may be degenerate.
/// Errors: out_of_range, also if all corners are at the origin.
Status make_triangle(const Vec3<Real> (&corners)[3], Real rounding, Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
