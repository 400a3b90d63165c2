#include "distance/gjk.h"

#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/placed_pairs.h"

#if defined(__SIZEOF_INT128__)
// Axis-parallel polytopes with integer coordinates, which a block represents exactly: the results of gjk() are proved
// from all vertices.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

__extension__ typedef __int128 Exact;

struct Point {
  Exact x, y, z;
};
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Exact dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Point exact(const Vec32& v) { return {v.x, v.y, v.z}; }
int sign(Exact value) { return value < 0 ? -1 : value > 0 ? 1 : 0; }

/// Whether the hull of up to four points contains the origin.
bool holds_origin(const Point* p, int count) {
  if (count == 1) return p[0].x == 0 && p[0].y == 0 && p[0].z == 0;
  if (count == 2) {
    const Point c = cross(p[0], p[1]);
    return c.x == 0 && c.y == 0 && c.z == 0 && dot(p[0], p[1]) <= 0;
  }
  if (count == 3) {
    for (int i = 0; i < 3; ++i) {
      const Point edge[2] = {p[i], p[(i + 1) % 3]};
      if (holds_origin(edge, 2)) return true;
    }
    const Point n = cross(p[1] - p[0], p[2] - p[0]);
    if (dot(n, p[0]) != 0) return false;
    return dot(cross(p[0], p[1]), n) > 0 && dot(cross(p[1], p[2]), n) > 0 && dot(cross(p[2], p[0]), n) > 0;
  }
  for (int i = 0; i < 4; ++i) {
    const Point face[3] = {p[(i + 1) % 4], p[(i + 2) % 4], p[(i + 3) % 4]};
    if (holds_origin(face, 3)) return true;
  }
  const auto volume = [](const Point& a, const Point& b, const Point& c) { return sign(dot(a, cross(b, c))); };
  const int whole = sign(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0])));
  return whole != 0 && volume(p[1], p[2], p[3]) == whole && volume(p[0], p[3], p[2]) == whole &&
         volume(p[0], p[1], p[3]) == whole && volume(p[0], p[2], p[1]) == whole;
}

constexpr ShapeType k_types[] = {ShapeType::sphere, ShapeType::capsule, ShapeType::box, ShapeType::triangle,
                                 ShapeType::hull};
constexpr int k_type_count = 5;

struct Outcome {
  int iterations = 0;
  bool overlap = false;
};

/// A vector along the point of the simplex that is nearest to the origin. The simplex has at most three vertices, and
/// all of them contribute to this point.
Point nearest_point(const Simplex& simplex) {
  const Point a = exact(simplex.vertex(0).difference);
  if (simplex.count() == 1) return a;
  const Point ab = exact(simplex.vertex(1).difference) - a;
  if (simplex.count() == 2) {
    const Exact square = dot(ab, ab), along = -dot(a, ab);
    return {a.x * square + ab.x * along, a.y * square + ab.y * along, a.z * square + ab.z * along};
  }
  const Point n = cross(ab, exact(simplex.vertex(2).difference) - a);
  return dot(n, a) < 0 ? Point{-n.x, -n.y, -n.z} : n;
}

/// Checks the result of gjk() for the pair against all its vertices.
void check(const Placed& a, const Placed& b, const Vec32& offset, Outcome& outcome) {
  Simplex simplex;
  const GjkResult result = gjk(a, b, offset, simplex, {});
  outcome.iterations = result.iterations;
  outcome.overlap = result.outcome == GjkOutcome::overlap;
  ASSERT_NE(result.outcome, GjkOutcome::capped);
  if (outcome.overlap) {
    Point points[4];
    for (int i = 0; i < simplex.count(); ++i) points[i] = exact(simplex.vertex(i).difference);
    ASSERT_TRUE(holds_origin(points, simplex.count()));
    return;
  }
  // All vertices of the difference lie on the far side of a plane, and none is nearer to the origin than `lower`.
  const Point v = nearest_point(simplex), normal = exact(result.normal);
  CorePoint on_a, on_b;
  Exact least = Exact{1} << 100;
  for (int i = 0; i < 255 && core_vertex(*a.convex, static_cast<uint8_t>(i), on_a); ++i) {
    for (int j = 0; j < 255 && core_vertex(*b.convex, static_cast<uint8_t>(j), on_b); ++j) {
      const Point w = exact(add(offset, subtract(b.point(on_b.local), a.point(on_a.local))));
      ASSERT_GT(dot(v, w), 0);
      const Exact distance_max = dot(normal, w);
      least = distance_max < least ? distance_max : least;
    }
  }
  ASSERT_GE(least, (Exact{result.lower} - 2) << 30);
  ASSERT_GE(result.upper, result.lower);
  ASSERT_LE(result.upper - result.lower, 4);
}

DETENT_TEST(gjk, never_mistakes_touching_integer_polytopes_and_needs_13_supports_at_most) {
  Samples samples{20};
  int iterations_max = 0;
  uint32_t overlaps = 0;
  const uint32_t count = detent_oracle::rounds(500000);
  for (uint32_t i = 0; i < count; ++i) {
    const int kind = static_cast<int>(samples.below(3));
    const Convex a = random_convex(samples, k_types[samples.below(k_type_count)], kind);
    const Convex b = random_convex(samples, k_types[samples.below(k_type_count)], kind);
    const Placed placed_a = place(a, random_quarter_turns(samples), k_exponent);
    const Placed placed_b = place(b, random_quarter_turns(samples), k_exponent);
    Vec32 offset = {coordinate(samples, kind, 28), coordinate(samples, kind, 28), coordinate(samples, kind, 28)};
    if (samples.below(2) == 0) {  // a vertex of each at the same place
      CorePoint on_a, on_b;
      if (core_vertex(a, static_cast<uint8_t>(samples.below(2)), on_a) &&
          core_vertex(b, static_cast<uint8_t>(samples.below(2)), on_b)) {
        offset = subtract(placed_a.point(on_a.local), placed_b.point(on_b.local));
      }
    }
    Outcome outcome;
    check(placed_a, placed_b, offset, outcome);
    if (HasFatalFailure()) FAIL() << "pair " << i << " of kind " << kind;
    iterations_max = outcome.iterations > iterations_max ? outcome.iterations : iterations_max;
    overlaps += outcome.overlap ? 1 : 0;
  }
  RecordProperty("iterations_max", iterations_max);
  printf("%u pairs, %u meet, at most %d supports\n", count, overlaps, iterations_max);
  EXPECT_LE(iterations_max, 13);
  EXPECT_GT(overlaps, count / 5);
  EXPECT_LT(overlaps, count * 4 / 5);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
