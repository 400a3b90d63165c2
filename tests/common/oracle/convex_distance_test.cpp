#include "tests/common/oracle/convex_distance.h"

#include <gtest/gtest.h>
#include <stdio.h>

#include <algorithm>

#include "tests/common/oracle/random_solids.h"

/// The distance oracle against closed forms, against all pairs of features, and against its own certificate.
namespace detent_oracle {
namespace {

using detent_queries::Kind;
using detent_queries::Solid;

Placement random_placement(Dice& dice, const Arrow& offset) {
  return {frame_of(dice.rotation()), frame_of(dice.rotation()), offset};
}
Solid ball(double radius) {
  Solid solid;
  solid.radius = radius;
  return solid;
}
/// Moves B along a line until the rounded solids have the gap, up to about 1e-19.
void set_gap(const ConvexSolid& a, const ConvexSolid& b, Placement& placement, const Arrow& direction, Number gap) {
  Number low = 0, high = 4 * (a.distance_max + b.distance_max + a.rounding + b.rounding) + fabsl(gap);
  for (int i = 0; i < 70; ++i) {
    const Number middle = (low + high) / 2;
    placement.offset = direction * middle;
    (separation_of(a, b, placement, {1e-3L * fabsl(gap), 0}).gap < gap ? low : high) = middle;
  }
  placement.offset = direction * high;
}

TEST(convex_distance, of_spheres_and_points_and_rods_is_the_closed_form) {
  Dice dice(1);
  Number worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const ConvexSolid a = solid_of(ball(dice.between(0.1, 1))), b = solid_of(ball(dice.between(0.1, 1)));
    const Placement placement = random_placement(dice, dice.arrow(dice.between(0, 3)));
    const Separation s = separation_of(a, b, placement);
    worst = std::max(worst, fabsl(s.gap - (length(placement.offset) - a.rounding - b.rounding)));
    Solid rod;
    rod.kind = Kind::capsule;
    rod.radius = 0.125;
    rod.half_length = dice.between(0.1, 1);
    const Arrow along = placement.a.axis[1];
    const Number distance_max = rod.half_length;
    const Number nearest = std::clamp(dot(along, placement.offset), -distance_max, distance_max);
    const Number truth = length(placement.offset - along * nearest) - 0.125L - b.rounding;
    worst = std::max(worst, fabsl(separation_of(solid_of(rod), b, placement).gap - truth));
  }
  printf("spheres, rods: error %.1Le m\n", worst);
  EXPECT_LT(worst, 2e-18L);
}

/// Signed distance of (x, y) to the triangle that a cone's half profile is, mirrored at x = 0.
Number distance_to_cone(const Solid& cone, Number x, Number y) {
  const Number r = cone.radius, h = cone.half_length;
  const Number slant = sqrtl(r * r + 4 * h * h);
  const Number side = (2 * h * x + r * (y - 1.5L * h)) / slant, base = -h / 2 - y;
  if (side <= 0 && base <= 0) return std::max(side, base);
  const auto to_segment = [x, y](Number ax, Number ay, Number bx, Number by) {
    const Number ex = bx - ax, ey = by - ay;
    const Number t = std::clamp(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0L, 1.0L);
    return hypotl(x - ax - t * ex, y - ay - t * ey);
  };
  return std::min(to_segment(0, 1.5L * h, r, -h / 2), to_segment(0, -h / 2, r, -h / 2));
}

TEST(convex_distance, of_a_point_to_box_cylinder_and_cone_is_the_closed_form_inside_too) {
  Dice dice(2);
  Number worst = 0, worst_depth = 0, size = 0;
  for (int i = 0; i < 1500; ++i) {
    Solid solid;
    solid.kind = i % 3 == 0 ? Kind::box : i % 3 == 1 ? Kind::cylinder : Kind::cone;
    solid.radius = dice.between(0.2, 1);
    solid.half_length = dice.between(0.2, 1);
    solid.half_extents = {dice.between(0.2, 1), dice.between(0.2, 1), dice.between(0.2, 1)};
    const ConvexSolid a = solid_of(solid), b = solid_of(ball(0.25));
    const Placement placement = random_placement(dice, dice.arrow(dice.between(0, 2)));
    const Arrow p = to_local(placement.a, placement.offset);
    Number truth = 0;
    if (solid.kind == Kind::cone) {
      truth = distance_to_cone(solid, hypotl(p.x, p.z), p.y);
    } else {
      const Number x = solid.kind == Kind::box ? fabsl(p.x) - solid.half_extents[0] : hypotl(p.x, p.z) - solid.radius;
      const Number y = fabsl(p.y) - (solid.kind == Kind::box ? solid.half_extents[1] : solid.half_length);
      const Number z = solid.kind == Kind::box ? fabsl(p.z) - solid.half_extents[2] : x;
      const Number out_z = solid.kind == Kind::box ? std::max(z, 0.0L) : 0;
      truth = std::max({x, y, z});
      if (truth > 0) truth = length({std::max(x, 0.0L), std::max(y, 0.0L), out_z});
    }
    const Separation s = separation_of(a, b, placement);
    size = std::max(size, size_of(a, b));
    ASSERT_EQ(s.overlap, truth < 0) << i;
    const Number error = fabsl(s.gap + b.rounding - truth);
    (truth < 0 && solid.kind != Kind::box ? worst_depth : worst) =
        std::max(truth < 0 && solid.kind != Kind::box ? worst_depth : worst, error);
  }
  printf("point and box, cylinder, cone: error %.1Le m, depth in curved ones %.1Le m\n", worst, worst_depth);
  EXPECT_LT(worst, 1e-15L * size);
  EXPECT_LT(worst_depth, 1e-5L * size);
}

std::vector<Arrow> world_points(const ConvexSolid& solid, const Frame& frame, const Arrow& offset) {
  std::vector<Arrow> points;
  for (const Arrow& p : solid.points) points.push_back(offset + to_world(frame, p));
  return points;
}
Number distance_to_triangle(const Arrow& p, const Arrow& a, const Arrow& b, const Arrow& c) {
  const Arrow n = cross(b - a, c - a);
  const Number square = dot(n, n);
  const Number u = dot(cross(p - a, c - a), n), v = dot(cross(b - a, p - a), n);
  // Its edges come as pairs of segments.
  return square > 0 && u >= 0 && v >= 0 && u + v <= square ? fabsl(dot(n, p - a)) / sqrtl(square) : HUGE_VALL;
}
Number distance_of_segments(const Arrow& p, const Arrow& q, const Arrow& r, const Arrow& s) {
  const Arrow d = q - p, e = s - r, w = p - r;
  const Number dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dw = dot(d, w), ew = dot(e, w);
  Number best = HUGE_VALL;
  const auto at = [&](Number x, Number y) {
    x = std::clamp(x, 0.0L, 1.0L);
    y = std::clamp(y, 0.0L, 1.0L);
    best = std::min(best, length(w + d * x - e * y));
  };
  for (const Number end : {0.0L, 1.0L}) {
    at(end, (ew + de * end) / ee);
    at((de * end - dw) / dd, end);
  }
  const Number under = dd * ee - de * de;
  if (under > 1e-12L * dd * ee) at((de * ew - ee * dw) / under, (dd * ew - de * dw) / under);
  return best;
}

/// Over all triples of one with all points of the other, and all pairs with all pairs: more than all features.
Number brute_distance(const std::vector<Arrow>& a, const std::vector<Arrow>& b) {
  Number best = HUGE_VALL;
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (size_t i = 0; i < one->size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        for (size_t k = 0; k < j; ++k) {
          for (const Arrow& p : *other) best = std::min(best, distance_to_triangle(p, (*one)[i], (*one)[j], (*one)[k]));
        }
      }
    }
  }
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < b.size(); ++k) {
        for (size_t l = 0; l < k; ++l) best = std::min(best, distance_of_segments(a[i], a[j], b[k], b[l]));
      }
    }
  }
  return best;
}
/// The largest separation along the normals of all triples and of all pairs of pairs.
Number brute_separation(const ConvexSolid& solid_a, const ConvexSolid& solid_b, const Placement& placement,
                        const std::vector<Arrow>& a, const std::vector<Arrow>& b) {
  Number best = -HUGE_VALL;
  const auto consider = [&](const Arrow& n) {
    const Number size = length(n);
    if (!(size > 1e-12L)) return;
    for (const Number sign : {1 / size, -1 / size}) {
      best = std::max(best, separation_along(solid_a, solid_b, placement, n * sign));
    }
  };
  for (const auto* points : {&a, &b}) {
    for (size_t i = 0; i < points->size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        for (size_t k = 0; k < j; ++k) {
          consider(cross((*points)[j] - (*points)[i], (*points)[k] - (*points)[i]));
        }
      }
    }
  }
  for (size_t i = 0; i < a.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (size_t k = 0; k < b.size(); ++k) {
        for (size_t l = 0; l < k; ++l) consider(cross(a[j] - a[i], b[l] - b[k]));
      }
    }
  }
  return best;
}

