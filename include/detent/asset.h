#pragma once
#include <detent/config.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// Cooked data (hulls, compounds, meshes and height fields), which several worlds can share, and functions that check
/// and describe it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Cooked data outside the world's block. It may lie in flash, and several worlds may share it.
struct Asset {
  const uint8_t* bytes = nullptr;  ///< aligned to 8 bytes; must outlive every world bound to it
  uint32_t byte_count = 0;         ///< number of bytes at `bytes`
};

/// The assets of a world. The caller chooses the order, which must be the same on every machine.
/// The state stores the index, size and content digest of each bound asset; an asset with other content is refused
/// (asset_mismatch).
struct AssetTable {
  const Asset* assets = nullptr;  ///< `count` assets; they must outlive every world bound to them
  /// Number of assets. If it is below Capacity::assets, bind_asset() refuses the remaining indices (asset_missing).
  uint32_t count = 0;
};

/// The frame of a cooked hull's vertices. Stored in cooked hulls: a value is never reused.
enum class HullFrame : uint32_t {
  principal = 1,  ///< origin at the centre of mass, principal axes: for bodies
  source = 2,     ///< the frame of the points that the hull was cooked from: for queries; such a hull has no inertia
};

/// The properties of a cooked hull (docs/hull.md). The same in every configuration.
struct HullInfo {
  uint32_t vertex_count = 0;               ///< 4 to 255
  uint32_t face_count = 0;                 ///< 4 to 2 vertex_count - 4
  uint32_t edge_count = 0;                 ///< vertex_count + face_count - 2
  HullFrame frame = HullFrame::principal;  ///< frame of the vertices; a dynamic body needs `principal`
  int32_t exponent = 0;                    ///< the hull's unit of length is 2^exponent m
  int32_t core_radius = 0;      ///< greatest distance of a vertex from the origin, in 2^-30 of the unit, rounded up
  int32_t volume_mantissa = 0;  ///< the volume is volume_mantissa x 2^volume_exponent m^3
  int32_t volume_exponent = 0;  ///< exponent of the volume, as in volume_mantissa
  double origin[3] = {};        ///< the body's origin in the source frame, m
  int32_t rotation[4] = {};     ///< x, y, z, w in 2^-30: v_source = rotation v_body rotation* + origin
};

/// Checks a cooked hull as make_hull() (distance.h) does, and sets `info` to its properties.
/// Errors: buffer_misaligned, not_detent, format_unknown, truncated, corrupt, out_of_range.
Status hull_info(const Asset& asset, HullInfo& info);

/// The properties of a cooked triangle mesh (docs/mesh.md). The same in every configuration.
struct MeshInfo {
  uint32_t vertex_count = 0;    ///< vertices
  uint32_t triangle_count = 0;  ///< triangles
  uint32_t node_count = 0;      ///< nodes of the mesh's bounding volume tree
  int32_t exponent = 0;         ///< the unit of length is 2^exponent m; coordinates are in 2^-30 of this unit
  bool one_sided = false;       ///< bodies collide only with the side on which the corners are counter-clockwise
  int32_t low[3] = {};          ///< least x, y and z of the vertices
  int32_t high[3] = {};         ///< greatest x, y and z of the vertices
};

/// Checks all bytes of a cooked mesh and sets `info` to its properties. Errors: buffer_misaligned (to 8 bytes),
/// not_detent, format_unknown, truncated, corrupt, out_of_range (the exponent).
Status mesh_info(const Asset& asset, MeshInfo& info);

/// The properties of a cooked height field (docs/height_field.md). The same in every configuration. The sample (i, j)
/// lies at origin + (i spacing_x, height(i, j) height_step, j spacing_z), in the body's axes; y is up. Lengths are in
/// 2^(exponent - 30) m.
struct HeightFieldInfo {
  uint32_t columns = 0;     ///< cells along x, 1 to 4096
  uint32_t rows = 0;        ///< cells along z, 1 to 4096
  int32_t exponent = 0;     ///< the field's unit of length is 2^exponent m
  bool one_sided = false;   ///< whether bodies collide with it from above only
  int32_t origin[3] = {};   ///< position of the sample (0, 0)
  int32_t spacing_x = 0;    ///< distance of samples along x
  int32_t spacing_z = 0;    ///< distance of samples along z
  int32_t height_step = 0;  ///< length of one height step
  int32_t low = 0;          ///< least height, in height steps
  int32_t high = 0;         ///< greatest height, in height steps
};

/// Checks all bytes of a cooked height field and sets `info` to its properties. Errors: buffer_misaligned (to 8 bytes),
/// not_detent, format_unknown, truncated, corrupt, out_of_range (the exponent).
Status height_field_info(const Asset& asset, HeightFieldInfo& info);

/// The properties of a cooked compound (docs/compound.md). The same in every configuration.
struct CompoundInfo {
  uint32_t child_count = 0;     ///< number of children, 1 to 64
  uint32_t hull_count = 0;      ///< number of children that are hulls; the others are balls and capsules
  int32_t exponent = 0;         ///< the compound's unit of length is 2^exponent m
  int32_t radius = 0;           ///< greatest distance of the surface from the origin, in 2^-30 of the unit, rounded up
  int32_t half_thickness = 0;   ///< least half thickness of a child, in 2^-30 of the unit, rounded down
  int32_t volume_mantissa = 0;  ///< the volume is volume_mantissa x 2^volume_exponent m^3
  int32_t volume_exponent = 0;  ///< exponent of the volume, as in volume_mantissa
  double origin[3] = {};        ///< the body's origin in the source frame, m
  int32_t rotation[4] = {};     ///< x, y, z, w in 2^-30: v_source = rotation v_body rotation* + origin
};

/// Checks all bytes of a cooked compound and sets `info` to its properties. Errors: buffer_misaligned (8 bytes),
/// not_detent, format_unknown, truncated, corrupt, out_of_range (an exponent).
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
