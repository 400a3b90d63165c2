#pragma once
#include <detent/toi.h>

#include "distance/gjk.h"
#include "toi_methods/feature_candidates.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The step is taken in parts in which the bodies turn no more than one of these relative to each other, Q30 rad.
inline constexpr int k_lengths = 3;
inline constexpr int64_t k_part_turn[k_lengths] = {1 << 30, 1 << 28, 1 << 25};
/// After so many parts the answer is `undecided`.
inline constexpr uint32_t k_parts_max = 4096;

/// The first contact of two features in an interval, certain.
struct CertifiedSearch {
  template <class Path>
  static void find(const Path& path, int64_t gap, const Interval& interval, FeatureToi& result) {
    search(path, gap, result, interval);
  }
};

/// The first contact of two polytopes in a motion as FeaturePath has it, as that of their features.
template <class Motion, class Search = CertifiedSearch>
class FeaturePairs {
 public:
  /// Range: Polytope::is_one(a), is_one(b).
  FeaturePairs(const Convex& a, const Convex& b, const Motion& motion) : a_(a), b_(b), motion_(motion) {
    const int64_t core_a = raw_core_radius(a), core_b = raw_core_radius(b);
    cores_ = core_a + core_b;
    depth_ = (core_a < core_b ? core_a : core_b) >> k_depth_shift;
    gap_ = near_gap(2 * larger(core_a, core_b), motion.ball());
    for (int i = 0; i < k_lengths; ++i) length_max_[i] = time_quotient(k_part_turn[i], motion.turn(k_time_end));
  }

  /// Of a hit the normal and the point are in the axes of the motion.
  void first_contact(const Interval& window, TimeOfImpact& result) {
    result = {};
    if (window.from > window.to) return set_clear(result);
    int64_t time = window.from;
    bool hit = false;
    part_.end = motion_.at(time);
    for (uint32_t count = 0; count < k_parts_max; ++count) {
      part_.begin = part_.end;
      result.time = Fraction::from_raw(time);
      if (look(hit, result)) {
        result.outcome = ToiOutcome::hit;
        return;
      }
      set_part(time, window.to);
      FeatureToi first = {ToiOutcome::clear, Fraction(1.0), 0};
      if (choose(part_, normal_, a_, b_, apart_)) {
        guess(first);
        if (first.outcome == ToiOutcome::clear || choose(part_, normal_, a_, b_, apart_)) find(first);
      }
      result.passes += first.intervals;
      if (first.outcome == ToiOutcome::undecided) {
        result.time = first.time;
        return;
      }
      hit = first.outcome == ToiOutcome::hit;
      if (!hit && part_.interval.to == window.to) {
        return set_clear(result);
      }
      time = part_.interval.to;
    }
  }

 private:
  /// Finds the axis that parts them at the part's beginning. Whether they meet there.
  bool look(bool hit, TimeOfImpact& result) {
    const int exponent = raw_exponent_above(saturated_sum(length_bound(part_.begin.offset), cores_ + 64));
    const Placed a = place(a_.convex(), part_.begin.a, exponent), b = place(b_.convex(), part_.begin.b, exponent);
    const GjkResult nearest = gjk(a, b, round_shift(part_.begin.offset, k_metre_bits - 30 + exponent), simplex_, {});
    ++result.gjk_calls;
    normal_ = nearest.normal;
    const bool overlap = nearest.outcome == GjkOutcome::overlap;
    if (!hit && !overlap && nearest.upper > (gap_ >> (k_metre_bits - 30 + exponent)) + k_near) return false;
    result.normal = units_from_raw(overlap ? Vec32{0, 0, 0} : normal_);
    result.point = surface_point(nearest_points(a, b, simplex_).on_a, exponent, normal_, 0);
    return true;
  }

  void set_end(int64_t from, int64_t to) {
    part_.interval = {from, to};
    part_.end = motion_.at(to);
    part_.turn = motion_.turn(to - from);
    const int64_t bend = motion_.bend(to - from), ball = motion_.ball();
    part_.bend = bend + 2 * ball;
    part_.way = add(part_.end.offset, negate(part_.begin.offset));
    part_.stray = 8 * bend + part_of(cores_ + length_bound(part_.way), part_.turn) + 2 * ball;
  }

  /// Chooses where a part that begins at `from` ends: as late as the normal is certain to part the bodies; else about
  /// where they are `depth_` beyond each other along it.
  void set_part(int64_t from, int64_t to) {
    for (int i = 0; i < k_lengths; ++i) {
      const int64_t length = to - from < length_max_[i] ? to - from : length_max_[i];
      set_end(from, from + length);
      const int64_t last = separation(part_.end, normal_, a_, b_) - part_.bend;
      if (last >= 0) return;
      if (i < k_lengths - 1 || last >= -depth_) continue;
      // Apart on chords is concave in time: they are no deeper there.
      const int64_t first = larger(separation(part_.begin, normal_, a_, b_), 0);
      const int64_t shorter = over_time(length, time_quotient(first + depth_, first - last));
      if (shorter > 0) set_end(from, from + shorter);
    }
  }

