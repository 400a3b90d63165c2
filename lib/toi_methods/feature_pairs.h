#pragma once
#include <detent/toi.h>

#include "distance/gjk.h"
#include "toi_methods/feature_candidates.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The search divides the step into parts. In each part, the bodies rotate relative to each other by at most one of
/// these angles, Q30 rad.
inline constexpr int k_lengths = 3;
inline constexpr int64_t k_part_turn[k_lengths] = {1 << 30, 1 << 28, 1 << 25};
/// The maximum number of parts. If they do not suffice, the result is `undecided`.
inline constexpr uint32_t k_parts_max = 4096;

/// Search strategy for FeaturePairs: finds the certified first contact of two features in an interval.
struct CertifiedSearch {
  template <class Path>
  static void find(const Path& path, int64_t gap, const Interval& interval, FeatureToi& result) {
    search(path, gap, result, interval);
  }
};

/// Finds the first contact of two polytopes as the first contact of their features. `Motion` is as in FeaturePath.
template <class Motion, class Search = CertifiedSearch>
class FeaturePairs {
 public:
  /// Range: both shapes are polytopes (Polytope::is_one()).
  FeaturePairs(const Convex& a, const Convex& b, const Motion& motion) : a_(a), b_(b), motion_(motion) {
    const int64_t core_a = raw_core_radius(a), core_b = raw_core_radius(b);
    cores_ = core_a + core_b;
    depth_ = (core_a < core_b ? core_a : core_b) >> k_depth_shift;
    gap_ = near_gap(2 * larger(core_a, core_b), motion.ball());
    for (int i = 0; i < k_lengths; ++i) length_max_[i] = time_quotient(k_part_turn[i], motion.angle_in(k_time_end));
  }

  /// Finds the first contact in the window. The normal and the point of a hit are in the frame in which Motion::at()
  /// gives the poses.
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
  /// Finds the nearest points at the beginning of the part, and the normal between them. Returns whether the bodies
  /// touch there: if `hit`, or if they overlap or are near. If they touch, also sets the result's normal and point.
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
    part_.angle = motion_.angle_in(to - from);
    const int64_t bend = motion_.bend(to - from), ball = motion_.ball();
    part_.bend = bend + 2 * ball;
    part_.displacement = add(part_.end.offset, negate(part_.begin.offset));
    part_.stray = 8 * bend + part_of(cores_ + length_bound(part_.displacement), part_.angle) + 2 * ball;
  }

  /// Chooses the end of a part that begins at `from`. The part gets the longest allowed length over which the normal
  /// certainly separates the bodies. If there is no such length, the part gets the shortest allowed length, or ends
  /// earlier: at about the time at which the bodies overlap by `depth_` along the normal.
  void set_part(int64_t from, int64_t to) {
    for (int i = 0; i < k_lengths; ++i) {
      const int64_t length = to - from < length_max_[i] ? to - from : length_max_[i];
      set_end(from, from + length);
      const int64_t last = separation(part_.end, normal_, a_, b_) - part_.bend;
      if (last >= 0) return;
      if (i < k_lengths - 1 || last >= -depth_) continue;
      // The separation of points that move on chords is concave in time, so the overlap at the new end is at most
      // `depth_`.
      const int64_t first = larger(separation(part_.begin, normal_, a_, b_), 0);
      const int64_t shorter = over_time(length, time_quotient(first + depth_, first - last));
      if (shorter > 0) set_end(from, from + shorter);
    }
  }

  /// Tests the pair of features that is nearest at the beginning of the part. If these features touch in the part, few
  /// other pairs can touch earlier.
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

  /// Finds the first contact of all feature pairs in the part. Shortens the part so that it ends at the contact.
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

  /// Tests vertices of `side` and faces of `other`.
  void find_on_faces(const CandidateSide& side, const CandidateSide& other, bool side_is_a, FeatureToi& first) {
    const Matrix32 &rotation = side_is_a ? part_.begin.a : part_.begin.b,
                   &rotation_other = side_is_a ? part_.begin.b : part_.begin.a;
    other.polytope().for_each_face([&](uint32_t i, uint32_t j, uint32_t k) {
      if (!other.counts(i) && !other.counts(j) && !other.counts(k)) return;
      const Vec32 outward = face_normal(other.polytope(), i, j, k, rotation_other);
      const Vec32 inward = negate(outward);
      if (!part_.approaches(side_is_a ? inward : outward)) return;
      side.for_each_extreme(in_axes(rotation, inward), part_.angle, [&](uint32_t vertex) {
        ask(FeatureKind::vertex_face, side, other, {vertex, i, j, k}, first);
      });
    });
  }

  /// Tests all edges of A against the `count` edges of B in `fans`.
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

  /// Tests a feature of `side` against a feature of `other`. `vertex` lists the vertices in the corner order of
  /// FeatureKind. Shortens the part so that it ends at a contact.
  void ask(FeatureKind kind, const CandidateSide& side, const CandidateSide& other, const uint32_t (&vertex)[4],
           FeatureToi& first) {
    const int split = first_of_b(kind);
    bool meet = false;
    for (int end = 0; end < 2; ++end) {
      meet = meet || side.extent(vertex, split, end) + other.extent(vertex + split, 4 - split, end) >= apart_[end];
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
  static constexpr int k_fans = 32;      ///< capacity for edges of B that are tested together
  static constexpr int32_t k_near = 64;  ///< ulps by which GJK's bound may be too large

  CandidateSide a_, b_;
  const Motion& motion_;
  int64_t cores_, gap_, depth_;    ///< 2^-46 m
  int64_t length_max_[k_lengths];  ///< limits for the length of a part
  StepPart part_;
  Vec32 normal_;
  int64_t apart_[2];  ///< distance of the positions along normal_ at both ends of the part, minus part_.bend
  Simplex simplex_;
};

/// The time of impact of two polytopes by their features, in the step's own motion. The result is certified: never
/// late. Errors: bad_argument for a shape that is not a polytope; other errors as time_of_impact().
Status time_of_impact_by_features(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                                  TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
