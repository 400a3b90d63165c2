#pragma once
#include "distance/polytope.h"
#include "toi/feature_path.h"

/// Which features of two polytopes may be the first to meet in a part of a step. Where polytopes first touch, the
/// outward normals that they have there in common, one's and the other's negated, are a cone. Each ray on its border is
/// the normal of a face of one of them, and that face touches a vertex; or it is perpendicular to an edge of each, and
/// those touch. So a pair counts only if it can be extreme like that, and only if its vertices' ways bring them
/// together.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A part of a step, and where the bodies are at its ends.
struct StepPart {
  Interval interval;
  PlacedPair begin, end;
  int64_t turn;   ///< Q30 rad; the bodies turn no more relative to each other
  int64_t bend;   ///< 2^-46 m; a difference of a point of each is never farther from its chord, roundings included
  Vec64 way;      ///< of B from A over the part, 2^-46 m
  int64_t stray;  ///< 2^-46 m; along a normal as it is at the beginning, points that touch move by `way`, give or take
                  ///< this, if they go on over the part as they do then

  /// Whether points that touch with this outward normal of A, at the beginning, may come nearer: of the normals that
  /// two bodies have in common when they first touch, one that bounds them is such.
  bool approaches(const Vec32& normal) const { return dot(way, normal).round_shift(30) <= stray; }
};

/// An edge and the outward normals of the faces beside it as EdgeFaces, world axes, of length 1 in Q30; zero where they
/// are degenerate.
struct EdgeFan {
  uint8_t from, to;
  Vec32 along, left, right;
};

/// Whether two edges of A and B can touch from outside in a part, and come nearer.
bool may_touch(const EdgeFan& a, const EdgeFan& b, const StepPart& part);

/// One of two polytopes, and its vertices that count.
class CandidateSide {
 public:
  explicit CandidateSide(const Convex& convex) : convex_(convex), hull_(hull_of(convex)), polytope_(convex) {}

  const Convex& convex() const { return convex_; }
  const Polytope& polytope() const { return polytope_; }
  bool counts(uint32_t vertex) const { return counts_[vertex]; }
  bool counts(uint32_t from, uint32_t to) const { return counts_[from] || counts_[to]; }

  /// In the body's axes, 2^-46 m.
  Vec64 corner(uint32_t vertex) const;
  /// How far the body comes from its position along a direction in its axes of length 1, Q30: 2^-46 m.
  int64_t reach(const Vec32& direction) const { return metres(farthest(direction)); }
  /// Those vertices count that come `least` far, 2^-46 m, in such a direction at the beginning or at the end.
  void choose(const Vec32 (&direction)[2], const int64_t (&least)[2]);
  /// How far some vertices come in that direction, at the most, at either end.
  int64_t reach(const uint32_t* vertex, int count, int end) const {
    int64_t most = INT64_MIN;
    for (int i = 0; i < count; ++i) most = larger(most, dot(direction_[end], polytope_.vertex(vertex[i])));
    return metres(most);
  }
  /// Of the vertices that count, those that are the farthest in such a direction, or can be after a turn: calls
  /// visit(vertex).
  template <class Visit>
  void for_each_extreme(const Vec32& direction, int64_t turn, Visit&& visit) const {
    const int64_t least = farthest(direction) - 2 * int64_t{convex_.core_radius} * (turn + k_unit_error);
    for (uint32_t i = 0; i < count_; ++i) {
      if (dot(direction, polytope_.vertex(chosen_[i])) >= least) visit(uint32_t{chosen_[i]});
    }
  }
  /// False for an edge that lies in a face.
  bool fan(uint32_t from, uint32_t to, const Matrix32& rotation, EdgeFan& fan) const;

  /// Of the product of two rotated unit vectors: 2^-30.
  static constexpr int64_t k_unit_error = 64;

 private:
  /// 2^-30 of Q30 of the unit.
  int64_t farthest(const Vec32& direction) const {
    return dot(direction, local_support(convex_, hull_, direction, 0).local);
  }
  int64_t metres(int64_t along) const;

  const Convex& convex_;
  const HullView hull_;
  const Polytope polytope_;
  bool counts_[k_polytope_vertices_max] = {};
  uint8_t chosen_[k_polytope_vertices_max];  ///< those that count, ascending
  uint32_t count_ = 0;
  Vec32 direction_[2] = {};
};

/// How far the bodies are apart along a direction, A first, of length 1 in Q30, world axes: 2^-46 m.
int64_t separation(const PlacedPair& pair, const Vec32& direction, const CandidateSide& a, const CandidateSide& b);

/// Leaves in both sides those vertices whose ways can bring them together along `normal`, from A to B, world axes.
/// Whether any are left.
bool choose(const StepPart& part, const Vec32& normal, CandidateSide& a, CandidateSide& b, int64_t (&apart)[2]);

/// The direction of a unit vector in a body's axes.
inline Vec32 in_axes(const Matrix32& rotation, const Vec32& direction) { return rotate_inverse(rotation, direction); }
/// The normal of a face, in world axes, of length 1 in Q30; zero for a degenerate one.
Vec32 face_normal(const Polytope& polytope, uint32_t i, uint32_t j, uint32_t k, const Matrix32& rotation);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