TEST(convex_distance, and_depth_of_hulls_are_those_of_all_pairs_of_features) {
  Dice dice(3);
  Number worst = 0, worst_depth = 0;
  int apart = 0, overlapped = 0;
  for (int i = 0; i < 400; ++i) {
    const double thin = i % 4 == 0 ? 1e-3 : 0.5;
    const int count_a = 4 + dice.below(5), count_b = 4 + dice.below(4);
    const double third = dice.coin() ? thin : 0.4;
    const ConvexSolid a = solid_of(random_hull(dice, count_a, {1, thin, 0.7}));
    const ConvexSolid b = solid_of(random_hull(dice, count_b, {0.6, 1, third}));
    Placement placement = random_placement(dice, {0, 0, 0});
    const Arrow direction = dice.arrow(1);
    set_gap(a, b, placement, direction, dice.coin() ? 1e-9L : dice.between(-0.3, 0.5));
    const Separation s = separation_of(a, b, placement);
    const auto points_a = world_points(a, placement.a, {0, 0, 0});
    const auto points_b = world_points(b, placement.b, placement.offset);
    const Number size = size_of(a, b);
    if (!s.overlap) {
      ++apart;
      worst = std::max(worst, fabsl(s.gap - brute_distance(points_a, points_b)) / size);
    } else {
      ++overlapped;
      worst_depth = std::max(worst_depth, fabsl(s.gap - brute_separation(a, b, placement, points_a, points_b)) / size);
    }
  }
  printf("hulls, all features: error %.1Le of size in %d apart, %.1Le in %d overlapped\n", worst, apart, worst_depth,
         overlapped);
  EXPECT_GT(apart, 50);
  EXPECT_GT(overlapped, 50);
  EXPECT_LT(worst, 1e-15L);
  EXPECT_LT(worst_depth, 1e-15L);
}

