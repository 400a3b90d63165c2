#pragma once
#include "tests/common/oracle/convex_distance.h"

/// When two moving convex solids first meet, and how near they come, with a certificate.
///
/// The gap is signed: the distance of the rounded solids, or minus their depth. A *sample* is the gap at one time, by
/// convex_distance.h. Between two samples, at x and y = x + L, the gap is bounded from below by each of:
/// - the distance of the cores' bounding spheres, exactly;
/// - the samples less the greatest speed of any point;
/// - any turning axis n(t) = exp(Omega (t - x)) n(x), Omega constant: for a vertex of A and one of B the separation
///   n.(offset + b - a) is a smooth f(t) with |f''| <= K, so that f is not below its chord less K (t - x)(y - t) / 2,
///   and therefore neither is the least of all vertices: s(t) >= chord of s(x) and s(y) - K (t - x)(y - t) / 2.
///   Only support values at the ends are needed, for curved cores too.
///   With w a body's angular velocity, r its reach, u = w - Omega, V the relative velocity:
///   K = |n x Omega| (2 |V| + |Omega| max |offset|), and for each body r (|n x u| |u| + |w x Omega|),
///   where |n x u| <= min(|u|, |n(x) x u| + L |n x Omega| |u|); for Omega = 0 r is the reach from the axis of angular
///   velocity. Tried: Omega 0, A's angular velocity, B's angular velocity, and from the nearest axis at x to that at y.
///
/// Intervals are cut until each time of the step is under such a bound, less rounding_of(). So certified are, with
/// dip = 1e-12 of the size or 4 rounding_of(), whichever is larger:
/// - of a hit: |gap| at `time` is at most `contact`, as far as the sample's own bounds tell (1e-15 of the size), and
///   before it the gap was nowhere under -dip. So the time is the first at which the gap is 0, unless it dipped to
///   between 0 and -dip before.
/// - of a clear step: the gap is nowhere under `gap_min_floor`: 0.999 gap_min - dip / 10, where that takes too many
///   samples 0.99 gap_min - dip / 10, else -dip. `gap_min` is attained.
///
/// `certain` tells when that leaves no doubt about hit or clear: a clear step with a positive floor; a hit with a depth
/// beyond dip at some time. If the budget of samples ended the search, `complete` is false (no query did so far).
/// How deep a hit goes is an estimate from samples shortly after the contact: the true depth is not less.
namespace detent_oracle {

struct Verdict {
  bool hit = false;
  bool certain = false;
  bool complete = true;
  Number time = 1;     ///< of a hit: the first contact; 0 if overlapped at the start
  Number contact = 0;  ///< m, the tolerance of a contact: 1e-15 of the size or rounding_of()
  Number gap_min = 0;  ///< m, clear: the least gap of the step; hit: the deepest found by sampling (an estimate), <= 0
  Number gap_min_time = 0;   ///< of gap_min
  Number gap_min_floor = 0;  ///< m, clear: certified lower bound of the gap; hit: of the gap before `time`
  Number size = 0;           ///< m, size_of()
  int samples = 0;
};

Verdict judge(const detent_queries::Query& query);
Verdict judge(const Encounter& encounter);

/// The signed gap at a time, m: below 0 minus the depth.
Number signed_gap_at(const detent_queries::Query& query, Number time);
Number signed_gap_at(const Encounter& encounter, Number time);

/// A turning axis over an interval, for the tests of the bound: how much the chord may exceed the separation in the
/// middle, K L^2 / 8, m.
Number chord_excess(const Encounter& encounter, const Arrow& axis, const Arrow& omega, Number from, Number to);

}  // namespace detent_oracle
