#include <detent/distance.h>

#include "distance/pair.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/closed_form.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;

/// Relative to extent(): the error that the header states, plus the rounding of the numbers of the configuration.
constexpr double k_error = k_distance_error + k_number_error;

struct Pair {
  KnownShape a, b;
  BodyAt body_a, body_b;  ///< as held

  double extent() const { return extent_of(a, body_a, b, body_b); }
  /// An error of the rotation moves a plane by that error times the whole distance.
  double slack() const { return k_error * extent() + k_number_error * length(body_b.position - body_a.position); }
  Closest closest(DistanceCache* cache = nullptr) const {
    Closest result;
    EXPECT_OK(closest_points(a.convex, pose_of(body_a), b.convex, pose_of(body_b), result, cache));
    return result;
  }
  Pair swapped() const { return {b, a, body_b, body_a}; }
};

/// The distance between a point (m, from the body's position, world axes) and the surface of the shape.
double off_surface(const KnownShape& shape, const BodyAt& body, const Vector& point) {
  return fabs(core_distance(shape, body.to_local(body.position + point)) - shape.ball);
}

/// The points lie on the surfaces, and are the distance apart along the normal.
void expect_witnesses(const Pair& pair, const Closest& closest) {
  const Vector from = host(closest.point_a), to = host(closest.point_b), normal = host_units(closest.normal);
  const double slack = 2 * pair.slack();
  EXPECT_NEAR(length(normal), 1, 4 * k_number_error);
  if (closest.capped || closest.overlap) return;
  EXPECT_LE(off_surface(pair.a, pair.body_a, from), slack);
  EXPECT_LE(off_surface(pair.b, pair.body_b, to), slack);
  const Vector displacement = pair.body_b.position - pair.body_a.position + to - from;
  EXPECT_LE(length(displacement - normal * host(closest.distance)), slack);
}

/// `distance`: between the surfaces, m; 0 or less if they overlap.
void expect_distance(const Pair& pair, double distance) {
  const double slack = pair.slack();
  for (const Pair& either : {pair, pair.swapped()}) {
    const Closest closest = either.closest();
    if (closest.capped) {
      EXPECT_LE(host(closest.distance), distance + slack);
      continue;
    }
    EXPECT_NEAR(host(closest.distance), std::max(distance, 0.0), slack);
    if (distance > slack) {
      EXPECT_FALSE(closest.overlap);
    }
    if (distance < -slack) {
      EXPECT_TRUE(closest.overlap);
    }
    if (distance > slack) expect_witnesses(either, closest);
    if (closest.overlap) {
      EXPECT_EQ(host(closest.distance), 0);
    }
  }
}

constexpr int k_scales[] = {-9, -5, 0, 3, 6};

DETENT_TEST(distance, of_a_ball_from_every_shape_is_that_of_its_centre_in_closed_form) {
  Samples samples{1};
  uint32_t capped = 0, apart = 0;
  const uint32_t count = rounds(1500);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t kind = i % (k_known_kinds + k_known_hulls);
    const double scale = kind < k_known_kinds ? ldexp(1, k_scales[samples.below(5)]) : 1;
    Pair pair;
    pair.a = random_shape(samples, kind, scale);
    pair.b = random_shape(samples, 0, scale);
    pair.body_a = {random_direction(samples) * scale, random_quaternion(samples)};
    // A random position, or one straight above a feature: along an axis, or slightly off it.
    Vector local = random_direction(samples) * (scale * uniform(samples, 0.5, 4));
    if (samples.below(2) == 0) {
      for (int k = 0; k < 3; ++k) local[k] *= samples.below(2) == 0 ? 0 : samples.below(2) == 0 ? 1e-6 : 1;
    }
    pair.body_a = held(pair.body_a);
    pair.body_b = held({pair.body_a.to_world(local), random_quaternion(samples)});
    local = pair.body_a.to_local(pair.body_b.position);
    const double core = core_distance(pair.a, local);
    const bool solid = pair.a.points.size() > 3 && pair.a.type() != ShapeType::box;
    if (solid && length(local) < pair.a.distance_max()) continue;  // the closed form does not know the inside
    SCOPED_TRACE(testing::Message() << "pair " << i << ", kind " << kind << ", scale " << scale);
    expect_distance(pair, core - pair.a.ball - pair.b.ball);
    if (HasFailure()) return;
    capped += pair.closest().capped ? 1u : 0u;
    apart += pair.closest().overlap ? 0u : 1u;
  }
  EXPECT_EQ(capped, 0u);
  EXPECT_GT(apart, count / 3);
}

