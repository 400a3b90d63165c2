#pragma once
#include <detent/asset.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// What a cooked compound says of itself.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a cooked compound (docs/compound.md) says of itself. The same in every configuration.
struct CompoundInfo {
  uint32_t child_count = 0;     ///< 1 to 64
  uint32_t hull_count = 0;      ///< of them; the others are balls and capsules
  int32_t exponent = 0;         ///< of its unit of length, 2^exponent m
  int32_t radius = 0;           ///< greatest distance of its surface from the origin, in 2^-30 of the unit, rounded up
  int32_t half_thickness = 0;   ///< least half thickness of a child, likewise, rounded down
  int32_t volume_mantissa = 0;  ///< the mass at density 1 is volume_mantissa 2^volume_exponent kg
  int32_t volume_exponent = 0;  ///< of the volume
  double origin[3] = {};        ///< m; the body's origin in the source frame
  int32_t rotation[4] = {};     ///< x, y, z, w in 2^-30: v_source = rotation v_body rotation* + origin
};

/// Describes a cooked compound, after every check. Errors: buffer_misaligned (8), not_detent, format_unknown,
/// truncated, corrupt, out_of_range (an exponent).
Status compound_info(const Asset& asset, CompoundInfo& info);

/// A part of a cooked compound, in the body's axes, m: to draw it.
struct CompoundPart {
  ShapeType type = ShapeType::hull;  ///< sphere, capsule or hull
  double radius = 0;                 ///< m; of a hull that of the ball that rounds it
  double from[3] = {};               ///< m; a sphere's centre, or a capsule's end; of a hull 0
  double to[3] = {};                 ///< m; the sphere's centre again, or the other end
  Asset hull = {};                   ///< of a hull: its bytes within the compound's, for hull_info() and make_hull()
};

/// The part `index` of a compound that compound_info() accepts, which is not asked again: its child_count there are.
/// Errors: out_of_range (the index).
Status compound_part(const Asset& asset, uint32_t index, CompoundPart& part);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
