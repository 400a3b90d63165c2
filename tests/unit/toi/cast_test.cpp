#include <detent/distance.h>

#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/closed_form.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;

/// A ray against a shape at rest. Origin and displacement are in world axes, from the shape's position.
struct Ray {
  KnownShape shape;
  BodyAt body;
  Vector origin, displacement;

  Ray(const KnownShape& target, const BodyAt& at, const Vector& from, const Vector& along)
      : shape(target), body(held(at)), origin(host(reals(from))), displacement(host(reals(along))) {}

  CastHit cast() const {
    CastHit hit;
    EXPECT_OK(cast_ray(shape.convex, pose_of(body), reals(origin), reals(displacement), hit));
    return hit;
  }
  /// Distance of the ray's point at `time` from the surface, m; less than 0 in the ball around the core.
  double gap(double time) const {
    return core_distance(shape, body.to_local(body.position + origin + displacement * time)) - shape.ball;
  }
  double distance_max() const {
    const double far = shape.type() == ShapeType::half_space ? length(origin) + length(displacement) : 0;
    return shape.distance_max() + shape.ball + far;
  }
  double tolerance() const {
    return std::max(k_toi_tolerance * 2 * shape.distance_max(), 100 * 0x1p-29 * 1.02 * distance_max());
  }
  /// The error, m, from rounding the rotation, the displacement and the block.
  double slack() const { return 4 * k_number_error * (distance_max() + length(origin)); }
};

/// The first time at which the line meets a triangle of the points; 1 if it does not.
double first_crossing(const std::vector<Vector>& points, const Vector& origin, const Vector& displacement) {
  double first = 1;
  const size_t count = points.size();
  for (size_t i = 0; i < count; ++i) {
    for (size_t j = i + 1; j < count; ++j) {
      for (size_t k = j + 1; k < count; ++k) {
        const Vector u = points[j] - points[i], v = points[k] - points[i], n = cross(u, v);
        const double speed = dot(n, displacement);
        if (speed == 0) continue;
        const double time = dot(n, points[i] - origin) / speed;
        if (time < 0 || time >= first) continue;
        const Vector p = origin + displacement * time - points[i];
        const double square = dot(n, n), s = dot(cross(p, v), n) / square, t = dot(cross(u, p), n) / square;
        if (s >= 0 && t >= 0 && s + t <= 1) first = time;
      }
    }
  }
  return first;
}

