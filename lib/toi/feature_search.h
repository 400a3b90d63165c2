#pragma once
#include <detent/feature_toi.h>

#include "distance/pair.h"
#include "toi/feature_span.h"
#include "toi/moving_pair.h"

/// Code that all motions of features share: the search for the first contact, and the differences of corners.
namespace detent {
inline namespace DETENT_NAMESPACE {

constexpr int64_t larger(int64_t a, int64_t b) { return a > b ? a : b; }
constexpr int64_t largest_component(const Vec64& v) {
  return static_cast<int64_t>(
      larger(larger(static_cast<int64_t>(magnitude_64(v.x)), static_cast<int64_t>(magnitude_64(v.y))),
             static_cast<int64_t>(magnitude_64(v.z))));
}

/// Components of corners, displacements and offsets are at most 2^14 m in magnitude.
inline constexpr int k_range_bits = 14;

/// Whether every component, 2^-46 m, is within 2^bits m.
constexpr bool in_range(const Vec64& v, int bits) {
  return largest_component(v) <= int64_t{1} << (k_metre_bits + bits);
}
/// Converts corners from m to 2^-46 m. Returns false if a component is above 2^bits m in magnitude or is not a number.
inline bool raw_corners(const Vec3<Real> (&corner)[4], int bits, Vec64 (&raw)[4]) {
  for (int i = 0; i < 4; ++i) {
    if (!raw_from_real(corner[i], raw[i]) || !in_range(raw[i], bits)) return false;
  }
  return true;
}
/// The largest distance of a corner from the origin, rounded up.
inline int64_t radius_of(const Vec64* corner, int count) {
  int64_t radius = 0;
  for (int i = 0; i < count; ++i) radius = larger(radius, length_above(corner[i]));
  return radius;
}
/// Rotates v by m. Rounding: to nearest.
inline Vec64 rotated(const Matrix32& m, const Vec64& v) {
  const Vec32* c = m.column;
  const auto row = [&v](int32_t x, int32_t y, int32_t z) { return dot(v, Vec32{x, y, z}).round_shift(30); };
  return {row(c[0].x, c[1].x, c[2].x), row(c[0].y, c[1].y, c[2].y), row(c[0].z, c[1].z, c[2].z)};
}
constexpr bool is_kind(FeatureKind kind) { return kind == FeatureKind::vertex_face || kind == FeatureKind::edge_edge; }
/// The index of the first corner that belongs to B.
constexpr int first_of_b(FeatureKind kind) { return kind == FeatureKind::vertex_face ? 1 : 2; }

/// The differences of corners, those of B minus those of A, in order around the polygon. `corner` is in the order of
/// FeatureKind, relative to one common point.
inline void set_differences(FeatureKind kind, const Vec64 (&corner)[4], Vec64 (&difference)[4]) {
  const auto between = [&corner](int a, int b) { return add(corner[b], negate(corner[a])); };
  if (kind == FeatureKind::vertex_face) {
    for (int i = 0; i < 3; ++i) difference[i] = between(0, i + 1);
    return;
  }
  difference[0] = between(0, 2);
  difference[1] = between(0, 3);
  difference[2] = between(1, 3);
  difference[3] = between(1, 2);
}
constexpr int difference_count(FeatureKind kind) { return kind == FeatureKind::vertex_face ? 3 : 4; }

/// The largest component, in magnitude, of any edge of the two features.
inline int64_t size_of(FeatureKind kind, const Vec64 (&corner)[4]) {
  const auto edge = [&corner](int a, int b) { return largest_component(add(corner[b], negate(corner[a]))); };
  if (kind == FeatureKind::edge_edge) return larger(edge(0, 1), edge(2, 3));
  return larger(larger(edge(1, 2), edge(1, 3)), edge(2, 3));
}

/// Returns the gap below which features count as touching at the beginning of an interval that may hold a contact. It
/// is larger than the distance beyond which the result of open_part() is certainly empty. Therefore a short enough
/// interval is either ruled out, or its features are nearer than the gap at its beginning. k_feature_tolerance is
/// larger than the gap, because it includes the rounding.
constexpr int64_t near_gap(int64_t size, int64_t ball) { return larger(size >> 22, 2 * ball + 8); }

/// value times part, with `part` in Q30. Rounding: down. Range: 0 <= part <= 1.
inline int64_t part_of(int64_t value, int64_t part) {
  const Int128 product = Int128::product(value, part);
  return static_cast<int64_t>((static_cast<uint64_t>(product.high_word()) << 34) | (product.low_word() >> 30));
}

constexpr OpenPart both(const OpenPart& a, const OpenPart& b) {
  return {larger(a.from, b.from), a.to < b.to ? a.to : b.to};
}

/// An interval of time.
struct Interval {
  int64_t from, to;
};
/// Searches the first contact in intervals of time, earliest first. Cuts off the parts of an interval that are
/// certainly clear and halves the rest. An interval ends the search with a hit if the features are near at its
/// beginning or if it is too short to halve. The result is clear if no interval is left, and undecided after
/// k_feature_intervals_max intervals. `Path` has span(from, to), which returns a FeatureSpan. It may also have
/// roots(from, to), if it can bound the times of coplanar corners more tightly than the chords in a FeatureSpan do.
template <class Path>
void search(const Path& path, int64_t gap, FeatureToi& result, Interval now = {0, k_time_end}) {
  // Each waiting interval is at most half as long as the one that was added before it. So at most k_time_bits intervals
  // wait.
  Interval waiting[k_time_bits + 1];
  int count = 0;
  result = {};
  for (;;) {
    result.time = Fraction::from_raw(now.from);
    if (result.intervals == k_feature_intervals_max) return;
    ++result.intervals;
    const FeatureSpan span = path.span(now.from, now.to);
    OpenPart open = open_part(span);
    if constexpr (requires { path.roots(now.from, now.to); }) {
      if (open.from <= open.to) open = both(open, path.roots(now.from, now.to));
    }
    if (open.from > open.to) {
      if (count == 0) break;
      now = waiting[--count];
      continue;
    }
    const int64_t length = now.to - now.from;
    if (begins_near(span, gap) || length < 2) {
      result.outcome = ToiOutcome::hit;
      return;
    }
    const int64_t first = now.from + part_of(length, open.from);
    const int64_t last = now.to - part_of(length, k_whole - open.to);
    now = {first, last};
    if (last - first <= length / 2) continue;
    const int64_t middle = first + (last - first) / 2;
    waiting[count++] = {middle, last};
    now.to = middle;
  }
  result.outcome = ToiOutcome::clear;
  result.time = Fraction(1.0);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
