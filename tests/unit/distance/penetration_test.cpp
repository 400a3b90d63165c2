#include "distance/penetration.h"

#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/placed_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Tally {
  uint32_t overlaps = 0, capped = 0;
  int supports_max = 0;
  double error_max = 0;  ///< ulps
};

double along(const Vec32& normal, const Vec32& v) { return dot(arrow(normal), arrow(v)) / 0x1p30; }

/// Checks that hold for every pair of cores: moved apart by the depth, the cores touch.
void check_parted(const Placed& a, const Placed& b, const Vec32& offset, const Penetration& found) {
  const auto moved = [&](int32_t by) {
    return add(offset, round_shift(Vec64{int64_t{found.normal.x} * by, int64_t{found.normal.y} * by,
                                         int64_t{found.normal.z} * by},
                                   30));
  };
  Simplex simplex;
  const GjkResult out = gjk(a, b, moved(found.depth + 2 * k_penetration_slack), simplex, {});
  ASSERT_EQ(out.outcome, GjkOutcome::apart);
  ASSERT_LE(out.upper, 4 * k_penetration_slack);
  // The deepest points lie on one line along the normal.
  const Vec32 displacement = subtract(add(offset, found.point_b), found.point_a);
  ASSERT_NEAR(along(found.normal, displacement), -found.depth, 2 * k_penetration_slack);
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
  double least = least_depth(solid_a, solid_b, offset);
  if (least == HUGE_VAL) least = 0;  // two points, a point and a segment, or two parallel segments
  const double error = fabs(found.depth - least);
  tally.error_max = std::max(tally.error_max, error);
  ASSERT_LE(error, 1.001) << found.depth << " for " << least;
  // Except for hulls: if faces are nearly flat, the hull of the placed vertices may have other edges than the cooked
  // hull.
  const bool exact = a.convex->type != ShapeType::hull && b.convex->type != ShapeType::hull;
  ASSERT_TRUE(!exact || found.depth >= least - 0.001);
  ASSERT_LE(found.lower, least + 0.001);
  // The translation does separate them: checked with the vertices.
  const Arrow back = {-arrow(found.normal).x, -arrow(found.normal).y, -arrow(found.normal).z};
  ASSERT_LE(reach_along(solid_a, solid_b, offset, back), found.depth + k_penetration_slack);
  check_parted(a, b, offset, found);
  // The deepest points lie on one line along the normal.
  const Vec32 displacement = subtract(add(offset, found.point_b), found.point_a);
  ASSERT_LE(length(arrow(displacement)), found.depth + 4 * k_penetration_slack);
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
         tally.supports_max, tally.capped, tally.error_max);
  EXPECT_GT(tally.overlaps, count / 5);
  EXPECT_EQ(tally.capped, 0u);
}

constexpr int32_t k_one = 1 << 30;
constexpr Matrix32 k_upright = {{{k_one, 0, 0}, {0, k_one, 0}, {0, 0, k_one}}};

Convex core(ShapeType type, int32_t x, int32_t y, int32_t z) {
  Convex convex;
  convex.type = type;
  convex.exponent = k_exponent;
  convex.core_radius = 1;
  convex.size[0] = x;
  convex.size[1] = y;
  convex.size[2] = z;
  return convex;
}

Penetration find(const Placed& a, const Placed& b, const Vec32& offset) {
  Simplex simplex;
  EXPECT_EQ(gjk(a, b, offset, simplex, {}).outcome, GjkOutcome::overlap);
  return penetration(a, b, offset, simplex);
}

