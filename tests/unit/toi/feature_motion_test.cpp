#include <detent/feature_toi.h>
#include <stdlib.h>

#include "base/digest.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/exact_numbers.h"
#include "tests/unit/toi/feature_pairs.h"
#include "tests/unit/toi/spread.h"

/// Features of bodies with constant velocity and angular velocity.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;
using detent_test::Figures;
using detent_test::time_of;

/// Two features of moving bodies, with the values that the configuration stores.
struct MovingFeatures {
  FeatureKind kind;
  Vector corner[4];
  BodyAt a, b;

  bool edges() const { return kind == FeatureKind::edge_edge; }
  void place(double time, Vector (&placed)[4]) const {
    const BodyAt at_a = a.at(time), at_b = b.at(time);
    for (int i = 0; i < 4; ++i) placed[i] = (i < first_of_b(kind) ? at_a : at_b).to_world(corner[i]);
  }
  double gap(double time) const {
    Vector placed[4];
    place(time, placed);
    return feature_gap(kind, placed);
  }
  double volume(double time) const {
    Vector placed[4];
    place(time, placed);
    return feature_volume(placed);
  }
  double distance_max() const {
    double of_a = 0, of_b = 0;
    for (int i = 0; i < 4; ++i) {
      double& distance_max = i < first_of_b(kind) ? of_a : of_b;
      distance_max = std::max(distance_max, length(corner[i]));
    }
    return of_a + of_b;
  }
  double size() const {
    const auto edge = [this](int i, int j) { return length(corner[i] - corner[j]); };
    return edges() ? std::max(edge(0, 1), edge(2, 3)) : std::max({edge(1, 2), edge(1, 3), edge(2, 3)});
  }
  FeatureToi answer() const {
    Figures figures;
    return answer(figures);
  }
  FeatureToi answer(Figures& figures) const {
    const Vec3<Real> corners[4] = {reals(corner[0]), reals(corner[1]), reals(corner[2]), reals(corner[3])};
    const Motion motion_a = motion_of(a), motion_b = motion_of(b);
    FeatureToi result;
    figures.times.push_back(time_of(3, [&] { EXPECT_OK(feature_toi(kind, corners, motion_a, motion_b, result)); }));
    figures.intervals.push_back(result.intervals);
    return result;
  }
  /// The answer of conservative advancement for the same features, as triangles with coinciding corners.
  TimeOfImpact advanced(Figures& figures) const {
    const Vec3<Real> p[4] = {reals(corner[0]), reals(corner[1]), reals(corner[2]), reals(corner[3])};
    const Vec3<Real> of_a[3] = {p[0], p[edges() ? 1 : 0], p[0]};
    const Vec3<Real> of_b[3] = {p[edges() ? 2 : 1], p[edges() ? 3 : 2], p[edges() ? 2 : 3]};
    Convex convex_a, convex_b;
    EXPECT_OK(make_triangle(of_a, Real(0.0), convex_a));
    EXPECT_OK(make_triangle(of_b, Real(0.0), convex_b));
    const Motion motion_a = motion_of(a), motion_b = motion_of(b);
    TimeOfImpact result;
    figures.other_times.push_back(
        time_of(3, [&] { EXPECT_OK(time_of_impact(convex_a, motion_a, convex_b, motion_b, result)); }));
    return result;
  }
};

MovingFeatures random_features(Samples& samples, double turn_max) {
  MovingFeatures f;
  f.kind = samples.below(2) == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
  for (Vector& corner : f.corner) {
    const Vector displacement = random_direction(samples);
    corner = host(reals(displacement * uniform(samples, 0.2, 1)));
  }
  for (BodyAt* body : {&f.a, &f.b}) {
    body->rotation = random_quaternion(samples);
    const Vector axis = random_direction(samples);
    body->rotation_vector = axis * uniform(samples, 0, turn_max);
  }
  // B starts at a random distance and moves towards A, with a random lateral component.
  const Vector displacement = random_direction(samples), across = random_direction(samples);
  f.b.position = displacement * uniform(samples, 0.5, 2.5);
  f.b.displacement = displacement * -uniform(samples, 0.5, 3.5);
  f.b.displacement = f.b.displacement + across * uniform(samples, 0, 0.7);
  f.a = held(f.a);
  f.b = held(f.b);
  return f;
}

constexpr double k_reference_error = 1e-13;
/// Relative to the size of the pair: the library rounds rotations on entry, and the reference does not.
constexpr double k_pose_error = 2 * k_number_error;

/// The first sampled time at which the volume changes its sign and the features touch, which is a certain contact. 1 if
/// there is none.
double crossing_before(const MovingFeatures& f, double end, int count) {
  double from = 0, before = f.volume(0);
  for (int i = 1; i <= count; ++i) {
    const double to = end * i / count, after = f.volume(to);
    if ((before < 0) != (after < 0)) {
      double low = from, high = to;
      for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        ((f.volume(middle) < 0) == (before < 0) ? low : high) = middle;
      }
      if (f.gap(low) < k_reference_error) return low;
    }
    from = to;
    before = after;
  }
  return 1;
}

