#include "toi/known_axis.h"

#include <detent/distance.h>

#include "distance/pair.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/closed_form.h"
#include "toi/conservative_advancement.h"

/// Compares pairs that are cleared by a known axis, or by the first directions of GJK, with the full search.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;

/// Two bodies that start a few tolerances apart and pass along each other, or start farther apart with any motion.
struct Passing {
  KnownShape a, b;
  BodyAt body_a, body_b;
  MovingPair pair;
  Vector normal;  ///< from A to B, of the closest points at the start

  Passing(Samples& samples, uint32_t kind_a, uint32_t kind_b)
      : a(random_shape(samples, kind_a, 1)), b(random_shape(samples, kind_b, 1)) {
    body_a.rotation = random_quaternion(samples);
    body_b.rotation = random_quaternion(samples);
    body_b.position = random_direction(samples) * (2.1 * (a.distance_max() + b.distance_max() + a.ball + b.ball));
  }
  Passing(const Passing&) = delete;
  Passing& operator=(const Passing&) = delete;

  Status prepare_pair() { return prepare(a.convex, motion_of(body_a), b.convex, motion_of(body_b), pair); }

  /// Moves B along the normal until the distance is this, m. The normal is that of the new placement.
  void bring_to(double distance) {
    for (int i = 0; i < 2; ++i) {
      Closest closest;
      ASSERT_OK(closest_points(a.convex, pose_of(body_a), b.convex, pose_of(body_b), closest));
      normal = host_units(closest.normal);
      if (i == 0) body_b.position = body_b.position + normal * (distance - host(closest.distance));
    }
  }
};

/// The tolerance of a pair in its current placement, m; 0 if the bodies are too far apart to be placed.
double tolerance_of(const MovingPair& pair) { return ldexp(pair.tolerance, pair.exponent - 30); }

/// Sets a motion in which the distance of the pair changes by about `displacement`, m, and the bodies rotate by at most
/// `rotation_vector`, rad.
void set_motion(Samples& samples, Passing& passing, double displacement, double rotation_vector) {
  const Vector& n = passing.normal;
  const Vector any = random_direction(samples);
  const double along = samples.below(3) == 0 ? 0 : uniform(samples, 0, 1), off = uniform(samples, -0.3, 1);
  passing.body_a.displacement = random_direction(samples) * uniform(samples, 0, 1);
  passing.body_b.displacement =
      passing.body_a.displacement + (any - n * dot(any, n)) * along + n * (off * displacement);
  for (BodyAt* body : {&passing.body_a, &passing.body_b}) {
    const Vector axis = random_direction(samples);
    const double angle = samples.below(2) == 0 ? 0 : rotation_vector * uniform(samples, 0, 1);
    body->rotation_vector = axis * angle;
  }
}

struct Counts {
  uint32_t cleared = 0, glanced = 0, undecided = 0, hits = 0;
};

/// Expects the same answer for a prepared pair as from the search.
void expect_as_searched(Samples& samples, const MovingPair& pair, const Vector& normal, Counts& counts) {
  TimeOfImpact full, quick;
  conservative_advancement(pair, k_toi_method, full);
  conservative_advancement(pair, k_toi_method, quick, enough_apart(pair));
  ASSERT_EQ(quick.outcome, full.outcome);
  ASSERT_EQ(quick.time, full.time);
  if (full.outcome != ToiOutcome::clear) {
    ASSERT_TRUE(quick.normal == full.normal && quick.point == full.point);
  }
  counts.glanced += pair.from <= pair.to && quick.gjk_calls == 0 ? 1u : 0u;
  counts.undecided += full.outcome == ToiOutcome::undecided ? 1u : 0u;
  counts.hits += full.outcome == ToiOutcome::hit ? 1u : 0u;
  const Vector found = host_units(full.normal);
  const double tilt = pow(10, uniform(samples, -9, 0));
  const Vector tilted = normal + random_direction(samples) * tilt;
  for (const Vector& axis : {normal, found, tilted}) {
    if (!(length(axis) > 0.5)) continue;
    const Vector unit = axis * (1 / length(axis));
    Vec3<Unit> direction;
    ASSERT_OK(unit_from_host(unit[0], direction.x));
    ASSERT_OK(unit_from_host(unit[1], direction.y));
    ASSERT_OK(unit_from_host(unit[2], direction.z));
    Vec32 raw;
    ASSERT_TRUE(raw_from_direction(direction, raw));
    if (!stays_clear(pair, raw)) continue;
    ++counts.cleared;
    ASSERT_EQ(full.outcome, ToiOutcome::clear);
  }
}

DETENT_TEST(known_axis, clears_nothing_that_the_search_does_not) {
  Samples samples{71};
  Counts counts;
  const uint32_t count = rounds(20000);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t kind_a = samples.below(10), kind_b = samples.below(10);
    Passing passing(samples, kind_a, kind_b);
    const bool close = i % 4 != 0;
    passing.bring_to(close ? 1e-3 : uniform(samples, 0.001, 0.5));
    ASSERT_OK(passing.prepare_pair());
    const double tolerance = tolerance_of(passing.pair);
    if (close) passing.bring_to(tolerance * uniform(samples, 0.3, 4));
    const double displacement = close ? tolerance * pow(10, uniform(samples, -1, 4)) : 0.5;
    const double rotation_vector = close ? pow(10, uniform(samples, -7, 0)) : 2;
    set_motion(samples, passing, displacement, rotation_vector);
    ASSERT_OK(passing.prepare_pair());
    SCOPED_TRACE(testing::Message() << "pair " << i << " of kinds " << kind_a << " and " << kind_b);
    expect_as_searched(samples, passing.pair, passing.normal, counts);
    if (HasFatalFailure()) return;
  }
  printf("%u pairs: %u cleared by an axis, %u at a glance, %u hits, %u undecided\n", count, counts.cleared,
         counts.glanced, counts.hits, counts.undecided);
  EXPECT_GT(counts.cleared, count / 8);
  EXPECT_GT(counts.glanced, count / 100);
  EXPECT_GT(counts.hits, count / 8);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
