#pragma once
#include <detent/asset.h>
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

}  // namespace DETENT_NAMESPACE
}  // namespace detent
