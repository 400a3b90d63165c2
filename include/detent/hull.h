#pragma once
#include <detent/asset.h>
#include <detent/status.h>

/// @file
/// The properties of a cooked hull.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The frame of a cooked hull's vertices. Stored: a value is never reused.
enum class HullFrame : uint32_t {
  principal = 1,  ///< origin at the centre of mass, principal axes: for bodies
  source = 2,     ///< the frame of the points that it was cooked from: for queries; it has no inertia
};

/// The properties of a cooked hull (docs/hull.md). The same in every configuration.
struct HullInfo {
  uint32_t vertex_count = 0;               ///< 4 to 255
  uint32_t face_count = 0;                 ///< 4 to 2 vertex_count - 4
  uint32_t edge_count = 0;                 ///< vertex_count + face_count - 2
  HullFrame frame = HullFrame::principal;  ///< frame of the vertices; a dynamic body needs `principal`
  int32_t exponent = 0;                    ///< the hull's unit of length is 2^exponent m
  int32_t core_radius = 0;      ///< greatest distance of a vertex from the origin, in 2^-30 of the unit, rounded up
  int32_t volume_mantissa = 0;  ///< the volume is volume_mantissa 2^volume_exponent m^3
  int32_t volume_exponent = 0;  ///< see volume_mantissa
  double origin[3] = {};        ///< the body's origin in the source frame, m
  int32_t rotation[4] = {};     ///< x, y, z, w in 2^-30: v_source = rotation v_body rotation* + origin
};

/// Checks a cooked hull as make_hull() (convex.h) does, and describes it.
/// Errors: buffer_misaligned, not_detent, format_unknown, truncated, corrupt, out_of_range.
Status hull_info(const Asset& asset, HullInfo& info);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
