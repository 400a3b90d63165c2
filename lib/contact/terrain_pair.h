#pragma once
#include "contact/contact_points.h"
#include "shape/terrain.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The pose of a shape relative to terrain (a mesh or height field).
struct TerrainPlace {
  Matrix32 terrain;   ///< from the terrain's axes to the world's
  Matrix32 rotation;  ///< from the shape's axes to the terrain's
  Vec64 centre;       ///< of the shape, in the terrain's axes, 2^-46 m
  /// From `centre` to the middle of the part that collides, 2^-46 m, in the terrain's axes. The middle decides on which
  /// side of a triangle the part is.
  Vec64 middle = {0, 0, 0};
};

/// Sets `place` from the poses of the terrain and the shape. Errors: not_normalised; out_of_range for NaN and for
/// positions 2^16 m or more apart in a component.
Status place_on_terrain(const Pose& terrain, const Pose& shape, TerrainPlace& place);

/// Returns the number of bits by which a length in 2^-46 m is shifted right to convert it to grid steps. A grid step is
/// 2^-30 of the terrain's unit of length; the corners of its triangles have integer coordinates in grid steps.
inline int grid_shift(const Terrain& terrain) { return k_metre_bits - 30 + terrain.exponent(); }
/// Returns a box in grid steps that contains the box from `low` to `high` (2^-46 m) and at least one more grid step on
/// each side. The coordinates are clamped to +-INT32_MAX.
GridBox grid_box(const Terrain& terrain, const Vec64& low, const Vec64& high);

/// Sets `convex` to a triangle. `corner`: relative to the triangle's origin, 2^-46 m. The triangle's unit of length is
/// 2^exponent m. `bound`, 2^-46 m: at least the greatest distance of a corner from the origin, and below the unit.
void set_triangle(const Vec64 (&corner)[3], int64_t bound, int exponent, Convex& convex);
/// Returns an upper bound (length_bound()) of the greatest distance of a corner from the origin.
int64_t bound_of(const Vec64 (&corner)[3]);

/// rotate() returns m v. rotate_back() is its inverse: it returns the transpose of m times v. Range: |v| < 2^62.
/// Rounding: to nearest, once.
Vec64 rotate(const Matrix32& m, const Vec64& v);
Vec64 rotate_back(const Matrix32& m, const Vec64& v);

/// Returns a unit vector perpendicular to a normal, Q30. Equal normals give the same vector. The manifold reduction
/// therefore uses the same four directions for all triangles of a plane. So the extreme points of the plane are among
/// the points that are kept for its triangles.
Vec32 axis_across(const Vec32& normal);

/// A touch: the contact of a shape with one triangle, along one normal.
struct TerrainTouch {
  uint32_t triangle;
  uint32_t part;  ///< as ContactGeometryPoint::part
  uint8_t material;
  bool on_face;  ///< the normal is the triangle's normal
  bool seam;     ///< as ContactGeometry::seam; set even if touch() returns false
  /// The contact is too deep to trust its normal. It is used only if all touches of the shape are doubtful.
  bool doubtful;
  /// The contact, in the terrain's axes. A is the triangle, whose origin is the shape's centre; B is the shape.
  BlockManifold manifold;
  int64_t deepest;          ///< the least separation, 2^-46 m
  uint32_t corner_name[3];  ///< names of the corners; the same for all triangles that share a corner
};

/// A convex shape over terrain. Finds its contacts triangle by triangle, in the terrain's axes.
class TerrainPair {
 public:
  /// The arguments must outlive this object.
  TerrainPair(const Terrain& terrain, const TerrainPlace& place, const Convex& shape, const ContactRules& rules);

  /// Bounds of the shape in grid steps, grown by the contact margin.
  const GridBox& box() const { return box_; }
  /// The shape's least half extent, its rounding ball included, 2^-46 m.
  int64_t half_thickness() const { return thickness_; }

  /// Finds the contact with one triangle. Returns false if the shape does not touch the triangle, or if the contact
  /// belongs to a neighbouring triangle.
  ///
  /// The contact normal must be one that the terrain allows. On the face, and at flat and concave edges, only the
  /// triangle's own normal is allowed. At a convex or open edge, or at a corner, the directions between the normals of
  /// the adjacent faces are allowed too. Contact points over the triangle along its own normal are found without a
  /// search for the contact axis. A search is made only in three cases: the triangle has a sharp edge (open, or convex
  /// with face normals more than 2^-3 rad apart); the contact is deep; or no contact point is over the triangle, but
  /// the shape's lowest point is over it or close beside it.
  bool touch(uint32_t triangle, TerrainTouch& touch) const;

 private:
  struct Side;
  bool is_behind(const Vec64& point, const Vec32& normal, const Vec32& corner) const;
  Vec64 nearest_inside(const TerrainTriangle& triangle) const;
  bool is_before_neighbour(const TerrainTriangle& triangle, const Vec32& normal) const;
  Side side_of(uint32_t triangle) const;
  Vec64 from_centre(const Vec32& point) const;
  int64_t height(const Vec32& normal, const Vec32& corner) const;
  bool make_pair(const Side& side, Convex& convex, RestingPair& pair) const;
  static Vec32 outward(const Side& side, uint32_t k);
  int64_t beyond(const Side& side, uint32_t k, const Vec32& out, const Vec32& point) const;
  bool is_beside(const Side& side, int64_t clear) const;
  bool is_lowest_beside(const Side& side, int64_t clear) const;
  Vec32 normal_beyond(const Side& side, uint32_t edge) const;
  bool is_at_seam(const Side& side, int64_t facing, int64_t deepest) const;
  void turn_to(const Vec32& normal, BlockManifold& manifold) const;
  bool has_sharp_edge(const Side& side) const;
  bool has_nearer_exit(const Side& side, int64_t deepest) const;
  bool allows(const Side& side, const Vec32& normal) const;
  bool allows_at_corner(uint32_t triangle, const Vec32& corner, const Vec32& normal) const;

  const Terrain& terrain_;
  const Matrix32& rotation_;
  const Convex& shape_;
  Vec64 centre_, middle_;
  const ContactRules& rules_;
  int64_t margin_, radius_, thickness_;
  /// The shape in integer coordinates from its own centre: in the terrain's axes, in 2^-30 of its own unit of length.
  Placed alone_;
  GridBox box_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