DETENT_TEST(distance, of_polytopes_is_that_of_their_nearest_features) {
  constexpr uint32_t k_kinds[] = {0, 1, 2, 6, 8};
  Samples samples{2};
  uint32_t apart = 0;
  const uint32_t count = rounds(600);
  for (uint32_t i = 0; i < count; ++i) {
    const double scale = ldexp(1, k_scales[samples.below(5)]);
    Pair pair;
    const uint32_t kind = k_kinds[samples.below(5)];
    pair.a = random_shape(samples, k_kinds[samples.below(4)], scale);
    pair.b = random_shape(samples, kind, scale);
    pair.body_a = held({random_direction(samples) * scale, random_quaternion(samples)});
    // Every third pair has a common axis.
    const Quaternion rotation = i % 3 == 0 ? pair.body_a.rotation : random_quaternion(samples);
    const double near = pair.a.distance_max() + pair.b.distance_max() + pair.a.ball + pair.b.ball;
    pair.body_b =
        held({pair.body_a.position + random_direction(samples) * (near * uniform(samples, 0.5, 1.5)), rotation});
    const Closest closest = pair.closest();
    const double gap = polytope_distance(pair.a, pair.body_a, pair.b, pair.body_b) - pair.a.ball - pair.b.ball;
    if (closest.overlap && gap > 0) continue;  // the nearest features do not tell of one piercing the other
    SCOPED_TRACE(testing::Message() << "pair " << i << ", scale " << scale);
    expect_distance(pair, gap);
    if (HasFailure()) return;
    ++apart;
  }
  EXPECT_GT(apart, count / 2);
}

DETENT_TEST(distance, of_a_half_space_is_the_height_of_the_lowest_point) {
  Samples samples{3};
  const uint32_t count = rounds(1000);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t kind = i % (k_known_kinds + 2);
    const double scale = kind < k_known_kinds ? ldexp(1, k_scales[samples.below(5)]) : 1;
    Pair pair;
    pair.a = known(half_space());
    pair.b = random_shape(samples, kind, scale);
    pair.body_a = held({random_direction(samples) * (4 * scale), random_quaternion(samples)});
    const Quaternion rotation = i % 3 == 0 ? pair.body_a.rotation : random_quaternion(samples);
    pair.body_b = held({random_direction(samples) * (4 * scale), rotation});
    const Vector up = axis_of(pair.body_a.rotation, 1);
    SCOPED_TRACE(testing::Message() << "pair " << i << ", kind " << kind << ", scale " << scale);
    expect_distance(pair, lowest(pair.b, pair.body_b, up) - dot(up, pair.body_a.position) - pair.b.ball);
    if (HasFailure()) return;
  }
}

DETENT_TEST(distance, names_points_of_a_rim_that_are_on_the_rim) {
  const Convex convexes[] = {known(cylinder(1.0, 0.5)).convex, known(cone(1.0, 0.5)).convex};
  for (const Convex& convex : convexes) {
    for (int32_t x = 0; x < 40; ++x) {
      for (int32_t z = 0; z < 40; ++z) {
        if (x == 0 && z == 0) continue;
        const Vec32 local = local_support(convex, {x, -(1 << 30), z}).local;
        EXPECT_NEAR(hypot(local.x, local.z), convex.size[0], 4) << x << ' ' << z;
        if (HasFailure()) return;
      }
    }
  }
}

DETENT_TEST(distance, names_the_point_of_a_half_space_that_is_below_the_other_body) {
  const Pair pair = {known(half_space()), known(sphere(0.5)), held({}), held({{{3, 2, -5}}})};
  const Closest closest = pair.closest(), swapped = pair.swapped().closest();
  EXPECT_NEAR(host(closest.distance), 1.5, pair.slack());
  for (const auto& [point, expected] :
       {std::pair{closest.point_a, Vector{{3, 0, -5}}}, std::pair{closest.point_b, Vector{{0, -0.5, 0}}},
        std::pair{swapped.point_b, Vector{{3, 0, -5}}}, std::pair{swapped.point_a, Vector{{0, -0.5, 0}}}}) {
    EXPECT_LE(length(host(point) - expected), 4 * pair.slack())
        << host(point.x) << ' ' << host(point.y) << ' ' << host(point.z);
  }
}