/// The greatest direction.p over a core, unit direction, ulps of the block, in double. Range: no hull, no triangle.
double exact_support(const Placed& placed, const Arrow& direction) {
  const auto& c = placed.rotation.column;
  const Arrow d = {dot(arrow(c[0]), direction) / k_one, dot(arrow(c[1]), direction) / k_one,
                   dot(arrow(c[2]), direction) / k_one};
  const Convex& convex = *placed.convex;
  const double x = convex.size[0], y = convex.size[1], z = convex.size[2], across = sqrt(d.x * d.x + d.z * d.z);
  switch (convex.type) {
    case ShapeType::box:
      return fabs(d.x) * x + fabs(d.y) * y + fabs(d.z) * z;
    case ShapeType::capsule:
      return fabs(d.y) * y;
    case ShapeType::cylinder:
      return x * across + y * fabs(d.y);
    case ShapeType::cone:
      return std::max(1.5 * y * d.y, x * across - y / 2 * d.y);
    default:
      return 0;
  }
}

/// The depth along an axis along which B moves out. No axis has less depth than the least depth.
double depth_along(const Placed& a, const Placed& b, const Vec32& offset, const Arrow& axis) {
  const Arrow back = {-axis.x, -axis.y, -axis.z};
  return exact_support(a, axis) + exact_support(b, back) - dot(axis, arrow(offset));
}

DETENT_TEST(penetration, of_cylinders_and_cones_is_the_least_over_all_directions) {
  constexpr ShapeType k_types[] = {ShapeType::cylinder, ShapeType::cone, ShapeType::box, ShapeType::capsule,
                                   ShapeType::sphere};
  Samples samples{41};
  uint32_t overlaps = 0, capped = 0;
  double gap_max = 0, error_max = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(10000); ++i) {
    const auto size = [&] { return static_cast<int32_t>((1 << 25) + samples.below(1 << 26)); };
    const Convex a = core(k_types[samples.below(2)], size(), size(), size());
    const Convex b = core(k_types[samples.below(5)], size(), size(), size());
    const Placed placed_a = place(a, random_rotation(samples), k_exponent);
    const Placed placed_b = place(b, random_rotation(samples), k_exponent);
    const auto displacement = [&] { return static_cast<int32_t>(samples.below(1 << 28)) - (1 << 27); };
    const Vec32 offset = {displacement(), displacement(), displacement()};
    Simplex simplex;
    if (gjk(placed_a, placed_b, offset, simplex, {}).outcome != GjkOutcome::overlap) continue;
    ++overlaps;
    const Penetration found = penetration(placed_a, placed_b, offset, simplex);
    const Arrow normal = arrow(found.normal);
    const double size_of_normal = length(normal);
    const Arrow unit = {normal.x / size_of_normal, normal.y / size_of_normal, normal.z / size_of_normal};
    // The depth equals the depth along its axis, and no other axis has less than `lower`.
    error_max = std::max(error_max, fabs(depth_along(placed_a, placed_b, offset, unit) - found.depth));
    for (int k = 0; k < 100; ++k) {
      Arrow axis = {static_cast<double>(samples.integer(30)), static_cast<double>(samples.integer(30)),
                    static_cast<double>(samples.integer(30))};
      const double near = k < 50 ? ldexp(1, -static_cast<int>(samples.below(24))) : 1;
      const double scale = near / (length(axis) + 1);
      axis = k < 50 ? Arrow{unit.x + axis.x * scale, unit.y + axis.y * scale, unit.z + axis.z * scale} : axis;
      const double l = length(axis);
      if (l == 0) continue;
      ASSERT_GE(depth_along(placed_a, placed_b, offset, {axis.x / l, axis.y / l, axis.z / l}),
                found.lower - k_penetration_slack);
    }
    capped += found.capped ? 1 : 0;
    ASSERT_TRUE(found.capped || found.depth - found.lower <= k_penetration_gap + 2);
    gap_max = std::max(gap_max, static_cast<double>(found.depth - found.lower));
  }
  printf("%u overlap, %u capped, between the bounds at most %.1e of size, depth errs by %.2f ulps at most\n", overlaps,
         capped, gap_max / 0x1p27, error_max);
  EXPECT_LE(capped, overlaps / 50);
  EXPECT_LE(gap_max, 0x1p27 / 500);
  EXPECT_LE(error_max, k_penetration_slack);
}