void expect_not_late(const MovingFeatures& f, double time, int count) {
  const double contact = crossing_before(f, time, count);
  if (contact < time) {
    EXPECT_LE(f.gap(time), k_pose_error * f.distance_max()) << "a contact at " << contact << " was missed";
  }
}

/// Checks the claims of both methods, and that neither reports a time later than a contact.
void expect_agreement(const MovingFeatures& f, Figures& figures, uint32_t& hits, uint32_t& apart) {
  const FeatureToi result = f.answer(figures);
  const TimeOfImpact other = f.advanced(figures);
  const double time = fraction_to_host(result.time), other_time = fraction_to_host(other.time);
  // The library rounds a pose; the reference holds it in doubles.
  const double tolerance = k_feature_tolerance * f.size() + 0x1p-23 * f.distance_max() + 1e-12;
  const double other_tolerance = k_toi_tolerance * 2 * f.distance_max() + 160 * 0x1p-28 * f.distance_max();
  EXPECT_NE(result.outcome, ToiOutcome::undecided);
  if (result.outcome == ToiOutcome::hit) {
    ++hits;
    EXPECT_LE(f.gap(time), tolerance);
  }
  if (other.outcome == ToiOutcome::hit) {
    EXPECT_LE(f.gap(other_time), other_tolerance);
  }
  apart += result.outcome != other.outcome || fabs(time - other_time) > 1e-4 ? 1u : 0u;
  expect_not_late(f, std::max(time, other_time), 48);
}

DETENT_TEST(feature_motion, agrees_with_conservative_advancement_and_is_never_late) {
  // A million pairs with DETENT_FULL; the sampled contacts take most of the time.
  const uint32_t count = getenv("DETENT_FULL") != nullptr ? 1000000 : rounds(4000);
  Samples samples{91};
  uint32_t hits = 0, apart = 0;
  const double turn_max[4] = {0, 0.1, 1, 3};
  Figures figures[4];
  for (uint32_t i = 0; i < count; ++i) {
    const MovingFeatures features = random_features(samples, turn_max[i % 4]);
    SCOPED_TRACE(testing::Message() << "pair " << i);
    expect_agreement(features, figures[i % 4], hits, apart);
    if (testing::Test::HasFailure()) return;
  }
  for (int i = 0; i < 4; ++i) figures[i].print(turn_max[i]);
  printf("%u pairs: %u hits, %u with times more than 1e-4 apart\n", count, hits, apart);
  EXPECT_GT(hits, count / 20);
  EXPECT_LE(apart, count / 1000 + 1);
}

DETENT_TEST(feature_motion, many_turns_are_decided_or_safe) {
  Samples samples{92};
  uint32_t undecided = 0;
  Figures figures;
  const uint32_t count = rounds(200);
  for (uint32_t i = 0; i < count; ++i) {
    const MovingFeatures f = random_features(samples, 60);
    const FeatureToi result = f.answer(figures);
    const double time = fraction_to_host(result.time);
    SCOPED_TRACE(testing::Message() << "pair " << i);
    EXPECT_LE(result.intervals, k_feature_intervals_max);
    undecided += result.outcome == ToiOutcome::undecided ? 1u : 0u;
    expect_not_late(f, time, 600);
    if (result.outcome == ToiOutcome::hit) {
      EXPECT_LE(f.gap(time), k_feature_tolerance * f.size() + 0x1p-23 * f.distance_max() + 1e-12);
    }
  }
  figures.print(60);
  EXPECT_EQ(undecided, 0u);
  // 10,000 turns near another feature need too many intervals: the answer is only a safe time.
  MovingFeatures f = random_features(samples, 0);
  f.b.position = {{0, 0, 6}};
  f.b.displacement = {{0, 0, -4.5}};
  f.b.rotation_vector = {{60000, 0, 0}};
  f.b = held(f.b);
  const FeatureToi result = f.answer();
  EXPECT_NE(result.outcome, ToiOutcome::clear);
  EXPECT_GT(fraction_to_host(result.time), 0.4);
}

DETENT_TEST(feature_motion, a_turning_edge_meets_one_at_rest_when_it_lies_along_it) {
  // A quarter turn about z takes the edge from x to y, where the other edge is 0.5 above.
  const Vector corner[4] = {{{0.25, 0, 0}}, {{1, 0, 0}}, {{0, 0.5, -1}}, {{0, 0.5, 1}}};
  MovingFeatures f = {FeatureKind::edge_edge, {corner[0], corner[1], corner[2], corner[3]}, {}, {}};
  f.a.rotation_vector = {{0, 0, acos(-1.0)}};
  f.a = held(f.a);
  const FeatureToi result = f.answer();
  EXPECT_EQ(result.outcome, ToiOutcome::hit);
  EXPECT_LE(fraction_to_host(result.time), 0.5 + 1e-7);
  EXPECT_GE(fraction_to_host(result.time), 0.5 - 2e-6);
}