/// A pair placed by hand, at unit size, with its distance.
struct PlacedByHand {
  const char* text;
  Shape (*a)(double s);
  BodyAt body_a;
  Shape (*b)(double s);
  BodyAt body_b;
  double distance;
};

Shape ball_of(double s) { return sphere(real(0.5 * s)); }
Shape rod_of(double s) { return capsule(real(0.25 * s), real(1 * s)); }
Shape cube_of(double s) { return box({real(0.5 * s), real(0.5 * s), real(0.5 * s)}); }
Shape plate_of(double s) { return box({real(1 * s), real(0.125 * s), real(1 * s)}); }
Shape drum_of(double s) { return cylinder(real(0.5 * s), real(0.25 * s)); }
Shape hat_of(double s) { return cone(real(0.5 * s), real(0.5 * s)); }
Shape round_hat_of(double s) { return rounded(cone(real(0.5 * s), real(0.5 * s)), real(0.125 * s)); }

const double k_root_half = sqrt(0.5);
const Quaternion k_quarter_z = {0, 0, k_root_half, k_root_half};  // y to -x, x to y
const Quaternion k_quarter_x = {k_root_half, 0, 0, k_root_half};  // y to z
const Quaternion k_half_x = {1, 0, 0, 0};
const double k_eighth_sine = sin(acos(-1.0) / 8), k_eighth_cosine = cos(acos(-1.0) / 8);
const Quaternion k_eighth_z = {0, 0, k_eighth_sine, k_eighth_cosine};
const Quaternion k_eighth_x = {k_eighth_sine, 0, 0, k_eighth_cosine};

const PlacedByHand k_placed[] = {
    {"spheres", ball_of, {{{0, 0, 0}}}, ball_of, {{{0, 3, 4}}}, 4},
    {"spheres that touch", ball_of, {{{0, 0, 0}}}, ball_of, {{{1, 0, 0}}}, 0},
    {"parallel capsules", rod_of, {{{0, 0, 0}}}, rod_of, {{{2, 0.5, 0}}}, 1.5},
    {"capsules in line", rod_of, {{{0, 0, 0}}}, rod_of, {{{0, 3, 0}}}, 0.5},
    {"crossed capsules", rod_of, {{{0, 0, 0}}}, rod_of, {{{0, 0, 1}}, k_quarter_z}, 0.5},
    {"capsules end to side", rod_of, {{{0, 0, 0}}}, rod_of, {{{2, 0, 0}}, k_quarter_z}, 0.5},
    {"cubes face to face", cube_of, {{{0, 0, 0}}}, cube_of, {{{1.5, 0.25, 0.125}}}, 0.5},
    {"cubes edge to parallel edge", cube_of, {{{0, 0, 0}}}, cube_of, {{{4, 5, 0}}}, 5},
    {"cubes vertex to vertex", cube_of, {{{0, 0, 0}}}, cube_of, {{{2, 3, 3}}}, 3},
    {"cubes edge to face", cube_of, {{{0, 0, 0}}}, cube_of, {{{2, 0, 0}}, k_eighth_z}, 1.5 - k_root_half},
    {"cubes edge across edge",
     cube_of,
     {{{0, 0, 0}}, k_eighth_z},
     cube_of,
     {{{0, 2, 0}}, k_eighth_x},
     2 - 2 * k_root_half},
    {"plates, the thin side", plate_of, {{{0, 0, 0}}}, plate_of, {{{0.25, 0.5, 0.25}}}, 0.25},
    {"drum's cap on a plate", plate_of, {{{0, 0, 0}}}, drum_of, {{{0.25, 0.625, 0}}}, 0.25},
    {"drum's side on a plate", plate_of, {{{0, 0, 0}}}, drum_of, {{{0, 1, 0}}, k_quarter_z}, 0.375},
    {"drum's rim on a plate", plate_of, {{{0, 0, 0}}}, drum_of, {{{0, 1, 0}}, k_eighth_z}, 0.875 - 0.75 * k_root_half},
    {"drums side by side", drum_of, {{{0, 0, 0}}}, drum_of, {{{2, 0, 0}}}, 1},
    {"drums cap to cap", drum_of, {{{0, 0, 0}}}, drum_of, {{{0.25, 1, 0}}}, 0.5},
    {"ball off a drum's rim", drum_of, {{{0, 0, 0}}}, ball_of, {{{3.5, 4.25, 0}}}, 4.5},
    {"hat's tip on a plate", plate_of, {{{0, 0, 0}}}, hat_of, {{{0, 1, 0}}, k_half_x}, 0.125},
    {"hat's base on a plate", plate_of, {{{0, 0, 0}}}, hat_of, {{{0, 1, 0}}}, 0.625},
    {"hats tip to tip", hat_of, {{{0, 0, 0}}}, hat_of, {{{0, 2, 0}}, k_half_x}, 0.5},
    {"round hats tip to tip", round_hat_of, {{{0, 0, 0}}}, round_hat_of, {{{0, 2, 0}}, k_half_x}, 0.25},
    {"ball above a hat's tip", hat_of, {{{0, 0, 0}}}, ball_of, {{{0, 2, 0}}}, 0.75},
    {"ball off a hat's side", hat_of, {{{0, 0, 0}}}, ball_of, {{{2.25, 1.25, 0}}}, sqrt(5.0) - 0.5},
    {"capsules that cross at the middle", rod_of, {{{0, 0, 0}}}, rod_of, {{{0, 0, 0}}, k_quarter_x}, -0.5},
    {"cubes at one place", cube_of, {{{0, 0, 0}}}, cube_of, {{{0, 0, 0}}}, -1},
    {"hat in a drum", drum_of, {{{0, 0, 0}}}, hat_of, {{{0, 0, 0}}}, -0.5},
};

