#include <detent/feature_toi.h>

#include "base/digest.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/exact_numbers.h"
#include "tests/unit/toi/feature_pairs.h"
#include "tests/unit/toi/spread.h"

/// Features in the screw motion between two poses, compared with the screw's axis and with the roots of its reduced
/// cubic.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;
using detent_test::Figures;
using detent_test::time_of;

Quaternion conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }
Vector turned(const Quaternion& q, const Vector& v) {
  return axis_of(q, 0) * v[0] + axis_of(q, 1) * v[1] + axis_of(q, 2) * v[2];
}

/// The relative motion: the axis, a point on it, the angle, and the displacement along the axis.
struct Screw {
  FeatureKind kind;
  Vector corner[4];  ///< at the start, in A's axes from A's position
  Vector axis, on_axis;
  double tangent, along, radius, size;

  void place(double time, Vector (&placed)[4]) const {
    const Quaternion rotation_vector = detent_oracle::rotation_by(axis * (2 * atan(time * tangent)));
    for (int i = 0; i < 4; ++i) {
      placed[i] = i < first_of_b(kind) ? corner[i]
                                       : on_axis + turned(rotation_vector, corner[i] - on_axis) + axis * (along * time);
    }
  }
  double gap(double time) const {
    Vector placed[4];
    place(time, placed);
    return feature_gap(kind, placed);
  }
  /// The volume of the features times 1 + t^2 tangent^2: a cubic in time.
  double reduced(double time) const {
    Vector placed[4];
    place(time, placed);
    return feature_volume(placed) * (1 + time * time * tangent * tangent);
  }
};

struct Bodies {
  FeatureKind kind;
  Vector corner[4];
  BodyAt start_a, end_a, start_b, end_b;

  FeatureToi answer() const {
    Figures figures;
    return answer(figures);
  }
  FeatureToi answer(Figures& figures) const {
    const Vec3<Real> corners[4] = {reals(corner[0]), reals(corner[1]), reals(corner[2]), reals(corner[3])};
    const PosePair a = {pose_of(start_a), pose_of(end_a)}, b = {pose_of(start_b), pose_of(end_b)};
    FeatureToi result;
    figures.times.push_back(time_of(3, [&] { EXPECT_OK(feature_toi_screw(kind, corners, a, b, result)); }));
    figures.intervals.push_back(result.intervals);
    return result;
  }
  Screw screw() const {
    Screw s;
    s.kind = kind;
    const Vector first = start_a.to_local(start_b.position), last = end_a.to_local(end_b.position),
                 displacement = last - first;
    const Quaternion from = conjugate(normalised(start_a.rotation)) * normalised(start_b.rotation);
    const Quaternion to = conjugate(normalised(end_a.rotation)) * normalised(end_b.rotation);
    const Quaternion rotation_vector = to * conjugate(from);
    const Vector g = Vector{{rotation_vector.x, rotation_vector.y, rotation_vector.z}} * (1 / rotation_vector.w);
    s.tangent = length(g);
    s.axis = g * (1 / s.tangent);
    s.along = dot(displacement, s.axis);
    const Vector across = displacement - s.axis * s.along;
    s.on_axis = first + (across - cross(s.axis, across) * -(1 / s.tangent)) * 0.5;
    double radius = 0;
    for (int i = 0; i < 4; ++i) {
      s.corner[i] = i < first_of_b(kind) ? corner[i] : first + turned(from, corner[i]);
      if (i >= first_of_b(kind)) radius = std::max(radius, length(corner[i]));
    }
    s.radius = radius + length(first) + length(last);
    const auto edge = [this](int i, int j) { return length(corner[i] - corner[j]); };
    s.size = kind == FeatureKind::edge_edge ? std::max(edge(0, 1), edge(2, 3))
                                            : std::max({edge(1, 2), edge(1, 3), edge(2, 3)});
    return s;
  }
};

