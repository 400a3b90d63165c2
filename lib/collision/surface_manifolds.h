#pragma once
#include "collision/surface_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_surface_manifolds_max = 8;

/// One flat contact of a shape with a surface, in the surface's axes.
struct SurfaceManifold {
  Vec32 normal;       ///< from the surface to the shape, Q30
  uint32_t key;       ///< the same while the shape stays on the same plane or edge; distinct, never 0
  uint32_t triangle;  ///< the one met deepest
  uint8_t material;   ///< its own
  uint32_t count;
  struct Point {
    Vec64 from_shape;    ///< midway between the surfaces, 2^-46 m, from the shape's centre
    int64_t separation;  ///< 2^-46 m
    uint32_t feature;    ///< as ManifoldPoint::feature
  } point[k_contact_points_max];
};

/// Collects what a shape touches, triangle by triangle, into few manifolds: what lies in one plane is one. Streams: the
/// number of triangles has no bound.
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
    bool on_face, doubtful;
    uint32_t count;
    Point point[k_points_max];
  };

  Group* group_for(const SurfaceTouch& touch, int64_t plane);
  void join(const SurfaceTouch& touch, int64_t plane, Group& group);
  void add_point(const SurfaceManifold::Point& contact, Group& group) const;
  static uint32_t spare_point(const Group& group);
  void choose(const Group& group, SurfaceManifold& manifold) const;
  void leave_out_doubtful();

  int64_t size_;
  uint32_t count_ = 0;
  uint32_t dropped_ = 0;
  bool capped_ = false;
  Group group_[k_groups_max];
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