TEST(convex_distance, has_bounds_within_1e_14_of_the_size_for_all_kinds_at_all_gaps) {
  Dice dice(4);
  Number worst = 0, worst_touching = 0;
  int quadruple = 0, count = 0;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 8; ++j) {
      for (const double gap : {1e-9, -1e-9, 1e-6, 0.3}) {
        for (int k = 0; k < 5; ++k) {
          const double unit = k == 0 ? 1e-3 : k == 1 ? 100 : 1;
          const ConvexSolid a = solid_of(random_solid(dice, static_cast<Kind>(i), unit));
          const ConvexSolid b = solid_of(random_solid(dice, static_cast<Kind>(j), unit));
          const Number size = size_of(a, b);
          Placement placement = random_placement(dice, {0, 0, 0});
          if (b.core == CoreKind::half_space) {
            placement.offset = placement.b.axis[1] * -unit;
          } else {
            set_gap(a, b, placement, dice.arrow(1), gap * size);
          }
          const Separation s = separation_of(a, b, placement);
          ++count;
          quadruple += s.quadruple ? 1 : 0;
          // The bounds are what they say, found again by other paths.
          const Number rounding = rounding_of(a, b, placement.offset);
          ASSERT_LE(fabsl(separation_along(a, b, placement, s.axis) - s.separation), rounding);
          ASSERT_NEAR(static_cast<double>(length(s.axis)), 1, 1e-15);
          if (!s.overlap) {
            ASSERT_LE(fabsl(length(placement.offset + s.point_b - s.point_a) - s.distance), rounding);
            worst = std::max(worst, s.slack / size);
          } else if (a.rounding + b.rounding == 0) {
            worst_touching = std::max(worst_touching, (s.slack - 1e-5L * fabsl(s.gap)) / size);
          }
        }
      }
    }
  }
  printf("bounds: %.1Le of size apart, %.1Le touching, %d of %d in quadruple\n", worst, worst_touching, quadruple,
         count);
  EXPECT_LT(worst, 1e-14L);
  EXPECT_LT(worst_touching, 1e-14L);
}

