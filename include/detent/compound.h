#pragma once
#include <detent/asset.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// The description of a cooked compound, and its parts.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The description stored in a cooked compound (docs/compound.md). The same in every configuration.
struct CompoundInfo {
  uint32_t child_count = 0;     ///< number of children, 1 to 64
  uint32_t hull_count = 0;      ///< number of children that are hulls; the others are balls and capsules
  int32_t exponent = 0;         ///< the compound's unit of length is 2^exponent m
  int32_t radius = 0;           ///< greatest distance of the surface from the origin, in 2^-30 of the unit, rounded up
  int32_t half_thickness = 0;   ///< least half thickness of a child, in 2^-30 of the unit, rounded down
  int32_t volume_mantissa = 0;  ///< the volume is volume_mantissa 2^volume_exponent m^3
  int32_t volume_exponent = 0;  ///< see volume_mantissa
  double origin[3] = {};        ///< m; the body's origin in the source frame
  int32_t rotation[4] = {};     ///< x, y, z, w in 2^-30: v_source = rotation v_body rotation* + origin
};

/// Checks all bytes of a cooked compound, and describes it. Errors: buffer_misaligned (8 bytes), not_detent,
/// format_unknown, truncated, corrupt, out_of_range (an exponent).
Status compound_info(const Asset& asset, CompoundInfo& info);

/// A part (child) of a cooked compound, in the body's frame, m. Use it to draw the compound.
struct CompoundPart {
  ShapeType type = ShapeType::hull;  ///< sphere, capsule or hull
  double radius = 0;                 ///< m; for a hull, the radius of the ball that rounds it
  double from[3] = {};               ///< m; a sphere's centre, or one end of a capsule's core segment; 0 for a hull
  double to[3] = {};                 ///< m; the sphere's centre again, or the capsule's other end; 0 for a hull
  Asset hull = {};                   ///< a hull's bytes within the compound's bytes, for hull_info() and make_hull()
};

/// Reads the part `index`, 0 to CompoundInfo::child_count - 1. compound_info() must have accepted the compound: this
/// function does not check the bytes again. Errors: out_of_range (the index).
Status compound_part(const Asset& asset, uint32_t index, CompoundPart& part);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