Bodies random_bodies(Samples& samples) {
  Bodies bodies;
  bodies.kind = samples.below(2) == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
  for (Vector& corner : bodies.corner) {
    const Vector displacement = random_direction(samples);
    corner = host(reals(displacement * uniform(samples, 0.2, 1)));
  }
  const double angle = uniform(samples, 0.01, 1.2);
  const auto pose_near = [&](const BodyAt& body) {
    const Vector axis = random_direction(samples), displacement = random_direction(samples);
    BodyAt other = body;
    other.rotation = detent_oracle::rotation_by(axis * angle) * body.rotation;
    other.position = body.position + displacement * uniform(samples, 0, 0.5);
    return other;
  };
  const Vector displacement = random_direction(samples);
  bodies.start_a.rotation = random_quaternion(samples);
  bodies.end_a = pose_near(bodies.start_a);
  bodies.start_b.rotation = random_quaternion(samples);
  bodies.start_b.position = displacement * uniform(samples, 0.5, 2);
  bodies.end_b = pose_near(bodies.start_b);
  bodies.end_b.position = bodies.end_b.position + displacement * -uniform(samples, 0.5, 3);
  for (BodyAt* body : {&bodies.start_a, &bodies.end_a, &bodies.start_b, &bodies.end_b}) *body = held(*body);
  return bodies;
}

