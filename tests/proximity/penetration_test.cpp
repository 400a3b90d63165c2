#include "proximity/penetration.h"

#include "tests/oracle/effort.h"
#include "tests/proximity/placed_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_exponent = 2;  ///< of the block

/// A coordinate from a small grid, where points coincide and planes are shared, next to one, or of any size.
int32_t coordinate(Samples& samples, int kind, int bits) {
  const int32_t grid = static_cast<int32_t>(samples.below(5)) - 2;
  if (kind == 0) return grid;
  if (kind == 1) return grid * (1 << (bits - 3)) + static_cast<int32_t>(samples.below(3)) - 1;
  return static_cast<int32_t>(samples.integer(bits - 1));
}

Convex random_convex(Samples& samples, ShapeType type, int kind) {
  Convex convex;
  if (type == ShapeType::hull) {
    const bool small = samples.below(2) == 0;
    const Asset asset = small ? Asset{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron}
                              : Asset{detent_hulls::k_prism, sizeof detent_hulls::k_prism};
    EXPECT_OK(make_hull(asset, Real(0.0), convex));
    return convex;
  }
  convex.type = type;
  convex.exponent = k_exponent;
  convex.core_radius = 1;
  for (int32_t& s : convex.size) {
    s = coordinate(samples, kind, 27);
    s = s < 0 ? -s : s == 0 ? 1 : s;
  }
  for (auto& corner : convex.corner) {
    for (int32_t& c : corner) c = coordinate(samples, kind, 27);
  }
  if (type == ShapeType::triangle && samples.below(8) == 0) {  // a segment
    for (int i = 0; i < 3; ++i) convex.corner[2][i] = convex.corner[1][i];
  }
  return convex;
}

struct Tally {
  uint32_t overlaps = 0, capped = 0;
  int supports_max = 0;
  long double error_max = 0;  ///< ulps
};

long double along(const Vec32& normal, const Vec32& v) { return dot(arrow(normal), arrow(v)) / 0x1p30L; }

/// What holds for every pair of cores: moved by the depth they part, and touch.
void check_parted(const Placed& a, const Placed& b, const Vec32& offset, const Penetration& found) {
  const auto moved = [&](int32_t by) {
    return add(offset, round_shift(Vec64{int64_t{found.normal.x} * by, int64_t{found.normal.y} * by,
                                         int64_t{found.normal.z} * by}, 30));
  };
  Simplex simplex;
  const GjkResult out = gjk(a, b, moved(found.depth + 2 * k_penetration_slack), simplex, {});
  ASSERT_EQ(out.outcome, GjkOutcome::apart);
  ASSERT_LE(out.upper, 4 * k_penetration_slack);
  // The deepest points are one straight above the other.
  const Vec32 way = subtract(add(offset, found.point_b), found.point_a);
  ASSERT_NEAR(static_cast<double>(along(found.normal, way)), -found.depth, 2 * k_penetration_slack);
}

void check_polytopes(const Placed& a, const Placed& b, const Vec32& offset, Tally& tally) {
  Simplex simplex;
  if (gjk(a, b, offset, simplex, {}).outcome != GjkOutcome::overlap) return;
  ++tally.overlaps;
  const Penetration found = penetration(a, b, offset, simplex);
  tally.supports_max = std::max(tally.supports_max, found.supports);
  if (found.capped) {
    ++tally.capped;
    return;
  }
  const Solid solid_a = solid_of(a), solid_b = solid_of(b);
  long double least = least_depth(solid_a, solid_b, offset);
  if (least == HUGE_VALL) least = 0;  // two points, a point and a segment, or two parallel segments
  const long double error = fabsl(static_cast<long double>(found.depth) - least);
  tally.error_max = std::max(tally.error_max, error);
  ASSERT_LE(error, k_penetration_slack) << found.depth << " for " << static_cast<double>(least);
  ASSERT_LE(found.lower, found.depth);
  // It does part them: the vertices say so.
  const Arrow back = {-arrow(found.normal).x, -arrow(found.normal).y, -arrow(found.normal).z};
  ASSERT_LE(reach_along(solid_a, solid_b, offset, back), found.depth + k_penetration_slack);
  check_parted(a, b, offset, found);
  // The deepest points lie one straight above the other.
  const Vec32 way = subtract(add(offset, found.point_b), found.point_a);
  ASSERT_LE(length(arrow(way)), found.depth + 4 * k_penetration_slack);
}

DETENT_TEST(penetration, finds_the_least_way_out_of_integer_and_posed_polytopes) {
  constexpr ShapeType k_types[] = {ShapeType::box, ShapeType::triangle, ShapeType::hull, ShapeType::capsule,
                                   ShapeType::sphere};
  Samples samples{31};
  Tally tally;
  const uint32_t count = detent_oracle::rounds(100000);
  for (uint32_t i = 0; i < count; ++i) {
    const int kind = static_cast<int>(samples.below(3));
    const bool posed = samples.below(2) == 0;
    const Convex a = random_convex(samples, k_types[samples.below(5)], kind);
    const Convex b = random_convex(samples, k_types[samples.below(5)], kind);
    const Placed placed_a = place(a, posed ? random_rotation(samples) : random_quarter_turns(samples), k_exponent);
    const Placed placed_b = place(b, posed ? random_rotation(samples) : random_quarter_turns(samples), k_exponent);
    Vec32 offset = {coordinate(samples, kind, 28), coordinate(samples, kind, 28), coordinate(samples, kind, 28)};
    const uint32_t where = samples.below(4);
    if (where == 0) offset = {0, 0, 0};
    if (where == 1) {  // a vertex of each at the same place, or nearly so
      CorePoint on_a, on_b;
      if (core_vertex(a, static_cast<uint8_t>(samples.below(2)), on_a) &&
          core_vertex(b, static_cast<uint8_t>(samples.below(2)), on_b)) {
        offset = subtract(placed_a.point(on_a.local), placed_b.point(on_b.local));
        if (samples.below(2) == 0) offset.y += static_cast<int32_t>(samples.below(9)) - 4;
      }
    }
    check_polytopes(placed_a, placed_b, offset, tally);
    if (HasFatalFailure()) FAIL() << "pair " << i << " of kind " << kind << (posed ? ", posed" : "");
  }
  printf("%u pairs, %u overlap, at most %d supports, %u capped, error at most %.2f ulps\n", count, tally.overlaps,
         tally.supports_max, tally.capped, static_cast<double>(tally.error_max));
  EXPECT_GT(tally.overlaps, count / 5);
  EXPECT_EQ(tally.capped, 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