TEST(convex_distance, has_bounds_that_never_contradict_whatever_axis_it_starts_from) {
  Dice dice(7);
  Number worst = -HUGE_VALL;
  int overlaps = 0, apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Kind kind_a = static_cast<Kind>(i % 2 == 0 ? 3 + i / 2 % 2 : 1 + dice.below(6));
    const Kind kind_b = static_cast<Kind>(1 + dice.below(6));
    Solid solid_a = random_solid(dice, kind_a, 1), solid_b = random_solid(dice, kind_b, 1);
    solid_a.rounding = solid_b.rounding = 0;
    ConvexSolid a = solid_of(solid_a), b = solid_of(solid_b);
    a.rounding = b.rounding = 0;
    Placement placement = random_placement(dice, {0, 0, 0});
    const Number size = size_of(a, b);
    // All but touching: within 1e-15 of the size.
    set_gap(a, b, placement, dice.arrow(1), 1e-14L * size);
    placement.offset = placement.offset - separation_of(a, b, placement).axis * (1e-14L * size);
    Number lower = -HUGE_VALL, upper = HUGE_VALL;
    for (int k = 0; k < 6; ++k) {
      const Separation s = separation_of(a, b, placement, {}, k == 0 ? Arrow{0, 0, 0} : dice.arrow(1));
      lower = std::max(lower, s.separation);
      upper = std::min(upper, s.overlap ? -s.depth_floor : s.distance);
      (s.overlap ? overlaps : apart) += 1;
    }
    const Number rounding = rounding_of(a, b, placement.offset);
    worst = std::max(worst, (lower - upper) / rounding);
    EXPECT_LE(lower, upper + rounding) << i;
  }
  printf("bounds from other starts, touching: lower above upper by %.1Le of rounding, %d overlaps, %d apart\n", worst,
         overlaps, apart);
  EXPECT_GT(overlaps, 100);
  EXPECT_GT(apart, 100);
}

TEST(convex_distance, of_parallel_faces_is_their_gap) {
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-9, 1e-12, -1e-9, -1e-3}) {
    for (const double thin : {1.0, 1e-3}) {
      Solid box;
      box.kind = Kind::box;
      box.half_extents = {1, thin, 0.5};
      Solid rod;
      rod.kind = Kind::cylinder;
      rod.radius = 0.25;
      rod.half_length = 1;
      const Frame straight = frame_of({0, 0, 0, 1}), lying = frame_of({0, 0, 0.5, 0.5});
      const Number y = 2 * static_cast<Number>(thin) + gap;
      const Separation boxes = separation_of(solid_of(box), solid_of(box), {straight, straight, {0.3L, y, 0.1L}});
      EXPECT_NEAR(static_cast<double>((boxes.gap - gap) * 1e18L), 0, 2);
      const Separation on_box =
          separation_of(solid_of(box), solid_of(rod), {straight, straight, {0.1L, y + 1 - thin, 0}});
      EXPECT_NEAR(static_cast<double>((on_box.gap - gap) * 1e18L), 0, 2);
      const Separation side =
          separation_of(solid_of(box), solid_of(rod), {straight, lying, {0.1L, y + 0.25L - thin, 0}});
      EXPECT_NEAR(static_cast<double>((side.gap - gap) * 1e15L), 0, fmax(2, 1e10 * -gap)) << gap;
    }
  }
}