/// The real roots in [0, 1] of the cubic with these values at 0, 1/3, 2/3 and 1, in closed form, sorted.
std::vector<double> roots_of(const double (&v)[4]) {
  const double d = v[0], c = (-11 * v[0] + 18 * v[1] - 9 * v[2] + 2 * v[3]) / 2,
               b = 9 * (2 * v[0] - 5 * v[1] + 4 * v[2] - v[3]) / 2, a = 9 * (-v[0] + 3 * v[1] - 3 * v[2] + v[3]) / 2;
  std::vector<double> roots;
  const auto add_polished = [&](double t) {
    for (int i = 0; i < 3; ++i) {
      const double slope = (3 * a * t + 2 * b) * t + c;
      if (slope != 0) t -= (((a * t + b) * t + c) * t + d) / slope;
    }
    if (t >= 0 && t <= 1) roots.push_back(t);
  };
  const double p = (3 * a * c - b * b) / (3 * a * a),
               q = (2 * b * b * b - 9 * a * b * c + 27 * a * a * d) / (27 * a * a * a);
  const double middle = -b / (3 * a), discriminant = q * q / 4 + p * p * p / 27;
  if (discriminant > 0) {
    const double root = sqrt(discriminant);
    add_polished(middle + cbrt(-q / 2 + root) + cbrt(-q / 2 - root));
  } else {
    const double radius = 2 * sqrt(-p / 3), angle = acos(clamped(3 * q / (p * radius), -1, 1)) / 3;
    for (int i = 0; i < 3; ++i) add_polished(middle + radius * cos(angle - i * 2 * acos(-1.0) / 3));
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

DETENT_TEST(feature_screw, agrees_with_the_roots_of_the_reduced_cubic) {
  const double pose_error = 8 * k_number_error + 4 * k_position_step;
  Samples samples{94};
  uint32_t hits = 0, later = 0;
  Figures figures;
  const uint32_t count = rounds(3000);
  for (uint32_t i = 0; i < count; ++i) {
    const Bodies bodies = random_bodies(samples);
    const Screw screw = bodies.screw();
    const FeatureToi result = bodies.answer(figures);
    SCOPED_TRACE(testing::Message() << "pair " << i);
    const double values[4] = {screw.reduced(0), screw.reduced(1.0 / 3), screw.reduced(2.0 / 3), screw.reduced(1)};
    double contact = 2;
    for (const double root : roots_of(values)) {
      if (contact > 1 && screw.gap(root) < 1e-11) contact = root;
    }
    const double time = fraction_to_host(result.time);
    const double tolerance = k_feature_tolerance * screw.size + 0x1p-21 * screw.radius + pose_error * screw.radius;
    EXPECT_NE(result.outcome, ToiOutcome::undecided);
    if (result.outcome == ToiOutcome::hit) {
      ++hits;
      EXPECT_LE(screw.gap(time), tolerance);
      later += contact > time + 1e-4 ? 1u : 0u;
    }
    if (contact < time) {
      EXPECT_LE(screw.gap(time), pose_error * screw.radius) << "a contact at " << contact << " was missed";
    }
    if (testing::Test::HasFailure()) return;
  }
  figures.print(1.2);
  printf("%u pairs: %u hits\n", count, hits);
  EXPECT_GT(hits, count / 20);
  EXPECT_LE(later, count / 500 + 1);
}

DETENT_TEST(feature_screw, without_a_turn_is_a_straight_line) {
  Samples samples{95};
  for (uint32_t i = 0; i < rounds(500); ++i) {
    Bodies bodies = random_bodies(samples);
    bodies.start_a.rotation = bodies.end_a.rotation = bodies.start_b.rotation = bodies.end_b.rotation = {0, 0, 0, 1};
    Vec3<Real> start[4], end[4];
    for (int k = 0; k < 4; ++k) {
      const bool of_a = k < first_of_b(bodies.kind);
      start[k] = reals(bodies.corner[k] + (of_a ? bodies.start_a : bodies.start_b).position);
      end[k] = reals(bodies.corner[k] + (of_a ? bodies.end_a : bodies.end_b).position);
    }
    FeatureToi line;
    EXPECT_OK(feature_toi_linear(bodies.kind, start, end, line));
    const FeatureToi screw = bodies.answer();
    EXPECT_EQ(screw.outcome, line.outcome) << "pair " << i;
    EXPECT_NEAR(fraction_to_host(screw.time), fraction_to_host(line.time), 1e-4) << "pair " << i;
  }
}

DETENT_TEST(feature_screw, bad_questions_are_refused_and_change_nothing) {
  const Vec3<Real> corners[4] = {reals({{0, 1, 0}}), reals({{-1, 0, -1}}), reals({{1, 0, -1}}), reals({{0, 0, 1}})};
  FeatureToi result;
  result.intervals = 77;
  const auto ask = [&](const PosePair& a, const PosePair& b) {
    return feature_toi_screw(FeatureKind::vertex_face, corners, a, b, result);
  };
  const PosePair rest;
  EXPECT_EQ(feature_toi_screw(static_cast<FeatureKind>(7), corners, rest, rest, result), Status::bad_argument);
  const auto rotated_by = [](double angle) {
    PosePair poses;
    BodyAt body;
    body.rotation_vector = {{0, 0, angle}};
    poses.end = pose_of(body.at(1));
    return poses;
  };
  // The relative rotation counts, by the shorter way: the tangent of 2.66 / 2 is above 4.
  for (const double angle : {2.66, 3.0, 3.15, 3.6}) {
    EXPECT_EQ(ask(rotated_by(angle), rest), Status::out_of_range);
    EXPECT_EQ(ask(rest, rotated_by(angle)), Status::out_of_range);
    EXPECT_EQ(ask(rotated_by(angle / 2), rotated_by(-angle / 2)), Status::out_of_range);
  }
  PosePair bad = rest;
  bad.end.rotation.w = Unit(0.5);
  EXPECT_EQ(ask(bad, rest), Status::not_normalised);
  EXPECT_EQ(ask(rest, bad), Status::not_normalised);
  bad = rest;
  EXPECT_OK(coord_from_host(-1025, bad.start.position.y));
  EXPECT_EQ(ask(bad, rest), Status::out_of_range);
  EXPECT_EQ(ask(rest, bad), Status::out_of_range);
  Vec3<Real> far[4] = {corners[0], corners[1], corners[2], corners[3]};
  far[3].z = real(1025);
  EXPECT_EQ(feature_toi_screw(FeatureKind::edge_edge, far, rest, rest, result), Status::out_of_range);
  EXPECT_EQ(result.intervals, 77u);
  for (const double angle : {2.64, -2.64, 3.7}) EXPECT_OK(ask(rest, rotated_by(angle)));
}

/// Numbers that every configuration holds exactly, so that its answers may be compared.
DETENT_TEST(feature_screw, answers_are_the_same_in_every_configuration_and_on_every_target) {
  Samples samples{96};
  const auto vector = [&samples](int64_t most) { return exact_vector(samples, most); };
  uint64_t digest = 0;
  for (int i = 0; i < 1000; ++i) {
    PosePair body[2];
    for (PosePair& poses : body) {
      for (Pose* pose : {&poses.start, &poses.end}) *pose = exact_pose(samples, vector(300));
    }
    const Vec3<Real> corner[4] = {reals(vector(256)), reals(vector(256)), reals(vector(256)), reals(vector(256))};
    FeatureToi result;
    EXPECT_OK(feature_toi_screw(i % 2 == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge, corner, body[0],
                                body[1], result));
    digest = digest_step(digest, static_cast<uint64_t>(result.time.raw));
    digest = digest_step(digest, static_cast<uint64_t>(result.outcome) << 32 | result.intervals);
  }
  EXPECT_EQ(digest_finish(digest), 0x8c14fb81d783f5d0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
