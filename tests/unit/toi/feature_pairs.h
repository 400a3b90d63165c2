#pragma once
#include "tests/unit/distance/closed_form.h"
#include "toi/feature_linear.h"

/// Pairs of features for the tests, in integers, constructed so that they have a known contact.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline Vec64 times(const Vec64& v, int64_t factor) { return {v.x * factor, v.y * factor, v.z * factor}; }
inline Vec64 difference(const Vec64& a, const Vec64& b) { return add(a, negate(b)); }
inline Vec64 random_corner(Samples& samples, int bits) {
  const auto component = [&] {
    return (static_cast<int64_t>(samples.bits() >> 1) >> (63 - bits)) - (int64_t{1} << (bits - 1));
  };
  const int64_t x = component(), y = component(), z = component();
  return {x, y, z};
}
inline Vector vector_of(const Vec64& v) {
  return {{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}};
}

/// Six times the signed volume of the tetrahedron of the four corners.
inline double feature_volume(const Vector (&p)[4]) { return dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]); }

/// The distance of two features, from their corners.
inline double feature_gap(FeatureKind kind, const Vector (&corner)[4]) {
  if (kind == FeatureKind::vertex_face) return distance_to_triangle(corner[0], corner[1], corner[2], corner[3]);
  return distance_of_segments(corner[0], corner[1], corner[2], corner[3]);
}
inline double feature_gap_at(const LinearFeatures& features, Fraction time) {
  Vector corner[4];
  for (int i = 0; i < 4; ++i) {
    corner[i] = vector_of(features.start[i]) +
                vector_of(difference(features.end[i], features.start[i])) * fraction_to_host(time);
  }
  return feature_gap(features.kind, corner);
}
inline double feature_size(const LinearFeatures& features) {
  return static_cast<double>(larger(size_of(features.kind, features.start), size_of(features.kind, features.end)));
}

/// The special property of a constructed pair.
enum class Special : uint32_t {
  none,
  tangent,  ///< at the contact the features move along each other
  flat,     ///< in one plane all the time
  line,     ///< at the contact one of them is a line less than it should be
  point,    ///< one of them is a point all the time
  rigid,    ///< all corners move alike: they touch all the time
};
inline constexpr uint32_t k_specials = 6;

/// Features that touch at exactly `time` 64ths of the step, and possibly earlier.
struct PlantedPair {
  LinearFeatures features;
  int time;
};

inline PlantedPair planted_pair(Samples& samples, Special special) {
  PlantedPair pair;
  LinearFeatures& f = pair.features;
  f.kind = samples.below(2) == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
  f.ball = 1;
  const bool edges = f.kind == FeatureKind::edge_edge;
  // The weights of the corners at the contact point, in 64ths. The weights of each feature add up to 64. The point is
  // often on an edge.
  int64_t weight[4] = {64, 0, 0, 0};
  const auto part = [&](uint32_t whole) {
    const uint32_t choice = samples.below(6);
    return static_cast<int64_t>(choice == 0 ? 0 : choice == 1 ? whole : samples.below(whole + 1));
  };
  if (edges) {
    weight[1] = part(64);
    weight[0] = 64 - weight[1];
    weight[3] = part(64);
    weight[2] = 64 - weight[3];
  } else {
    weight[3] = part(64);
    weight[2] = part(static_cast<uint32_t>(64 - weight[3]));
    weight[1] = 64 - weight[2] - weight[3];
  }
  const int first_of_b = edges ? 2 : 1;
  const int bits = 12 + static_cast<int>(samples.below(30)), speed = static_cast<int>(samples.below(44));
  Vec64 corner[4], linear_velocity[4];
  for (int i = 0; i < 4; ++i) {
    corner[i] = times(random_corner(samples, bits), 64);
    linear_velocity[i] = times(random_corner(samples, speed + 1), 64);
    if (special == Special::flat) corner[i].z = linear_velocity[i].z = 0;
  }
  if (special == Special::line) {  // the edges are parallel, or the face's corners on one line
    const Vec64 edge = difference(corner[3], corner[2]);
    if (edges) corner[1] = add(corner[0], samples.below(2) == 0 ? edge : negate(edge));
    if (!edges) corner[1] = add(corner[3], edge);
  }
  if (special == Special::point) {
    for (int i = 1; i < (edges ? 2 : 4); ++i) {
      corner[i] = corner[edges ? 0 : 1];
      linear_velocity[i] = linear_velocity[edges ? 0 : 1];
    }
  }
  // Translates A so that it touches B at the contact, with the chosen motion before and after.
  const auto gap_of = [&](const Vec64(&v)[4]) {
    Vec64 sum = {0, 0, 0};
    for (int i = 0; i < 4; ++i) sum = add(sum, times(v[i], i < first_of_b ? -weight[i] : weight[i]));
    return Vec64{sum.x / 64, sum.y / 64, sum.z / 64};
  };
  const Vec64 displacement = gap_of(corner), speed_gap = gap_of(linear_velocity);
  Vec64 along = {0, 0, 0};
  if (special == Special::tangent) {
    const Vec64 first = difference(corner[edges ? 1 : 2], corner[edges ? 0 : 1]);
    const Vec64 second = difference(corner[3], corner[edges ? 2 : 1]);
    const int64_t along_first = samples.integer(6), along_second = samples.integer(6);
    along = add(times(Vec64{first.x / 64, first.y / 64, first.z / 64}, along_first),
                times(Vec64{second.x / 64, second.y / 64, second.z / 64}, along_second));
  }
  for (int i = 0; i < first_of_b; ++i) {
    corner[i] = add(corner[i], displacement);
    if (special == Special::tangent) linear_velocity[i] = add(linear_velocity[i], add(speed_gap, along));
  }
  if (special == Special::rigid) {
    for (int i = 1; i < 4; ++i) linear_velocity[i] = linear_velocity[0];
  }
  pair.time = static_cast<int>(samples.below(65));
  for (int i = 0; i < 4; ++i) {
    f.start[i] = difference(corner[i], times(linear_velocity[i], pair.time));
    f.end[i] = add(corner[i], times(linear_velocity[i], 64 - pair.time));
  }
  // Permutes and mirrors the axes.
  const uint32_t rotation_vector = samples.below(3), mirror = samples.below(2);
  for (Vec64* corners : {f.start, f.end}) {
    for (int i = 0; i < 4; ++i) {
      const Vec64 v = corners[i];
      corners[i] = rotation_vector == 0 ? v : rotation_vector == 1 ? Vec64{v.y, v.z, v.x} : Vec64{v.z, v.x, v.y};
      if (mirror != 0) corners[i].x = -corners[i].x;
    }
  }
  return pair;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
