#pragma once
#include <detent/asset.h>
#include <detent/status.h>

/// @file
/// What a cooked hull says of itself.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which axes the vertices of a cooked hull are in. Stored: a value is never reused.
enum class HullFrame : uint32_t {
  principal = 1,  ///< of a body: origin at the centre of mass, principal axes
  source = 2,     ///< of the points it was cooked from: for queries, without gyration
};

/// What a cooked hull (docs/hull.md) says of itself. The same in every configuration.
struct HullInfo {
  uint32_t vertex_count = 0;               ///< 4 to 255
  uint32_t face_count = 0;                 ///< 4 to 2 vertex_count - 4
  uint32_t edge_count = 0;                 ///< vertex_count + face_count - 2
  HullFrame frame = HullFrame::principal;  ///< a dynamic body takes none but `principal`
  int32_t exponent = 0;                    ///< of its unit of length, 2^exponent m
  int32_t core_radius = 0;      ///< greatest distance of a vertex from the origin, in 2^-30 of the unit, rounded up
  int32_t volume_mantissa = 0;  ///< the volume is volume_mantissa 2^volume_exponent m^3
  int32_t volume_exponent = 0;  ///< of the volume
  double origin[3] = {};        ///< m; the body's origin in the source frame
  int32_t rotation[4] = {};     ///< x, y, z, w in 2^-30: v_source = rotation v_body rotation* + origin
};

/// Describes a cooked hull, after every check that make_hull() (convex.h) makes.
/// Errors: buffer_misaligned, not_detent, format_unknown, truncated, corrupt, out_of_range.
Status hull_info(const Asset& asset, HullInfo& info);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