DETENT_TEST(distance, of_pairs_placed_by_hand_at_every_scale) {
  for (const PlacedByHand& placed : k_placed) {
    for (int exponent = -9; exponent <= 6; ++exponent) {
      SCOPED_TRACE(testing::Message() << placed.text << " times 2^" << exponent);
      const double scale = ldexp(1, exponent);
      BodyAt body_a = placed.body_a, body_b = placed.body_b;
      body_a.position = body_a.position * scale;
      body_b.position = body_b.position * scale;
      if (!(held(body_b).position[0] == body_b.position[0]) || !(held(body_b).position[1] == body_b.position[1]))
        continue;
      const Pair pair = {known(placed.a(scale)), known(placed.b(scale)), held(body_a), held(body_b)};
      expect_distance(pair, placed.distance * scale);
    }
  }
}

/// Two shapes of any kind, but not two half-spaces; near each other or overlapped.
Pair random_pair(Samples& samples, double scale, uint32_t kinds) {
  Pair pair;
  const uint32_t kind_b = samples.below(kinds);
  pair.a = random_shape(samples, samples.below(kinds == k_known_kinds ? kinds : kinds - 1), scale);
  pair.b = random_shape(samples, kind_b, scale);
  pair.body_a = held({random_direction(samples) * scale, random_quaternion(samples)});
  pair.body_b = held({pair.body_a.position + random_direction(samples) * (scale * uniform(samples, 0, 4)),
                      random_quaternion(samples)});
  return pair;
}

void expect_same(const Closest& a, const Closest& b) {
  EXPECT_EQ(a.overlap, b.overlap);
  EXPECT_EQ(a.capped, b.capped);
  EXPECT_TRUE(a.distance == b.distance);
  EXPECT_TRUE(a.normal == b.normal);
  EXPECT_TRUE(a.point_a == b.point_a);
  EXPECT_TRUE(a.point_b == b.point_b);
  EXPECT_EQ(a.iterations, b.iterations);
}

