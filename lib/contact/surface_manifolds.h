#pragma once
#include "contact/collide.h"
#include "contact/surface_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_surface_manifolds_max = 8;

/// One flat contact of a shape with a surface, in the surface's axes.
struct SurfaceManifold {
  Vec32 normal;       ///< from the surface to the shape, Q30
  uint32_t key;       ///< the same while the shape stays on the same plane or edge; distinct, never 0
  uint32_t triangle;  ///< the one met deepest
  uint8_t material;   ///< its own
  bool turns;         ///< as ContactGeometry::turns
  uint32_t count;
  struct Point {
    Vec64 from_shape;    ///< midway between the surfaces, 2^-46 m, from the shape's centre
    int64_t separation;  ///< 2^-46 m
    uint32_t feature;    ///< as ManifoldPoint::feature
    uint32_t part;       ///< as ContactGeometryPoint::part
  } point[k_contact_points_max];
};

/// Collects what a shape touches, triangle by triangle or part by part, into few manifolds: what lies in one plane is
/// one. Streams: the number of touches has no bound. Features are to be distinct within a plane.
class SurfaceManifolds {
 public:
  /// `size`: the shape's half thickness, 2^-46 m.
  explicit SurfaceManifolds(int64_t size) : size_(size) {}
  void add(const SurfaceTouch& touch);
  /// The manifolds, ascending by key; returns their count. The deepest are kept.
  uint32_t finish(SurfaceManifold (&manifold)[k_surface_manifolds_max]);
  /// Touches that have found no room, so far.
  uint32_t dropped() const { return dropped_; }
  bool capped() const { return capped_; }

 private:
  static constexpr uint32_t k_groups_max = 12;
  static constexpr uint32_t k_points_max = 8;
  struct Point {
    SurfaceManifold::Point contact;
    int64_t u, v;  ///< in the group's plane, 2^-46 m
  };
  struct Group {
    Vec32 normal, u, v;
    int64_t plane;  ///< height of the surface along the normal, 2^-46 m
    int64_t deepest;
    uint32_t triangle, first;  ///< the one met deepest, and the lowest
    uint32_t touches;
    uint8_t material;
    bool on_face, doubtful, turns;
    uint32_t count;
    Point point[k_points_max];
  };

  Group* group_for(const SurfaceTouch& touch, int64_t plane);
  void join(const SurfaceTouch& touch, int64_t plane, Group& group);
  void add_point(const SurfaceManifold::Point& contact, Group& group) const;
  static uint32_t deepest_of(const Group& group);
  static uint32_t chosen_of(const Group& group, int64_t level, int64_t drop, bool fill);
  uint32_t spare_point(const Group& group) const;
  void choose(const Group& group, SurfaceManifold& manifold) const;
  void leave_out_doubtful();

  int64_t size_;
  uint32_t count_ = 0;
  uint32_t dropped_ = 0;
  bool capped_ = false;
  Group group_[k_groups_max];
};

/// One flat contact of two bodies, one of which is a mesh, a height field or a compound.
struct SurfaceContact {
  ContactGeometry geometry;  ///< A is the surface; `normal` from it to the body
  uint32_t key;              ///< the same while the body stays on the same plane or edge; distinct, never 0
  uint32_t triangle;         ///< the one met deepest; 0 where there is no surface
  uint8_t material;          ///< its own; likewise
};

struct SurfaceContacts {
  uint32_t count = 0;    ///< ascending by key
  uint32_t dropped = 0;  ///< triangles, or pairs of parts, touched that have found no room: the deepest are kept
  bool seam = false;     ///< as ContactGeometry::seam, of any
  bool capped = false;   ///< a search met its cap, an asset's bytes are missing, or a position is out of range
  SurfaceContact contact[k_surface_manifolds_max];
};

/// The contact of two bodies, whose axes `rotation` turns to the world's: those of the manifold.
void put_contact(const SurfaceManifold& manifold, const Matrix32& rotation, const CollisionBody& ground,
                 const CollisionBody& body, SurfaceContact& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
