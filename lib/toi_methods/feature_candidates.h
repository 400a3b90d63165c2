#pragma once
#include "distance/polytope.h"
#include "toi/feature_path.h"

/// Selects the features of two polytopes that may be the first to touch in a part of a step. Where polytopes first
/// touch, the outward normals of A that are also negated outward normals of B form a cone. Each ray on the border of
/// the cone is either the normal of a face that touches a vertex of the other polytope, or it is perpendicular to an
/// edge of each polytope, and these edges touch. A pair of features is therefore a candidate only if it can give such a
/// ray, and only if the displacements of its vertices can bring the two features together.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A part of a step, and the poses of the bodies at its ends.
struct StepPart {
  Interval interval;
  PlacedPair begin, end;
  int64_t angle;  ///< bound on the relative rotation of the bodies, Q30 rad
  /// Bound, 2^-46 m, on the distance of a path from its chord, roundings included. The path is that of the difference
  /// of a point of A and a point of B.
  int64_t bend;
  Vec64 displacement;  ///< translation of B relative to A over the part, 2^-46 m
  /// A bound, 2^-46 m, for two points that touch in the part. Over the part, the relative displacement of these points,
  /// along the normal that their features have at the beginning, differs from that of `displacement` by at most this
  /// bound.
  int64_t stray;

  /// Whether points that touch with this outward normal of A at the beginning may approach. When two bodies first
  /// touch, at least one of the normals that bound their common cone has this property.
  bool approaches(const Vec32& normal) const { return dot(displacement, normal).round_shift(30) <= stray; }
};

/// An edge and the outward normals of its two faces, in the order of EdgeFaces (distance/polytope.h). All are unit
/// vectors in world axes, Q30; zero for a degenerate edge or face.
struct EdgeFan {
  uint8_t from, to;
  Vec32 along, left, right;
};

/// Whether an edge of A and an edge of B can touch from outside during a part and approach.
bool may_touch(const EdgeFan& a, const EdgeFan& b, const StepPart& part);

/// One of two polytopes, and its candidate vertices.
class CandidateSide {
 public:
  explicit CandidateSide(const Convex& convex) : convex_(convex), hull_(hull_of(convex)), polytope_(convex) {}

  const Convex& convex() const { return convex_; }
  const Polytope& polytope() const { return polytope_; }
  bool counts(uint32_t vertex) const { return counts_[vertex]; }
  bool counts(uint32_t from, uint32_t to) const { return counts_[from] || counts_[to]; }

  /// The position of a vertex in the body's axes, 2^-46 m.
  Vec64 corner(uint32_t vertex) const;
  /// Returns how far the body extends from its position, 2^-46 m, along a unit direction (Q30) in the body's axes.
  int64_t extent(const Vec32& direction) const { return metres(farthest(direction)); }
  /// Selects as candidates the vertices that extend at least `least`, 2^-46 m, along the direction at the beginning or
  /// at the end.
  void choose(const Vec32 (&direction)[2], const int64_t (&least)[2]);
  /// Returns the largest coordinate of the given vertices along the direction of `end` (0: beginning, 1: end), 2^-46 m.
  int64_t extent(const uint32_t* vertex, int count, int end) const {
    int64_t most = INT64_MIN;
    for (int i = 0; i < count; ++i) most = larger(most, dot(direction_[end], polytope_.vertex(vertex[i])));
    return metres(most);
  }
  /// Calls visit(vertex) for the candidate vertices that are the farthest in `direction`, or can become the farthest if
  /// the body rotates by at most `angle`, Q30 rad.
  template <class Visit>
  void for_each_extreme(const Vec32& direction, int64_t angle, Visit&& visit) const {
    const int64_t least = farthest(direction) - 2 * int64_t{convex_.core_radius} * (angle + k_unit_error);
    for (uint32_t i = 0; i < count_; ++i) {
      if (dot(direction, polytope_.vertex(chosen_[i])) >= least) visit(uint32_t{chosen_[i]});
    }
  }
  /// Sets `fan` for an edge. Returns false for an edge that lies within a face.
  bool fan(uint32_t from, uint32_t to, const Matrix32& rotation, EdgeFan& fan) const;

  /// Error bound of the dot product of two rotated unit vectors, 2^-30.
  static constexpr int64_t k_unit_error = 64;

 private:
  /// The largest coordinate of a vertex along a direction, in Q60 of the shape's unit.
  int64_t farthest(const Vec32& direction) const {
    return dot(direction, local_support(convex_, hull_, direction, 0).local);
  }
  int64_t metres(int64_t along) const;

  const Convex& convex_;
  const HullView hull_;
  const Polytope polytope_;
  bool counts_[k_polytope_vertices_max] = {};
  uint8_t chosen_[k_polytope_vertices_max];  ///< the candidate vertices, ascending
  uint32_t count_ = 0;
  Vec32 direction_[2] = {};
};

/// Returns the separation of the bodies, 2^-46 m, along a unit direction from A to B (Q30, world axes).
int64_t separation(const PlacedPair& pair, const Vec32& direction, const CandidateSide& a, const CandidateSide& b);

/// Selects on both sides the vertices whose paths can bring them together along `normal`, which points from A to B in
/// world axes. Returns whether there are any. Sets `apart`, 2^-46 m: the distance of the bodies' positions along
/// `normal` at the beginning and at the end, minus StepPart::bend.
bool choose(const StepPart& part, const Vec32& normal, CandidateSide& a, CandidateSide& b, int64_t (&apart)[2]);

/// A world direction in the axes of a body.
inline Vec32 in_axes(const Matrix32& rotation, const Vec32& direction) { return rotate_inverse(rotation, direction); }
/// The normal of a face, in world axes, of length 1 in Q30; zero for a degenerate face.
Vec32 face_normal(const Polytope& polytope, uint32_t i, uint32_t j, uint32_t k, const Matrix32& rotation);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