DETENT_TEST(distance, is_the_same_from_a_warm_or_a_garbage_cache) {
  Samples samples{4};
  uint32_t iterations = 0, warm_iterations = 0;
  const uint32_t count = rounds(1000);
  for (uint32_t i = 0; i < count; ++i) {
    const Pair pair = random_pair(samples, 1, k_known_kinds + k_known_hulls);
    SCOPED_TRACE(testing::Message() << "pair " << i);
    DistanceCache cache;
    const Closest cold = pair.closest(), fresh = pair.closest(&cache);
    expect_same(cold, fresh);
    const Closest warm = pair.closest(&cache);
    iterations += cold.iterations;
    warm_iterations += warm.iterations;
    std::vector<Closest> others = {warm};
    for (int k = 0; k < 4; ++k) {
      DistanceCache garbage;
      garbage.count = static_cast<uint8_t>(k == 0 ? 255 : samples.below(6));
      for (int j = 0; j < 4; ++j) {
        garbage.vertex_a[j] = static_cast<uint8_t>(samples.below(k < 2 ? 256 : 4));
        garbage.vertex_b[j] = static_cast<uint8_t>(samples.below(k < 2 ? 256 : 4));
      }
      others.push_back(pair.closest(&garbage));
      EXPECT_LE(garbage.count, 4);
      others.push_back(pair.closest(&garbage));
    }
    for (const Closest& other : others) {
      if (other.capped || cold.capped) continue;
      EXPECT_NEAR(host(other.distance), host(cold.distance), 2 * pair.slack());
      if (host(cold.distance) > 2 * pair.slack()) {
        EXPECT_FALSE(other.overlap);
        expect_witnesses(pair, other);
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_LT(warm_iterations, iterations);
}

DETENT_TEST(distance, agrees_with_overlap_and_farther_than) {
  Samples samples{5};
  uint32_t met = 0;
  const uint32_t count = rounds(1500);
  for (uint32_t i = 0; i < count; ++i) {
    const Pair pair =
        random_pair(samples, ldexp(1, k_scales[samples.below(4)]), k_known_kinds + (i % 2) * k_known_hulls);
    const Pose pose_a = pose_of(pair.body_a), pose_b = pose_of(pair.body_b);
    const Closest closest = pair.closest();
    SCOPED_TRACE(testing::Message() << "pair " << i);
    const double distance = host(closest.distance), slack = pair.slack();
    const double rounding = k_config == Config::f32 ? 0x1p-24 : 0;  // of the distance
    DistanceCache caches[2];
    for (DistanceCache* cache : {static_cast<DistanceCache*>(nullptr), &caches[0], &caches[0]}) {
      bool overlaps = false;
      EXPECT_OK(overlap(pair.a.convex, pose_a, pair.b.convex, pose_b, overlaps, cache));
      if (closest.overlap) {
        EXPECT_TRUE(overlaps);
      }
      if (!closest.capped && distance > slack) {
        EXPECT_FALSE(overlaps);
      }
      met += overlaps ? 1u : 0u;
    }
    const double extent = pair.extent();
    const double reaches[] = {0,        distance / 2, distance - 8 * slack, distance - slack,
                              distance, extent,       distance + 2 * slack, 2 * distance + extent,
                              0x1p13};
    for (const double distance_max : reaches) {
      if (distance_max < 0) continue;
      for (DistanceCache* cache : {static_cast<DistanceCache*>(nullptr), &caches[1]}) {
        bool farther = false;
        const double asked = host(real(distance_max));
        EXPECT_OK(farther_than(pair.a.convex, pose_a, pair.b.convex, pose_b, real(distance_max), farther, cache));
        if (farther && !closest.capped) {
          EXPECT_GT(distance * (1 + rounding), asked) << distance_max;
        }
        if (closest.overlap) {
          EXPECT_FALSE(farther);
        }
        if (!closest.capped && distance > asked + 4 * slack) {
          EXPECT_TRUE(farther) << distance_max << " of " << distance;
        }
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(met, count / 4);
}

#if defined(DETENT_FX64)
/// Two shapes whose rims are so near each other that GJK reaches its cap; and their gap, m, from the oracle.
Pair capped_rims(double& gap, bool apart) {
  if (apart) {
    gap = 2.36417e-05;
    return {
        known(cylinder(real(0.2536868155002594), real(0.9702257513999939))),
        known(rounded(cylinder(real(0.90363997220993042), real(0.55049967765808105)), real(0.16366420686244965))),
        held({{{0, 0, 0}}, {0.13429878280257843, -0.44336487075732756, -0.85909013920227728, -0.21761332919078297}}),
        held({{{0.024926366051658988, -0.42521723639219999, -1.564807744929567}},
              {0.18405317698040286, 0.50295586129784564, -0.83346068471360335, 0.1360261616980136}})};
  }
  gap = -2.03677e-06;
  return {known(cone(real(0.18763792514801025), real(0.51488965749740601))),
          known(cone(real(0.7877657413482666), real(0.88238513469696045))),
          held({{{0, 0, 0}}, {0.74156858761890598, 0.5976191357822912, -0.25720938943531696, -0.16361762860413334}}),
          held({{{-0.83469825144857168, 0.87825434189289808, 0.121598020195961}},
                {0.61609216747263029, -0.37452905512393414, -0.40582613532636497, -0.56166144244813232}})};
}

DETENT_TEST(distance, claims_no_overlap_where_the_cap_was_met) {
  double gap = 0;
  const Pair pair = capped_rims(gap, true);
  const Closest closest = pair.closest();
  EXPECT_FALSE(closest.overlap) << "gap " << gap;
  EXPECT_NEAR(host(closest.distance), gap, pair.slack());
}

DETENT_TEST(distance, overlap_is_not_denied_where_the_cap_was_met) {
  double gap = 0;
  const Pair pair = capped_rims(gap, false);
  bool overlaps = false;
  EXPECT_OK(overlap(pair.a.convex, pose_of(pair.body_a), pair.b.convex, pose_of(pair.body_b), overlaps));
  EXPECT_TRUE(overlaps) << "gap " << gap << ", slack " << pair.slack();
}
#endif

DETENT_TEST(distance, of_far_bodies_holds_and_saturates_beyond_2_to_the_17_m) {
  const KnownShape ball = known(sphere(1.0)), cube = known(box({0.5, 0.5, 0.5}));
  const double far = k_config == Config::fx32 ? 30e3 : 100e3;
  for (const double distance : {far, far / 2, far / 1000}) {
    const BodyAt left = held({{{-distance / 2, 0, 0}}}), right = held({{{distance / 2, 0, 0}}});
    expect_distance({ball, cube, left, right}, distance - 1.5);
    expect_distance({cube, known(half_space()), right, held({{{0, -distance / 2, 0}}})}, distance / 2 - 0.5);
  }
#if !defined(DETENT_FX32)
  for (const double distance : {0x1p17, 0x1p18, 1e6, 1e9}) {
    for (const Vector& displacement : {Vector{{1, 0, 0}}, Vector{{-0.6, 0.8, 0}}, Vector{{0.6, 0.64, 0.48}}}) {
      const BodyAt left = {displacement * (-distance / 2)}, right = {displacement * (distance / 2)};
      for (const KnownShape& other : {cube, ball, known(cylinder(1.0, 1.0))}) {
        Closest closest;
        EXPECT_OK(closest_points(ball.convex, pose_of(left), other.convex, pose_of(right), closest));
        EXPECT_FALSE(closest.overlap);
        EXPECT_GE(host(closest.distance), 0x1.fffp16);
        EXPECT_LE(host(closest.distance), 0x1p17);
        bool farther = false, overlaps = true;
        EXPECT_OK(farther_than(ball.convex, pose_of(left), other.convex, pose_of(right), real(1e5), farther));
        EXPECT_TRUE(farther) << distance;
        EXPECT_OK(overlap(ball.convex, pose_of(left), other.convex, pose_of(right), overlaps));
        EXPECT_FALSE(overlaps);
      }
    }
  }
#endif
}

#if !defined(DETENT_FX32)
DETENT_TEST(distance, beyond_2_to_the_17_m_has_a_normal_towards_the_other_body) {
  const KnownShape ball = known(sphere(1.0)), cube = known(box({0.5, 0.5, 0.5}));
  for (const double distance : {0x1p17, 0x1p18, 1e9}) {
    for (const Vector& displacement : {Vector{{1, 0, 0}}, Vector{{-0.6, 0.8, 0}}, Vector{{0.6, 0.64, 0.48}}}) {
      const Pair pair = {ball, cube, {displacement * (-distance / 2)}, {displacement * (distance / 2)}};
      EXPECT_GT(dot(host_units(pair.closest().normal), displacement), 0.5)
          << displacement[0] << ' ' << displacement[1] << ' ' << displacement[2] << " times " << distance;
    }
  }
}

DETENT_TEST(distance, of_a_half_space_whose_position_is_far_away_is_refused) {
  const KnownShape ball = known(sphere(1.0)), ground = known(half_space());
  Samples samples{8};
  for (uint32_t i = 0; i < rounds(200); ++i) {
    const BodyAt plane = held({{{0, 0, 0}}, random_quaternion(samples)});
    const Vector up = axis_of(plane.rotation, 1);
    const double height = pow(2, uniform(samples, 14, 28));
    for (const double sign : {1.0, -1.0}) {
      Closest closest;
      const Status status =
          closest_points(ground.convex, pose_of(plane), ball.convex, pose_of(held({up * (sign * height)})), closest);
      if (height > 0x1p18) {
        EXPECT_EQ(status, Status::out_of_range) << height;
      }
      if (status != Status::ok) continue;
      EXPECT_EQ(closest.overlap, sign < 0) << height;
    }
    if (HasFailure()) return;
  }
}
#endif

#if !defined(DETENT_F64)
DETENT_TEST(distance, is_the_same_to_the_bit_wherever_the_pair_is) {
  Samples samples{6};
  const uint32_t count = rounds(500);
  for (uint32_t i = 0; i < count; ++i) {
    const Pair pair = random_pair(samples, 1, k_known_kinds + k_known_hulls);
    const Closest here = pair.closest();
    Pose pose_a = pose_of(pair.body_a), pose_b = pose_of(pair.body_b);
    const auto moved = [&] {
      const double displacement = uniform(samples, -1, 1) * (k_config == Config::fx32 ? 32e3 : 1e9);
      return static_cast<Coord::Raw>(ldexp(displacement, Coord::k_frac));
    };
    const Position by = {Coord::from_raw(moved()), Coord::from_raw(moved()), Coord::from_raw(moved())};
    for (Pose* pose : {&pose_a, &pose_b}) {
      pose->position = {pose->position.x + by.x, pose->position.y + by.y, pose->position.z + by.z};
    }
    Closest there;
    EXPECT_OK(closest_points(pair.a.convex, pose_a, pair.b.convex, pose_b, there));
    expect_same(here, there);
    if (HasFailure()) return;
  }
}
#endif

/// The shape with every length times `scale`, exactly.
Shape scaled(const Shape& shape, double scale) {
  Shape made = shape;
  made.radius = real(host(shape.radius) * scale);
  made.half_length = real(host(shape.half_length) * scale);
  made.half_extents = reals(host(shape.half_extents) * scale);
  made.rounding = real(host(shape.rounding) * scale);
  return made;
}

DETENT_TEST(distance, scales_to_the_bit_by_a_power_of_two) {
  Samples samples{7};
  const uint32_t count = rounds(300);
  for (uint32_t i = 0; i < count; ++i) {
    const auto size = [&] { return real(static_cast<double>(64 + samples.below(960)) / 1024); };
    const auto shape = [&] {
      switch (samples.below(5)) {
        case 0:
          return sphere(size());
        case 1:
          return capsule(size(), size());
        case 2:
          return rounded(box({size(), size(), size()}), size());
        case 3:
          return cylinder(size(), size());
        default:
          return cone(size(), size());
      }
    };
    const Shape a = shape(), b = shape();
    const auto coordinate = [&] { return static_cast<double>(samples.below(4096)) / 1024 - 2; };
    const BodyAt body_a = held({{{coordinate(), coordinate(), coordinate()}}, random_quaternion(samples)});
    const BodyAt body_b = held({{{coordinate(), coordinate(), coordinate()}}, random_quaternion(samples)});
    const Closest unit = Pair{known(a), known(b), body_a, body_b}.closest();
    for (const int exponent : {-3, 2, 5}) {
      const double scale = ldexp(1, exponent);
      BodyAt far_a = body_a, far_b = body_b;
      far_a.position = far_a.position * scale;
      far_b.position = far_b.position * scale;
      const Closest large = Pair{known(scaled(a, scale)), known(scaled(b, scale)), far_a, far_b}.closest();
      SCOPED_TRACE(testing::Message() << "pair " << i << " times 2^" << exponent);
      EXPECT_EQ(large.overlap, unit.overlap);
      EXPECT_EQ(large.iterations, unit.iterations);
      EXPECT_TRUE(large.normal == unit.normal);
      // The ball's part of a point is rounded to 2^-46 m.
      const double slack = DETENT_FIXED ? 0x1p-46 * (1 + scale) : 0;
      EXPECT_NEAR(host(large.distance), host(unit.distance) * scale, 0);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(host(large.point_a)[k], host(unit.point_a)[k] * scale, slack);
        EXPECT_NEAR(host(large.point_b)[k], host(unit.point_b)[k] * scale, slack);
      }
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
