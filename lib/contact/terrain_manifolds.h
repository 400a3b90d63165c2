#pragma once
#include "contact/collide.h"
#include "contact/terrain_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_terrain_manifolds_max = 16;  ///< largest number of contacts of one pair of bodies

/// One planar contact of a shape with terrain (a mesh or height field), in the terrain's axes.
struct TerrainManifold {
  Vec32 normal;  ///< from the terrain to the shape, Q30
  /// Key of the touched plane or edge: it stays the same while the shape stays there, differs from the keys of the
  /// shape's other manifolds, and is never 0.
  uint32_t key;
  uint32_t triangle;  ///< the triangle touched deepest
  uint8_t material;   ///< material of that triangle
  bool turns;         ///< as ContactGeometry::turns
  uint32_t count;
  struct Point {
    Vec64 from_shape;    ///< midway between the surfaces, 2^-46 m, from the shape's centre
    int64_t separation;  ///< 2^-46 m
    uint32_t feature;    ///< as ManifoldPoint::feature
    uint32_t part;       ///< as ContactGeometryPoint::part
  } point[k_contact_points_max];
};

/// Collects the touches of a shape (TerrainTouch), triangle by triangle or part by part, into a few manifolds: all
/// touches in one plane form one manifold. A touch on a face and a touch at an edge are in one plane only if their
/// normals are equal. If there is no room for another manifold, a touch joins the manifold with the nearest normal, if
/// the angle between the normals is at most 2^-1 rad. Touches are added one at a time, and their number is not limited.
/// If two contact points in one plane have the same feature, only the deeper one is kept.
class TerrainManifolds {
 public:
  /// `size`: the shape's half thickness, 2^-46 m. Normals at most 2^-`same_power` rad apart count as one normal.
  TerrainManifolds(int64_t size, int same_power)
      : size_(size), same_cosine_(k_one_cosine - (k_one_cosine >> (2 * same_power + 1))) {}
  void add(const TerrainTouch& touch);
  /// Call this after the last add(). Leaves out the doubtful manifolds (too deep to trust their normals,
  /// TerrainTouch::doubtful), unless all are doubtful, and sorts the manifolds by key, ascending. Returns their number.
  uint32_t finish();
  /// Returns the manifold with the index `place` in the order of finish().
  TerrainManifold manifold(uint32_t place) const;
  /// Number of touches dropped so far because no manifold could take them.
  uint32_t dropped() const { return dropped_; }
  bool capped() const { return capped_; }

 private:
  static constexpr uint32_t k_points_max = 8;
  static constexpr int32_t k_one_cosine = 1 << 28;
  /// The touches in one plane, from which manifold() makes a manifold.
  struct Group {
    Vec32 normal;
    Vec32 u, v;     ///< axes of the plane
    int64_t plane;  ///< height of the plane along the normal, from the shape's centre, 2^-46 m
    int64_t deepest;
    uint32_t triangle, first;  ///< the triangle touched deepest; the lowest index of all touched triangles
    uint32_t touches;
    uint32_t key;  ///< as TerrainManifold::key; set by finish()
    uint8_t material;
    bool on_face, doubtful, turns;
    uint32_t count;
    TerrainManifold::Point point[k_points_max];
  };

  Group* group_for(const TerrainTouch& touch, int64_t plane);
  void join(const TerrainTouch& touch, int64_t plane, Group& group);
  void add_point(const TerrainManifold::Point& point, Group& group) const;
  static uint32_t deepest_of(const Group& group);
  static uint32_t chosen_of(const Group& group, int64_t level, int64_t drop, bool fill);
  uint32_t spare_point(const Group& group) const;
  void leave_out_doubtful();

  int64_t size_;
  int32_t same_cosine_;  ///< the least dot product, Q28, of two normals that count as one normal
  uint32_t count_ = 0;
  uint32_t dropped_ = 0;
  bool capped_ = false;
  Group group_[k_terrain_manifolds_max];
};

/// One planar contact of two bodies, one of which is a mesh, a height field or a compound.
struct TerrainContact {
  /// A and B are as in the call that fills this struct; for collide_mesh() and put_contact(), A is `ground`.
  ContactGeometry geometry;
  /// Key of the touched plane or edge: it stays the same while the body stays there, differs from the keys of the
  /// pair's other contacts, and is never 0.
  uint32_t key;
  uint32_t triangle;  ///< the triangle touched deepest; 0 if there is no terrain
  uint8_t material;   ///< material of that triangle; 0 if there is no terrain
};

/// The contacts of a pair of bodies.
struct TerrainContacts {
  uint32_t count = 0;    ///< number of contacts; they are in ascending order of key
  uint32_t dropped = 0;  ///< number of touches (TerrainTouch) dropped for lack of room; the deepest are kept
  bool seam = false;     ///< whether ContactGeometry::seam is true for any contact
  bool capped = false;   ///< a search reached its iteration cap, asset bytes are missing, or a position is out of range
  TerrainContact contact[k_terrain_manifolds_max];
};

/// Sets `contact` to a manifold of the bodies `ground` and `body`. `rotation`: from the manifold's axes to the world's.
void put_contact(const TerrainManifold& manifold, const Matrix32& rotation, const CollisionBody& ground,
                 const CollisionBody& body, TerrainContact& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
