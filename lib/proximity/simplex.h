#pragma once
#include "proximity/support.h"

/// The simplex of GJK on integers: which of its faces, edges and vertices is nearest to the origin, decided by exact
/// signs, so that it cannot cycle and cannot mistake touching for apart.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A vertex of the Minkowski difference B - A. Range: |difference| < 2^30.
struct SimplexVertex {
  Vec32 difference;
  CorePoint a, b;  ///< the core points that it is the difference of
};

/// One to four vertices whose hull's point nearest to the origin has every vertex in it, or holds the origin.
class Simplex {
 public:
  int count() const { return count_; }
  const SimplexVertex& vertex(int i) const { return vertex_[i]; }
  /// The hull of the vertices holds the origin.
  bool holds_origin() const { return holds_origin_; }

  void clear() {
    count_ = 0;
    holds_origin_ = false;
  }
  /// Notes a vertex to start from: only its core points count.
  void start(const SimplexVertex& vertex) {
    if (count_ < 4) vertex_[count_++] = vertex;
  }
  /// Takes `vertex` in, and drops what the nearest point does not need. False, and nothing changed, unless `vertex` lies
  /// strictly on the origin's side of the plane through the nearest point that is perpendicular to it: then the nearest
  /// point comes strictly nearer. As the vertices of two polytopes are finitely many, no sequence of insertions is
  /// endless. Range: not holds_origin().
  bool insert(const SimplexVertex& vertex);

  /// A vector along the nearest point, from the origin, its largest component within [2^29, 2^30] in magnitude: rounded
  /// to a relative 2^-29. Range: not holds_origin(), count > 0.
  Vec32 direction() const;

  /// v . p for the nearest point v, exactly, times a positive number. Range: not holds_origin(), |p| < 2^30.
  Int128 reach(const Vec32& p) const;

  /// The weights of the vertices in the nearest point, Q30, of sum 2^30 but for rounding; if the origin is held, any.
  void weights(int32_t (&weight)[4]) const;

 private:
  bool is_nearer(const Vec32& difference) const;
  void reduce_edge();
  void reduce_triangle();
  void reduce_tetrahedron();
  bool edge_holds(const Vec32& a, const Vec32& b);
  bool triangle_holds(const Vec32& a, const Vec32& b, const Vec32& c);
  void take_triangle(int a, int b, int c);
  void keep(int a);
  void keep(int a, int b);
  void keep(int a, int b, int c);

  SimplexVertex vertex_[4];
  int count_ = 0;
  bool holds_origin_ = false;
  // Edge (count 2): from vertex 1 to vertex 0. Triangle (count 3): `normal_` is across it, towards it from the origin.
  Vec32 edge_;
  int64_t edge_square_;
  int64_t along_;  // of the nearest point from vertex 1, times the edge's length: in (0, edge_square_)
  Vec64 normal_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