TEST(convex_distance, of_cylinders_and_cones_lies_between_those_of_prisms_within_and_around) {
  Dice dice(5);
  constexpr int k_sides = 100;
  int strict = 0;
  for (int i = 0; i < 300; ++i) {
    Solid round;
    round.kind = dice.coin() ? Kind::cylinder : Kind::cone;
    round.radius = dice.between(0.1, 1);
    round.half_length = dice.between(0.1, 1);
    Solid within, around;
    within.kind = around.kind = Kind::hull;
    const double h = round.half_length, out = 1 / cos(M_PI / k_sides);
    for (int k = 0; k < k_sides; ++k) {
      const double c = round.radius * cos(2 * M_PI * k / k_sides), s = round.radius * sin(2 * M_PI * k / k_sides);
      const double low = round.kind == Kind::cone ? -h / 2 : -h;
      within.points.push_back({c, low, s});
      around.points.push_back({out * c, low, out * s});
      if (round.kind == Kind::cone) continue;
      within.points.push_back({c, h, s});
      around.points.push_back({out * c, h, out * s});
    }
    if (round.kind == Kind::cone) {
      within.points.push_back({0, 1.5 * h, 0});
      around.points.push_back({0, 1.5 * h, 0});
    }
    const Kind kind = static_cast<Kind>(dice.below(7));
    const ConvexSolid other = solid_of(random_solid(dice, kind, 1));
    const Placement placement = random_placement(dice, dice.arrow(dice.between(0, 3)));
    const Number gap = separation_of(solid_of(round), other, placement).gap;
    const Number least = separation_of(solid_of(around), other, placement).gap;
    const Number most = separation_of(solid_of(within), other, placement).gap;
    // Points are rounded to doubles, depths to a millionth.
    const Number fuzzy = 1e-14L + (gap < 0 ? -4 * k_depth_relative * gap : 0);
    EXPECT_LE(least, gap + fuzzy);
    EXPECT_GE(most, gap - fuzzy);
    EXPECT_LT(most - least, 2e-3L);
    strict += least < gap && gap < most ? 1 : 0;
  }
  EXPECT_GT(strict, 100);
}

TEST(convex_distance, to_a_half_space_is_that_of_the_lowest_point) {
  Dice dice(6);
  for (int i = 0; i < 300; ++i) {
    const ConvexSolid a = solid_of(random_hull(dice, 12, {1, 0.5, 0.2}));
    Solid plane;
    plane.kind = Kind::half_space;
    const ConvexSolid b = solid_of(plane);
    const Placement placement = random_placement(dice, dice.arrow(2));
    Number truth = HUGE_VALL;
    for (const Arrow& p : world_points(a, placement.a, {0, 0, 0})) {
      truth = std::min(truth, dot(placement.b.axis[1], p - placement.offset));
    }
    const Separation s = separation_of(a, b, placement);
    EXPECT_LT(fabsl(s.gap - truth), 1e-18L);
    const Separation swapped = separation_of(b, a, {placement.b, placement.a, -placement.offset});
    EXPECT_LT(fabsl(swapped.gap - truth), 1e-18L);
    EXPECT_LT(length(placement.offset + s.point_b - s.point_a - s.axis * truth), 2e-18L);
  }
}

}  // namespace
}  // namespace detent_oracle