DETENT_TEST(feature_motion, a_vertex_that_grazes_a_face_at_the_top_of_its_arc_is_a_hit) {
  // The vertex moves on a circle of 1 m. In mid-step it touches the plane y = 1, and does not touch y = 1.00001.
  for (const double height : {1.0, 1.00001, 0.99999, 0.5}) {
    MovingFeatures f = {FeatureKind::vertex_face, {{{1, 0, 0}}, {{-2, 0, -2}}, {{2, 0, -2}}, {{0, 0, 2}}}, {}, {}};
    f.a.rotation_vector = {{0, 0, acos(-1.0)}};
    f.b.position = {{0, height, 0}};
    f.a = held(f.a);
    f.b = held(f.b);
    const FeatureToi result = f.answer();
    EXPECT_EQ(result.outcome, height > 1 ? ToiOutcome::clear : ToiOutcome::hit);
    const double contact = asin(std::min(1.0, f.b.position[1])) / acos(-1.0);
    EXPECT_LE(fraction_to_host(result.time), height > 1 ? 1 : contact + 1e-7);
    EXPECT_GE(fraction_to_host(result.time), contact - 2e-3);  // 1e-6 m below the top
    EXPECT_LE(result.intervals, 64u);
  }
}

DETENT_TEST(feature_motion, a_vertex_that_turns_in_the_plane_of_a_face_meets_its_edge) {
  // The face's nearest edge is x = -0.5; the rotating vertex reaches it at 120 degrees.
  MovingFeatures f = {FeatureKind::vertex_face, {{{1, 0, 0}}, {{-0.5, -2, 0}}, {{-0.5, 2, 0}}, {{-3, 0, 0}}}, {}, {}};
  f.a.rotation_vector = {{0, 0, acos(-1.0)}};
  f.a = held(f.a);
  const FeatureToi result = f.answer();
  EXPECT_EQ(result.outcome, ToiOutcome::hit);
  EXPECT_LE(fraction_to_host(result.time), 2.0 / 3 + 1e-7);
  EXPECT_GE(fraction_to_host(result.time), 2.0 / 3 - 2e-6);
  f.corner[1][0] = f.corner[2][0] = -1.00001;
  EXPECT_EQ(f.answer().outcome, ToiOutcome::clear);
}

DETENT_TEST(feature_motion, bad_questions_are_refused_and_change_nothing) {
  const Vec3<Real> corners[4] = {reals({{0, 1, 0}}), reals({{-1, 0, -1}}), reals({{1, 0, -1}}), reals({{0, 0, 1}})};
  const Motion still_motion;
  FeatureToi result;
  result.intervals = 77;
  const auto ask = [&](const Motion& a, const Motion& b) {
    return feature_toi(FeatureKind::vertex_face, corners, a, b, result);
  };
  EXPECT_EQ(feature_toi(static_cast<FeatureKind>(0), corners, still_motion, still_motion, result),
            Status::bad_argument);
  Motion motion = still_motion;
  motion.start.rotation.w = Unit(0.5);
  EXPECT_EQ(ask(motion, still_motion), Status::not_normalised);
  EXPECT_EQ(ask(still_motion, motion), Status::not_normalised);
  motion = still_motion;
  motion.rotation_vector.y = real(65537);
  EXPECT_EQ(ask(motion, still_motion), Status::out_of_range);
  motion = still_motion;
  motion.displacement.z = real(-16385);
  EXPECT_EQ(ask(still_motion, motion), Status::out_of_range);
  motion = still_motion;
  EXPECT_OK(coord_from_host(16385, motion.start.position.x));
  EXPECT_EQ(ask(still_motion, motion), Status::out_of_range);
  Vec3<Real> far[4] = {corners[0], corners[1], corners[2], corners[3]};
  far[2].x = real(16385);
  EXPECT_EQ(feature_toi(FeatureKind::edge_edge, far, still_motion, still_motion, result), Status::out_of_range);
  EXPECT_EQ(result.intervals, 77u);
}

/// Numbers that every configuration holds exactly, so that its answers may be compared.
DETENT_TEST(feature_motion, answers_are_the_same_in_every_configuration_and_on_every_target) {
  Samples samples{93};
  const auto vector = [&samples](int64_t most) { return exact_vector(samples, most); };
  uint64_t digest = 0;
  for (int i = 0; i < 1000; ++i) {
    Motion motion[2];
    for (Motion& m : motion) {
      m.start = exact_pose(samples, vector(300));
      m.displacement = reals(vector(512));
      m.rotation_vector = reals(vector(i % 3 == 0 ? 1 : 512));
    }
    const Vec3<Real> corner[4] = {reals(vector(256)), reals(vector(256)), reals(vector(256)), reals(vector(256))};
    FeatureToi result;
    EXPECT_OK(feature_toi(i % 2 == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge, corner, motion[0], motion[1],
                          result));
    digest = digest_step(digest, static_cast<uint64_t>(result.time.raw));
    digest = digest_step(digest, static_cast<uint64_t>(result.outcome) << 32 | result.intervals);
  }
  EXPECT_EQ(digest_finish(digest), 0x7792ce0a58c0e25u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