DETENT_TEST(penetration, of_cylinders_and_cones_in_line_is_as_in_closed_form) {
  const int32_t radius = 100000, half = 300000;
  const Convex drum = core(ShapeType::cylinder, radius, half, 0), hat = core(ShapeType::cone, radius, half, 0),
               point = core(ShapeType::sphere, 0, 0, 0);
  const Placed a = place(drum, k_upright, k_exponent), cone = place(hat, k_upright, k_exponent),
               p = place(point, k_upright, k_exponent);
  // Side by side; one on the other; a point within.
  EXPECT_NEAR(find(a, a, {3 * radius / 2, 0, 0}).depth, radius / 2, 6);
  EXPECT_NEAR(find(a, a, {0, 2 * half - 777, 0}).depth, 777, 6);
  EXPECT_EQ(find(a, a, {0, 2 * half - 777, 0}).normal.y, k_one);
  EXPECT_NEAR(find(a, p, {60000, 0, 0}).depth, radius - 60000, 6);
  EXPECT_NEAR(find(a, p, {0, -half + 999, 0}).depth, 999, 6);
  EXPECT_EQ(find(a, p, {0, -half + 999, 0}).normal.y, -k_one);
  // The cone's side: its normal is (2 half, radius) in the plane of its axis, its base at -half / 2.
  EXPECT_NEAR(find(cone, p, {0, -half / 2 + 500, 0}).depth, 500, 6);
  const double slant = sqrt(4.0 * half * half + 1.0 * radius * radius);
  const double below = (1.5 * half - 100000) * radius / slant;
  // On the axis of the cone a ring of faces is equally near: the cap of vertices leaves an upper bound.
  const Penetration on_axis = find(cone, p, {0, 100000, 0});
  EXPECT_TRUE(on_axis.capped);
  EXPECT_LE(on_axis.lower, below + 6);
  EXPECT_NEAR(on_axis.depth, below, radius / 100);
  EXPECT_GE(on_axis.depth, below - 6);
  const double aside = below - 5000 * 2.0 * half / slant;
  EXPECT_NEAR(find(cone, p, {5000, 100000, 0}).depth, aside, 6);
  // Coincident centres and poses.
  EXPECT_NEAR(find(a, a, {0, 0, 0}).depth, 2 * radius, 6);
}

DETENT_TEST(penetration, of_flat_differences_is_0_across_them) {
  Convex triangle = core(ShapeType::triangle, 0, 0, 0);
  const int32_t corners[3][3] = {{-1000, 0, -1000}, {1000, 0, -1000}, {0, 0, 2000}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) triangle.corner[i][k] = corners[i][k];
  }
  const Convex point = core(ShapeType::sphere, 0, 0, 0), rod = core(ShapeType::capsule, 0, 1000, 0);
  const Placed t = place(triangle, k_upright, k_exponent), p = place(point, k_upright, k_exponent),
               upright = place(rod, k_upright, k_exponent),
               level = place(rod, {{{0, k_one, 0}, {k_one, 0, 0}, {0, 0, -k_one}}}, k_exponent);
  const auto expect_across = [](const Penetration& found, const Vec32& axis) {
    EXPECT_EQ(found.depth, 0);
    EXPECT_EQ(found.lower, 0);
    const int64_t along = dot(found.normal, axis);
    EXPECT_GE(along < 0 ? -along : along, (int64_t{1} << 60) - (1 << 4));
  };
  expect_across(find(t, t, {100, 0, 50}), {0, k_one, 0});
  expect_across(find(t, p, {10, 0, 10}), {0, k_one, 0});
  expect_across(find(upright, level, {100, 200, 0}), {0, 0, k_one});
  const Penetration in_line = find(upright, upright, {0, 500, 0});
  EXPECT_EQ(in_line.depth, 0);
  EXPECT_EQ(in_line.normal.y, 0);
  expect_across(find(level, level, {300, 0, 0}), {0, k_one, 0});
  EXPECT_EQ(find(p, p, {0, 0, 0}).depth, 0);
  EXPECT_EQ(find(p, p, {0, 0, 0}).normal.y, k_one);
  // A triangle and a segment through it have a volume in the difference: the shortest translation is along the
  // triangle, or the length of the segment.
  const Penetration through = find(t, upright, {0, 900, 0});
  EXPECT_EQ(through.depth, 100);
  EXPECT_EQ(through.normal.y, k_one);
}

