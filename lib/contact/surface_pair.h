#pragma once
#include "contact/contact_points.h"
#include "shape/surface.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Where a shape lies in a surface's axes.
struct SurfacePlace {
  Matrix32 surface;          ///< from the surface's axes to the world's
  Matrix32 rotation;         ///< from the shape's axes to the surface's
  Vec64 centre;              ///< of the shape, in the surface's axes, 2^-46 m
  Vec64 middle = {0, 0, 0};  ///< of what is met, from there, likewise: which side of a triangle it is on
};

/// Errors: not_normalised; out_of_range for NaN and for positions 2^16 m apart.
Status place_on_surface(const Pose& surface, const Pose& shape, SurfacePlace& place);

/// 2^-46 m in grid steps are shifts by so many bits.
inline int grid_shift(const Surface& surface) { return k_metre_bits - 30 + surface.exponent(); }
/// The least box of the grid that holds these coordinates, 2^-46 m, and a step more; held to the grid's range.
GridBox grid_box(const Surface& surface, const Vec64& low, const Vec64& high);

/// A triangle by its corners, 2^-46 m from its origin, in a unit of length of 2^exponent m. `bound`: at least their
/// greatest distance from it, below the unit.
void set_triangle(const Vec64 (&corner)[3], int64_t bound, int exponent, Convex& convex);
/// The corners' greatest distance from the origin, or a little more.
int64_t bound_of(const Vec64 (&corner)[3]);

/// v turned from the axes of `m` to the world's, and back. Range: |v| < 2^62. Rounding: to nearest, once.
Vec64 rotate(const Matrix32& m, const Vec64& v);
Vec64 rotate_back(const Matrix32& m, const Vec64& v);

/// An axis in the plane across a normal, the same for equal normals: the points that are kept of a plane are among
/// those that are kept of its triangles.
Vec32 axis_across(const Vec32& normal);

/// What of a triangle a shape touches, along one normal.
struct SurfaceTouch {
  uint32_t triangle;
  uint32_t part;  ///< as ContactGeometryPoint::part
  uint8_t material;
  bool on_face;             ///< the normal is the triangle's own
  bool seam;                ///< as ContactGeometry::seam, also where nothing is touched
  bool doubtful;            ///< so deep that another way out is the right one, if there is one
  BlockManifold manifold;   ///< the triangle is A, with the shape's centre for its origin; surface's axes
  int64_t deepest;          ///< the least separation
  uint32_t corner_name[3];  ///< of the triangle's corners: the same from all triangles about a corner
};

/// A convex shape over a surface: finds what it touches, triangle by triangle, in the surface's axes.
class SurfacePair {
 public:
  /// All must outlive this.
  SurfacePair(const Surface& surface, const SurfacePlace& place, const Convex& shape, const ContactRules& rules);

  /// Of the shape, grown by the reach.
  const GridBox& box() const { return box_; }
  /// The shape's least half extent, its ball included, 2^-46 m.
  int64_t half_thickness() const { return thickness_; }

  /// False if the shape does not touch the triangle, or what it touches belongs to a neighbour.
  ///
  /// A normal is one that the surface allows: between flat and concave edges the triangle's own, at a convex or open
  /// edge or a corner also what lies between the normals about it. Contact points over the triangle along its own
  /// normal need no search; it is made only near a sharp edge, on a mild ridge beside its triangles, and where it is
  /// deep.
  bool touch(uint32_t triangle, SurfaceTouch& touch) const;

 private:
  struct Side;
  bool is_behind(const Vec64& point, const Vec32& normal, const Vec32& corner) const;
  Vec64 nearest_inside(const SurfaceTriangle& triangle) const;
  bool is_before_neighbour(const SurfaceTriangle& triangle, const Vec32& normal) const;
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
  bool has_nearer_way(const Side& side, int64_t deepest) const;
  bool allows(const Side& side, const Vec32& normal) const;
  bool allows_at_corner(uint32_t triangle, const Vec32& corner, const Vec32& normal) const;

  const Surface& surface_;
  const Matrix32& rotation_;
  const Convex& shape_;
  Vec64 centre_, middle_;
  const ContactRules& rules_;
  int64_t reach_, radius_, thickness_;
  Placed alone_;  ///< the shape in a block of its own unit
  GridBox box_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