  /// Asks the features that are nearest at the beginning: where they meet in the part, few others may before.
  void guess(FeatureToi& first) {
    uint32_t of_a[4], of_b[4];
    const int count_a = distinct(&SimplexVertex::a, of_a), count_b = distinct(&SimplexVertex::b, of_b);
    if (count_a == 1 && count_b == 3)
      ask(FeatureKind::vertex_face, a_, b_, {of_a[0], of_b[0], of_b[1], of_b[2]}, first);
    else if (count_a == 3 && count_b == 1)
      ask(FeatureKind::vertex_face, b_, a_, {of_b[0], of_a[0], of_a[1], of_a[2]}, first);
    else if (count_a == 2 && count_b == 2)
      ask(FeatureKind::edge_edge, a_, b_, {of_a[0], of_a[1], of_b[0], of_b[1]}, first);
  }
  int distinct(CorePoint SimplexVertex::*of, uint32_t (&vertex)[4]) const {
    int count = 0;
    for (int i = 0; i < simplex_.count(); ++i) {
      const uint32_t feature = (simplex_.vertex(i).*of).feature;
      bool fresh = true;
      for (int j = 0; j < count; ++j) fresh = fresh && vertex[j] != feature;
      if (fresh) vertex[count++] = feature;
    }
    return count;
  }

  /// The first contact of all pairs in the part, which is cut off there.
  void find(FeatureToi& first) {
    find_on_faces(a_, b_, true, first);
    find_on_faces(b_, a_, false, first);
    EdgeFan fans[k_fans];
    int count = 0;
    for_each_edge(b_, part_.begin.b, [&](const EdgeFan& fan) {
      fans[count++] = fan;
      if (count < k_fans) return;
      find_on_edges(fans, count, first);
      count = 0;
    });
    find_on_edges(fans, count, first);
  }

  /// Vertices of one and faces of the other.
  void find_on_faces(const CandidateSide& side, const CandidateSide& other, bool side_is_a, FeatureToi& first) {
    const Matrix32 &rotation = side_is_a ? part_.begin.a : part_.begin.b,
                   &rotation_other = side_is_a ? part_.begin.b : part_.begin.a;
    other.polytope().for_each_face([&](uint32_t i, uint32_t j, uint32_t k) {
      if (!other.counts(i) && !other.counts(j) && !other.counts(k)) return;
      const Vec32 outward = face_normal(other.polytope(), i, j, k, rotation_other);
      const Vec32 inward = negate(outward);
      if (!part_.approaches(side_is_a ? inward : outward)) return;
      side.for_each_extreme(in_axes(rotation, inward), part_.turn, [&](uint32_t vertex) {
        ask(FeatureKind::vertex_face, side, other, {vertex, i, j, k}, first);
      });
    });
  }

  /// Edges of A and these of B.
  void find_on_edges(const EdgeFan* fans, int count, FeatureToi& first) {
    if (count == 0) return;
    for_each_edge(a_, part_.begin.a, [&](const EdgeFan& of_a) {
      for (int i = 0; i < count; ++i) {
        const EdgeFan& of_b = fans[i];
        if (!may_touch(of_a, of_b, part_)) continue;
        ask(FeatureKind::edge_edge, a_, b_, {of_a.from, of_a.to, of_b.from, of_b.to}, first);
      }
    });
  }

  template <class Visit>
  static void for_each_edge(const CandidateSide& side, const Matrix32& rotation, Visit&& visit) {
    const Polytope& polytope = side.polytope();
    for (uint32_t from = 0; from < polytope.vertex_count(); ++from) {
      const HullIndices neighbours = polytope.neighbours(from);
      for (uint32_t i = 0; i < neighbours.count; ++i) {
        const uint32_t to = neighbours.index[i];
        EdgeFan fan;
        if (to > from && side.counts(from, to) && side.fan(from, to, rotation, fan)) visit(fan);
      }
    }
  }

  /// Of a feature of one side and one of the other, which `vertex` names as FeatureKind has its corners. A contact cuts
  /// the part off.
  void ask(FeatureKind kind, const CandidateSide& side, const CandidateSide& other, const uint32_t (&vertex)[4],
           FeatureToi& first) {
    const int split = first_of_b(kind);
    bool meet = false;
    for (int end = 0; end < 2; ++end) {
      meet = meet || side.reach(vertex, split, end) + other.reach(vertex + split, 4 - split, end) >= apart_[end];
    }
    if (!meet) return;
    FeaturePath<Motion> path = {motion_, {part_.interval.from, part_.interval.to, part_.begin, part_.end},
                                kind,    &side == &b_,
                                {},      motion_.ball()};
    for (int i = 0; i < 4; ++i) path.corner[i] = (i < split ? side : other).corner(vertex[i]);
    FeatureToi found;
    Search::find(path, gap_, part_.interval, found);
    first.intervals += found.intervals;
    if (found.outcome == ToiOutcome::clear) return;
    first.outcome = found.outcome;
    first.time = found.time;
    if (found.time.raw != part_.interval.to) set_end(part_.interval.from, found.time.raw);
  }

  static constexpr int k_depth_shift = 5;
  static constexpr int k_fans = 32;      ///< of B's edges, kept at once
  static constexpr int32_t k_near = 64;  ///< ulps by which GJK's bound may be too large

  CandidateSide a_, b_;
  const Motion& motion_;
  int64_t cores_, gap_, depth_;    ///< 2^-46 m
  int64_t length_max_[k_lengths];  ///< of a part
  StepPart part_;
  Vec32 normal_;
  int64_t apart_[2];  ///< along it, of the positions at both ends of the part, less the bends
  Simplex simplex_;
};

/// By the step's own motion, certain: never late. Errors: bad_argument for a shape that is no polytope; as
/// time_of_impact().
Status time_of_impact_by_features(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                                  TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