DETENT_TEST(penetration, of_needles_plates_and_what_just_touches) {
  const int32_t length = 200000000;
  const Convex needle = core(ShapeType::box, length, length / 1000, length / 1000),
               plate = core(ShapeType::box, length, length / 1000, length);
  const Placed n = place(needle, k_upright, k_exponent), f = place(plate, k_upright, k_exponent);
  const int32_t thin = 2 * (length / 1000);
  EXPECT_EQ(find(n, n, {0, 0, 0}).depth, thin);
  EXPECT_EQ(find(f, f, {0, 0, 0}).depth, thin);
  EXPECT_EQ(find(f, f, {0, 0, 0}).normal.x, 0);
  EXPECT_EQ(find(n, f, {0, thin, 0}).depth, 0);
  EXPECT_EQ(find(n, f, {0, thin, 0}).normal.y, k_one);
  EXPECT_EQ(find(n, f, {0, -thin + 1, 0}).depth, 1);
  EXPECT_EQ(find(n, f, {0, -thin + 1, 0}).normal.y, -k_one);
  EXPECT_EQ(find(n, n, {2 * length, 0, 0}).depth, 0);
  EXPECT_EQ(find(n, n, {2 * length, 0, 0}).normal.x, k_one);
  Samples samples{43};
  Tally tally;
  for (int i = 0; i < 20000; ++i) {
    const Placed a = place(samples.below(2) == 0 ? needle : plate, random_rotation(samples), k_exponent);
    const Placed b = place(samples.below(2) == 0 ? needle : plate, random_rotation(samples), k_exponent);
    const auto displacement = [&] { return static_cast<int32_t>(samples.below(2 * length)) - length; };
    check_polytopes(
        a, b, samples.below(4) == 0 ? Vec32{0, 0, 0} : Vec32{displacement(), displacement() / 1000, displacement()},
        tally);
    if (HasFatalFailure()) FAIL() << "pair " << i;
  }
  printf("%u overlap, at most %d supports, error at most %.2f ulps\n", tally.overlaps, tally.supports_max,
         tally.error_max);
  EXPECT_GT(tally.overlaps, 2000u);
  EXPECT_EQ(tally.capped, 0u);
}

DETENT_TEST(penetration, of_a_half_space_along_an_axis_is_exact) {
  Convex ground, cube;
  ASSERT_OK(make_convex(half_space(), ground));
  ASSERT_OK(make_convex(box({0.5, 0.5, 0.5}), cube));
  const Matrix32 unturned = {{{1 << 30, 0, 0}, {0, 1 << 30, 0}, {0, 0, 1 << 30}}};
  const Placed below = place(ground, unturned, 1), above = place(cube, unturned, 1);
  const int32_t half = 1 << 28;  // the block's unit is 2 m
  for (const int32_t depth : {0, 1, 2, 1000, half, 2 * half}) {
    const Vec32 offset = {12345, half - depth, -678};
    const Penetration found = penetration(below, above, offset, {});
    EXPECT_EQ(found.depth, depth);
    EXPECT_EQ(found.lower, depth);
    EXPECT_TRUE((found.normal == Vec32{0, 1 << 30, 0}));
    const Penetration other = penetration(above, below, negate(offset), {});
    EXPECT_EQ(other.depth, depth);
    EXPECT_TRUE((other.normal == Vec32{0, -(1 << 30), 0}));
    EXPECT_EQ(found.point_a.y, 0);
    EXPECT_EQ(found.point_b.y, -half);
    EXPECT_EQ(other.point_b.y, 0);
  }
  EXPECT_EQ(penetration(below, above, {0, half + 1, 0}, {}).depth, 0) << "apart";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