struct Truth {
  bool hit;
  double time, least;  ///< `least`: the least gap before the core, m
};
/// Outside a core the distance is convex along a line. Its minimum is found by ternary search, and its first zero by
/// bisection.
Truth truth_of(const Ray& ray) {
  double end = 1;
  if (!ray.shape.points.empty() && ray.shape.type() != ShapeType::box) {
    const Vector from = ray.body.to_local(ray.body.position + ray.origin);
    const Vector to = ray.body.to_local(ray.body.position + ray.origin + ray.displacement);
    end = first_crossing(ray.shape.points, from, to - from);
  }
  double low = 0, high = end;
  for (int i = 0; i < 70; ++i) {
    const double third = (high - low) / 3;
    if (ray.gap(low + third) <= ray.gap(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  const double nearest = end < 1 ? end : low, least = end < 1 ? -ray.shape.ball : ray.gap(low);
  if (least > 0) return {false, 1, least};
  low = 0;
  high = nearest;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (ray.gap(middle) > 0 ? low : high) = middle;
  }
  return {true, high, least};
}

/// rad; the largest error found is 0.062: a hit is known before its nearest points are final.
constexpr double k_normal_error = 0.1;

/// Checks that hold for every hit of a ray that starts outside.
void expect_hit(const Ray& ray, const CastHit& hit, double time) {
  const double found = fraction_to_host(hit.time), slack = ray.slack();
  ASSERT_TRUE(hit.hit);
  EXPECT_FALSE(hit.undecided);
  EXPECT_LE(found, time + slack / length(ray.displacement) + 1e-12) << "late";
  EXPECT_LE(ray.gap(found), ray.tolerance() + slack);
  const Vector normal = host_units(hit.normal), point = host(hit.point), at = ray.origin + ray.displacement * found;
  EXPECT_NEAR(length(normal), 1, 4 * k_number_error);
  EXPECT_LE(length(at - point), ray.tolerance() + 2 * slack);
  EXPECT_LE(fabs(core_distance(ray.shape, ray.body.to_local(ray.body.position + point)) - ray.shape.ball),
            ray.tolerance() + 2 * slack);
  // The normal belongs to the surface at the point: no point of the shape lies farther along it.
  if (ray.shape.type() == ShapeType::half_space) {
    EXPECT_LE(length(normal - axis_of(ray.body.rotation, 1)), 4 * k_number_error);
  } else {
    const double farthest = -lowest(ray.shape, ray.body, normal * -1) + ray.shape.ball - dot(normal, ray.body.position);
    EXPECT_LE(farthest - dot(normal, point), 2 * slack + k_normal_error * ray.distance_max());
  }
  // The normal points against the displacement, except for rays that pass within the tolerance.
  EXPECT_LE(dot(normal, ray.displacement) / length(ray.displacement), k_normal_error);
}

DETENT_TEST(cast, of_a_ray_at_every_shape_hits_where_the_closed_form_does) {
  Samples samples{1};
  uint32_t hits = 0, misses = 0;
  const uint32_t count = rounds(600);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t kind = i % (k_known_kinds + k_known_hulls);
    const double scale = kind < k_known_kinds ? ldexp(1, static_cast<int>(samples.below(15)) - 8) : 1;
    const KnownShape shape = random_shape(samples, kind, scale);
    const double near = shape.type() == ShapeType::half_space ? scale : shape.distance_max() + shape.ball;
    const Vector origin = random_direction(samples) * (near * uniform(samples, 1.01, 4));
    const Vector aim = random_direction(samples) * (near * uniform(samples, 0, 1.1));
    const Ray ray(shape, {random_direction(samples) * scale, random_quaternion(samples)}, origin,
                  (aim - origin) * uniform(samples, 0.3, 3));
    if (ray.gap(0) <= ray.tolerance() + ray.slack()) continue;
    const Truth truth = truth_of(ray);
    const CastHit hit = ray.cast();
    SCOPED_TRACE(testing::Message() << "ray " << i << ", kind " << kind << ", scale " << scale << ", ball "
                                    << shape.ball);
    if (truth.hit) {
      ++hits;
      expect_hit(ray, hit, truth.time);
    } else if (truth.least > ray.tolerance() + ray.slack()) {
      ++misses;
      EXPECT_FALSE(hit.hit);
      EXPECT_FALSE(hit.undecided);
      EXPECT_TRUE(hit.time == Fraction(1.0));
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(hits, count / 4);
  EXPECT_GT(misses, count / 6);
}

struct RayByHand {
  const char* text;
  KnownShape shape;
  Vector origin, displacement;
  double time;  ///< above 1: none
  Vector normal;
};

DETENT_TEST(cast, of_rays_placed_by_hand) {
  const KnownShape ball = known(sphere(0.5)), cube = known(box({0.5, 1.0, 2.0})), rod = known(capsule(0.5, 1.0));
  const KnownShape drum = known(cylinder(1.0, 0.5)), hat = known(cone(1.0, 1.0)), ground = known(half_space());
  const Vector corners[3] = {{{-1, 0, -1}}, {{1, 0, -1}}, {{0, 0, 2}}};
  const KnownShape flat = known_triangle(corners, 0);
  const RayByHand rays[] = {
      {"sphere", ball, {{-2.5, 0, 0}}, {{4, 0, 0}}, 0.5, {{-1, 0, 0}}},
      {"sphere, too short", ball, {{-2.5, 0, 0}}, {{1.9375, 0, 0}}, 2, {}},
      {"sphere, away", ball, {{-2.5, 0, 0}}, {{-4, 0, 0}}, 2, {}},
      {"sphere, beside", ball, {{-2.5, 0.5625, 0}}, {{5, 0, 0}}, 2, {}},
      {"box's x slab", cube, {{-2.5, 0.5, 1}}, {{4, 0, 0}}, 0.5, {{-1, 0, 0}}},
      {"box's y slab, aslant", cube, {{0.25, 3, 0.5}}, {{0.25, -4, -1}}, 0.5, {{0, 1, 0}}},
      {"box's z slab", cube, {{0, 0, 4}}, {{0, 0, -4}}, 0.5, {{0, 0, 1}}},
      {"box, past its edge", cube, {{-2.5, 1.0625, 0}}, {{5, 0, 0}}, 2, {}},
      {"half-space", ground, {{7, 2, 9}}, {{100, -4, 30}}, 0.5, {{0, 1, 0}}},
      {"half-space, parallel", ground, {{7, 0.0625, 9}}, {{100, 0, 30}}, 2, {}},
      {"half-space, away", ground, {{7, 0.0625, 9}}, {{0, 5, 0}}, 2, {}},
      {"capsule's side", rod, {{-2.5, 0.5, 0}}, {{4, 0, 0}}, 0.5, {{-1, 0, 0}}},
      {"capsule's cap", rod, {{0, 3.5, 0}}, {{0, -4, 0}}, 0.5, {{0, 1, 0}}},
      {"cylinder's side", drum, {{0, 0.25, 3}}, {{0, 0, -4}}, 0.5, {{0, 0, 1}}},
      {"cylinder's cap", drum, {{0.5, 2.5, 0.25}}, {{0, -4, 0}}, 0.5, {{0, 1, 0}}},
      {"cylinder's cap, from below", drum, {{0.5, -2.5, 0.25}}, {{0, 4, 0}}, 0.5, {{0, -1, 0}}},
      {"cylinder, past its rim", drum, {{0.75, 2.5, 0.75}}, {{0, -4, 0}}, 2, {}},
      {"cone's base", hat, {{0.25, -2.5, 0.25}}, {{0, 4, 0}}, 0.5, {{0, -1, 0}}},
      {"cone's side", hat, {{2.5, 0.5, 0}}, {{-4, 0, 0}}, 0.5, {{2 / sqrt(5.0), 1 / sqrt(5.0), 0}}},
      {"cone, past its tip", hat, {{-2, 1.5625, 0}}, {{4, 0, 0}}, 2, {}},
      {"triangle from above", flat, {{0.125, 2, 0.25}}, {{0, -4, 0}}, 0.5, {{0, 1, 0}}},
      {"triangle from below", flat, {{0.125, -2, 0.25}}, {{0, 4, 0}}, 0.5, {{0, -1, 0}}},
      {"triangle, past it", flat, {{1, 2, 1}}, {{0, -4, 0}}, 2, {}},
      {"triangle, over it", flat, {{-3, 0.0625, 0}}, {{6, 0, 0}}, 2, {}},
  };
  Samples samples{2};
  for (const RayByHand& placed : rays) {
    for (int rotation_vector = 0; rotation_vector < 4; ++rotation_vector) {
      SCOPED_TRACE(placed.text);
      BodyAt body;
      if (rotation_vector != 0) body = held({random_direction(samples) * 10, random_quaternion(samples)});
      const Vector origin = body.to_world(placed.origin) - body.position,
                   displacement = body.to_world(placed.displacement) - body.position;
      const Ray ray(placed.shape, body, origin, displacement);
      const CastHit hit = ray.cast();
      if (placed.time > 1) {
        EXPECT_FALSE(hit.hit || hit.undecided);
        EXPECT_TRUE(hit.time == Fraction(1.0));
      } else {
        expect_hit(ray, hit, placed.time);
        EXPECT_LE(length(host_units(hit.normal) - (body.to_world(placed.normal) - body.position)), k_normal_error);
      }
    }
  }
}

DETENT_TEST(cast, of_a_ray_that_grazes_a_sphere_tells_a_hundred_thousandth) {
  const KnownShape ball = known(sphere(0.5));
  for (const double off : {0x1p-16, 0x1p-12, 0x1p-8}) {
    const Ray above(ball, {}, {{-2, 0.5 + off, 0}}, {{4, 0, 0}}), below(ball, {}, {{-2, 0.5 - off, 0}}, {{4, 0, 0}});
    EXPECT_FALSE(above.cast().hit || above.cast().undecided) << off;
    const double half = sqrt(0.25 - (0.5 - off) * (0.5 - off));
    expect_hit(below, below.cast(), (2 - half) / 4);
  }
}

/// A shape of each kind, whose core contains (0.01, 0.01, 0.01).
std::vector<KnownShape> solids() {
  return {known(box({0.5, 1.0, 2.0})),  known(cylinder(1.0, 0.5)),          known(cone(1.0, 1.0)),
          known_hull(prism_bytes(), 0), known_hull(tetrahedron_bytes(), 0), known(half_space())};
}

DETENT_TEST(cast, of_a_ray_that_starts_inside_hits_at_once) {
  const Vector ways[] = {{{5, 0, 0}}, {{0, -5, 0}}, {{0, 0, 0}}};
  for (const KnownShape& shape : solids()) {
    for (const Vector& displacement : ways) {
      const Vector inside = shape.type() == ShapeType::half_space ? Vector{{5, -0.25, 3}} : Vector{{0.01, 0.01, 0.01}};
      const CastHit hit = Ray(shape, {}, inside, displacement).cast();
      EXPECT_TRUE(hit.hit);
      EXPECT_TRUE(hit.time == Fraction(0.0));
    }
  }
  for (const KnownShape& round :
       {known(sphere(0.5)), known(capsule(0.5, 0.5)), known(rounded(box({0.25, 0.25, 0.25}), 0.5))}) {
    for (const Vector& displacement : ways) {
      for (const Vector& inside : {Vector{{0, 0, 0}}, Vector{{0.375, 0.125, 0.0625}}, Vector{{-0.25, 0, 0.25}}}) {
        const CastHit hit = Ray(round, {}, inside, displacement).cast();
        EXPECT_TRUE(hit.hit);
        EXPECT_TRUE(hit.time == Fraction(0.0));
      }
    }
  }
}

const Vec3<Unit> k_none = {Unit(0.0), Unit(0.0), Unit(0.0)};

DETENT_TEST(cast, of_a_ray_that_starts_in_a_core_has_no_normal) {
  for (const KnownShape& shape : solids()) {
    const Vector inside = shape.type() == ShapeType::half_space ? Vector{{5, -0.25, 3}} : Vector{{0.01, 0.01, 0.01}};
    EXPECT_TRUE(Ray(shape, {}, inside, {{5, 0, 0}}).cast().normal == k_none) << static_cast<uint32_t>(shape.type());
  }
}

DETENT_TEST(cast, of_a_ray_that_starts_in_the_ball_around_a_core_has_the_normal_away_from_the_core) {
  for (const KnownShape& round :
       {known(sphere(0.5)), known(capsule(0.5, 0.5)), known(rounded(box({0.25, 0.25, 0.25}), 0.5))}) {
    const CastHit hit = Ray(round, {}, {{0.375, 0.125, 0.0625}}, {{5, 0, 0}}).cast();
    EXPECT_TRUE(hit.hit && hit.time == Fraction(0.0));
    EXPECT_GT(host_units(hit.normal)[0], 0.5);
  }
}

DETENT_TEST(cast, of_a_way_of_length_0_hits_what_holds_its_origin) {
  for (const KnownShape& shape : solids()) {
    const Ray outside(shape, {}, {{0, 9, 0}}, {{0, 0, 0}});
    EXPECT_FALSE(outside.cast().hit || outside.cast().undecided);
    EXPECT_TRUE(outside.cast().time == Fraction(1.0));
  }
  EXPECT_TRUE(Ray(known(sphere(0.5)), {}, {{0, 0.5, 0}}, {{0, 0, 0}}).cast().hit);
  EXPECT_TRUE(Ray(known(box({0.5, 0.5, 0.5})), {}, {{0, 0.5, 0}}, {{0, 0, 0}}).cast().hit);
  EXPECT_TRUE(Ray(known(half_space()), {}, {{9, 0, 9}}, {{0, 0, 0}}).cast().hit);
}

DETENT_TEST(cast, of_a_shape_is_the_time_of_impact_without_turn) {
  Samples samples{3};
  uint32_t hits = 0;
  const uint32_t count = rounds(500);
  for (uint32_t i = 0; i < count; ++i) {
    const KnownShape moving = random_shape(samples, samples.below(10), 1),
                     target = random_shape(samples, samples.below(11), 1);
    const BodyAt body = {random_direction(samples), random_quaternion(samples)};
    const BodyAt start = {random_direction(samples) * uniform(samples, 1, 5), random_quaternion(samples),
                          random_direction(samples) * uniform(samples, 0, 6)};
    const Motion motion = motion_of(start);
    CastHit hit;
    TimeOfImpact impact;
    EXPECT_OK(cast_shape(moving.convex, motion.start, motion.displacement, target.convex, pose_of(body), hit));
    EXPECT_OK(time_of_impact(target.convex, motion_of(body), moving.convex, motion, impact));
    EXPECT_EQ(hit.hit, impact.outcome == ToiOutcome::hit);
    EXPECT_EQ(hit.undecided, impact.outcome == ToiOutcome::undecided);
    EXPECT_TRUE(hit.time == impact.time);
    if (hit.hit) {
      ++hits;
      EXPECT_TRUE(hit.normal == impact.normal);
      EXPECT_TRUE(hit.point == impact.point);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(hits, count / 8);
}

DETENT_TEST(cast, of_a_sphere_is_a_ray_at_the_shape_grown_by_it) {
  Samples samples{4};
  for (uint32_t i = 0; i < rounds(300); ++i) {
    const double half[3] = {uniform(samples, 0.1, 1), uniform(samples, 0.1, 1), uniform(samples, 0.1, 1)};
    const Real radius = real(uniform(samples, 0.1, 0.5));
    const Shape bare = box({real(half[0]), real(half[1]), real(half[2])});
    const BodyAt body = held({{{0, 0, 0}}, random_quaternion(samples)});
    // The start is rounded to the grid of coordinates.
    const BodyAt start = held({random_direction(samples) * 4, {0, 0, 0, 1}});
    const Vector aim = random_direction(samples) * 0.5;
    const Vec3<Real> displacement = reals((aim - start.position) * 2);
    const Ray ray(known(rounded(bare, radius)), body, start.position, host(displacement));
    CastHit swept;
    const CastHit hit = ray.cast();
    EXPECT_OK(cast_shape(known(sphere(radius)).convex, pose_of(start), displacement, known(bare).convex, pose_of(body),
                         swept));
    EXPECT_EQ(swept.hit, hit.hit);
    EXPECT_LE(fabs(fraction_to_host(swept.time) - fraction_to_host(hit.time)) * length(host(displacement)), 1e-2);
    if (swept.hit) {
      EXPECT_LE(fabs(ray.gap(fraction_to_host(swept.time))), ray.tolerance() + ray.slack());
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
