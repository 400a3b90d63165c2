#include "tests/common/oracle/convex_toi.h"

#include <gtest/gtest.h>
#include <stdio.h>

#include <algorithm>

#include "tests/common/oracle/effort.h"
#include "tests/common/oracle/random_solids.h"

/// The time-of-impact oracle against closed forms, against dense sampling, and its bound against what it bounds.
namespace detent_oracle {
namespace {

using detent_queries::Kind;
using detent_queries::Query;
using detent_queries::Solid;
using detent_queries::Triple;

Solid ball(double radius) {
  Solid solid;
  solid.radius = radius;
  return solid;
}
Solid box(double x, double y, double z) {
  Solid solid;
  solid.kind = Kind::box;
  solid.half_extents = {x, y, z};
  return solid;
}
Solid rod(Kind kind, double radius, double half_length) {
  Solid solid;
  solid.kind = kind;
  solid.radius = radius;
  solid.half_length = half_length;
  return solid;
}
Solid ground() {
  Solid solid;
  solid.kind = Kind::half_space;
  return solid;
}
std::array<double, 4> quarter_about_z() { return {0, 0, 1, 1}; }
double worst_of(double worst, Number error) { return std::max(worst, static_cast<double>(fabsl(error))); }

TEST(convex_toi, of_spheres_is_the_root_of_the_quadratic) {
  Dice dice(11);
  double worst = 0, worst_gap = 0;
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    Query query;
    query.a = ball(dice.between(0.1, 1));
    query.b = ball(dice.between(0.1, 1));
    const double distance_max = dice.between(2.1, 5), wide = dice.between(0, 1.5);
    query.path_b.position = {distance_max, wide, 0};
    query.path_b.displacement = {-10, 0, 0};
    query.path_b.rotation_vector = {1, 2, 3};
    query.path_a.rotation_vector = dice.direction();
    const Number sum = static_cast<Number>(query.a.radius) + query.b.radius;
    const Verdict verdict = judge(query);
    ASSERT_EQ(verdict.hit, wide < sum);
    EXPECT_TRUE(verdict.certain);
    if (verdict.hit) {
      ++hits;
      worst = worst_of(worst, verdict.time - (distance_max - sqrtl(sum * sum - static_cast<Number>(wide) * wide)) / 10);
    } else {
      worst_gap = worst_of(worst_gap, verdict.gap_min - (wide - sum));
      EXPECT_NEAR(static_cast<double>(verdict.gap_min_time), distance_max / 10, 1e-6);
      EXPECT_LE(verdict.gap_min_floor, verdict.gap_min);
    }
  }
  printf("spheres: time error %.1e, least gap error %.1e m\n", worst, worst_gap);
  EXPECT_GT(hits, 200);
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(worst_gap, 1e-14);
}

TEST(convex_toi, of_what_falls_on_a_plane_is_its_height_over_its_speed) {
  const double corner = sqrt(3.0);
  struct Case {
    const char* name;
    Solid solid;
    std::array<double, 4> rotation;
    Number distance_max;  ///< down
  };
  // The corner: (1, 1, 1) turned down, about (1, 0, -1) by pi - acos(1 / sqrt 3).
  const double half = (M_PI - acos(1 / corner)) / 2, s = sin(half) / sqrt(2.0);
  const Case cases[] = {
      {"sphere", ball(0.5), {0, 0, 0, 1}, 0.5L},
      {"box, flat", box(0.25, 0.5, 0.125), {0, 0, 0, 1}, 0.5L},
      {"box, on its side", box(0.25, 0.5, 0.125), quarter_about_z(), 0.25L},
      {"box, on its corner", box(1, 1, 1), {-s, 0, s, cos(half)}, sqrtl(3)},
      {"capsule, upright", rod(Kind::capsule, 0.25, 1), {0, 0, 0, 1}, 1.25L},
      {"cylinder, lying", rod(Kind::cylinder, 0.25, 1), quarter_about_z(), 0.25L},
      {"cone, upright", rod(Kind::cone, 0.25, 1), {0, 0, 0, 1}, 0.5L},
      {"cone, on its tip", rod(Kind::cone, 0.25, 1), {0, 0, 1, 0}, 1.5L},
  };
  double worst = 0;
  for (const Case& c : cases) {
    for (const bool slab : {false, true}) {
      Query query;
      query.a = slab ? box(8, 0.5, 8) : ground();
      query.path_a.position = {0, slab ? -0.5 : 0, 0};
      query.b = c.solid;
      query.path_b.position = {0.25, 3, 0.125};
      query.path_b.rotation = c.rotation;
      query.path_b.displacement = {0.5, -4, 0};
      const Verdict verdict = judge(query);
      ASSERT_TRUE(verdict.hit && verdict.certain) << c.name;
      const double error = static_cast<double>(fabsl(verdict.time - (3 - c.distance_max) / 4));
      EXPECT_LT(error, 1e-14) << c.name << (slab ? " on a slab" : "");
      worst = std::max(worst, error);
    }
  }
  printf("falls on a plane: time error %.1e\n", worst);
}

/// The first root of a function that is positive at 0, by a dense scan and bisection.
template <class Function>
Number first_root(const Function& f) {
  constexpr int k_scan = 20000;
  for (int i = 1; i <= k_scan; ++i) {
    Number high = static_cast<Number>(i) / k_scan, low = static_cast<Number>(i - 1) / k_scan;
    if (f(high) > 0) continue;
    for (int k = 0; k < 80; ++k) {
      const Number middle = (low + high) / 2;
      (f(middle) > 0 ? low : high) = middle;
    }
    return high;
  }
  return 2;
}

/// The least value of a function, by a dense scan and a search around its best.
template <class Function>
Number least_value(const Function& f) {
  constexpr int k_scan = 20000;
  int best = 0;
  for (int i = 1; i <= k_scan; ++i) {
    if (f(static_cast<Number>(i) / k_scan) < f(static_cast<Number>(best) / k_scan)) best = i;
  }
  Number low = static_cast<Number>(std::max(best - 1, 0)) / k_scan;
  Number high = static_cast<Number>(std::min(best + 1, k_scan)) / k_scan;
  for (int k = 0; k < 120; ++k) {
    const Number third = (high - low) / 3;
    (f(low + third) < f(high - third) ? high : low) = f(low + third) < f(high - third) ? high - third : low + third;
  }
  return f(low);
}

TEST(convex_toi, of_a_turning_rods_tip_on_a_plane_is_the_root_of_its_height) {
  Dice dice(12);
  double worst = 0, worst_least = 0;
  int hits = 0, clears = 0;
  for (int i = 0; i < 60; ++i) {
    const double radius = dice.between(0.01, 0.1), half = dice.between(0.3, 1),
                 angular_velocity = dice.between(-12, 12);
    const double height = dice.between(1.2, 1.6), fall = dice.between(0, 2);
    const bool box_rod = i % 2 == 0;
    Query query;
    query.a = i % 3 == 0 ? box(8, 0.5, 8) : ground();
    query.path_a.position = {0, i % 3 == 0 ? -0.5 : 0, 0};
    query.b = box_rod ? box(half, radius, radius) : rod(Kind::capsule, radius, half);
    query.path_b.position = {0, height, 0};
    if (!box_rod) query.path_b.rotation = quarter_about_z();
    query.path_b.displacement = {0, -fall, 0};
    query.path_b.rotation_vector = {0, 0, angular_velocity};
    const auto gap = [&](Number t) {
      const Number sine = fabsl(sinl(angular_velocity * t)), cosine = fabsl(cosl(angular_velocity * t));
      return height - fall * t - half * sine - radius * (box_rod ? cosine : 1);
    };
    const Number root = first_root(gap);
    const Verdict verdict = judge(query);
    ASSERT_EQ(verdict.hit, root <= 1) << i;
    EXPECT_TRUE(verdict.certain);
    (verdict.hit ? hits : clears) += 1;
    if (verdict.hit) {
      worst = worst_of(worst, verdict.time - root);
    } else {
      worst_least = worst_of(worst_least, verdict.gap_min - least_value(gap));
    }
  }
  printf("rod's tip on a plane: time error %.1e, least gap error %.1e m, %d hits, %d clear\n", worst, worst_least, hits,
         clears);
  EXPECT_LT(worst_least, 1e-14);
  EXPECT_GT(hits, 15);
  EXPECT_GT(clears, 5);
  EXPECT_LT(worst, 1e-12);
}

TEST(convex_toi, of_a_sweeping_rod_and_a_post_is_an_arc_sine) {
  Dice dice(13);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const double away = dice.between(0.3, 0.9), angle = dice.between(0.5, 2.6);
    Query query;
    query.a = i % 2 == 0 ? rod(Kind::capsule, 0.0625, 1) : box(0.0625, 1, 0.0625);
    query.b = ball(0.0625);
    if (i % 4 >= 2) query.b = rod(Kind::cylinder, 0.0625, 0.5);
    // The rod lies along x and turns about z, the post stands along z.
    query.path_a.rotation = quarter_about_z();
    query.path_b.rotation = {1, 0, 0, 1};
    query.path_a.rotation_vector = {0, 0, 3.125};
    query.path_b.position = {away * cos(angle), away * sin(angle), 0};
    const Number x = query.path_b.position[0], y = query.path_b.position[1];
    const Number truth = (atan2l(y, x) - asinl(0.125L / hypotl(x, y))) / 3.125L;
    const Verdict verdict = judge(query);
    ASSERT_TRUE(verdict.hit && verdict.certain) << i;
    worst = worst_of(worst, verdict.time - truth);
  }
  printf("rod against a post: time error %.1e\n", worst);
  EXPECT_LT(worst, 1e-13);
}

TEST(convex_toi, of_a_turning_half_space_is_the_root_of_its_height) {
  Query query;
  query.a = ground();
  query.path_a.rotation_vector = {0, 0, 1};
  query.b = box(0.25, 0.25, 0.25);
  query.path_b.position = {2, 1, 0};
  for (const bool swapped : {false, true}) {
    if (swapped) {
      std::swap(query.a, query.b);
      std::swap(query.path_a, query.path_b);
    }
    const Number root = first_root([](Number t) {
      const Number s = sinl(t), c = cosl(t);
      return 1 * c - 2 * s - 0.25L * (fabsl(s) + fabsl(c));
    });
    const Verdict verdict = judge(query);
    ASSERT_TRUE(verdict.hit && verdict.certain);
    EXPECT_NEAR(static_cast<double>((verdict.time - root) * 1e14L), 0, 1);
  }
}

TEST(convex_toi, tells_a_graze_from_a_near_miss) {
  // A diamond below, its edge along z at the height sqrt(2) / 2; a box flies over it, level, or across, corner first.
  const double height = sqrt(0.5);
  for (const double clearance : {1e-3, 1e-6, 1e-9}) {
    for (const double sign : {1.0, -1.0}) {
      for (const bool turned_box : {false, true}) {
        Query query;
        query.a = box(0.5, 0.5, 0.5);
        query.path_a.rotation = {0, 0, sin(M_PI / 8), cos(M_PI / 8)};
        query.b = box(0.25, 0.25, 0.25);
        if (turned_box) query.path_b.rotation = {sin(M_PI / 8), 0, 0, cos(M_PI / 8)};
        const double low = turned_box ? 0.25 * sqrt(2.0) : 0.25;
        query.path_b.position = {-2, height + low + sign * clearance, 0};
        query.path_b.displacement = {4, 0, 0};
        const Verdict verdict = judge(query);
        ASSERT_EQ(verdict.hit, sign < 0);
        EXPECT_TRUE(verdict.certain);
        EXPECT_NEAR(static_cast<double>(verdict.gap_min), sign * clearance, (sign < 0 ? 0.2 : 1e-6) * clearance);
        if (sign > 0) {
          EXPECT_GT(verdict.gap_min_floor, 0.98L * clearance);
        }
      }
    }
  }
}

TEST(convex_toi, tells_a_spinning_graze_from_a_near_miss) {
  // A square angular velocities over a plane; its corner passes the lowest point at an eighth of a turn.
  for (const double clearance : {1e-3, 1e-6, 1e-9}) {
    for (const double sign : {1.0, -1.0}) {
      for (const bool slab : {false, true}) {
        Query query;
        query.a = slab ? box(4, 0.5, 4) : ground();
        query.path_a.position = {0, slab ? -0.5 : 0, 0};
        query.b = box(1, 1, 0.125);
        query.path_b.position = {0.125, sqrt(2.0) + sign * clearance, 0};
        query.path_b.rotation_vector = {0, 0, 12};
        const Verdict verdict = judge(query);
        ASSERT_EQ(verdict.hit, sign < 0) << clearance;
        EXPECT_TRUE(verdict.certain);
        if (sign > 0) {
          EXPECT_NEAR(static_cast<double>(verdict.gap_min), clearance, 1e-15);
        } else {
          // The first corner comes down at pi / 4.
          const Number lead = acosl(1 - static_cast<Number>(clearance) / sqrtl(2));
          EXPECT_NEAR(static_cast<double>(12 * verdict.time), static_cast<double>(M_PI / 4 - lead),
                      1e-6 * static_cast<double>(lead));
        }
      }
    }
  }
}

TEST(convex_toi, starts_close_or_overlapped) {
  Query query;
  query.a = box(0.5, 0.5, 0.5);
  query.b = box(0.5, 0.5, 0.5);
  const double gap = 0x1p-30;
  query.path_b.position = {0, 1 + gap, 0};
  query.path_b.displacement = {0, 1, 0};
  EXPECT_FALSE(judge(query).hit) << "separating";
  query.path_b.displacement = {0.25, 0, 0};
  EXPECT_FALSE(judge(query).hit) << "sliding";
  EXPECT_NEAR(static_cast<double>(judge(query).gap_min), gap, 1e-17);
  query.path_b.rotation_vector = {0, 6, 0};
  EXPECT_FALSE(judge(query).hit) << "spinning about the normal";
  query.path_b.rotation_vector = {0, 0, 1};
  EXPECT_TRUE(judge(query).hit) << "tilting";
  query.path_b.rotation_vector = {0, 0, 0};
  query.path_b.displacement = {0, -0.5, 0};
  EXPECT_NEAR(static_cast<double>(judge(query).time), 2 * gap, 1e-15) << "approaching";
  query.path_b.position = {0, 1, 0};
  EXPECT_TRUE(judge(query).hit && judge(query).time == 0) << "touching";
  query.path_b.position = {0.25, 0.5, 0};
  query.path_b.displacement = {0, 8, 0};
  EXPECT_TRUE(judge(query).hit && judge(query).time == 0) << "overlapped";
  EXPECT_NEAR(static_cast<double>(judge(query).gap_min), -0.5, 1e-12);
}

Query random_query(Dice& dice, Kind kind_a, Kind kind_b, double size) {
  Query query;
  query.a = random_solid(dice, kind_a, size);
  query.b = random_solid(dice, kind_b, size);
  const auto vector = [&dice](double most) {
    const Triple v = dice.direction();
    const double length = dice.between(0, most);
    return Triple{v[0] * length, v[1] * length, v[2] * length};
  };
  const double angular_velocity = dice.below(3) == 0 ? 12 : 2;
  query.path_a.rotation = dice.rotation();
  query.path_b.rotation = dice.rotation();
  if (dice.below(4) != 0) query.path_a.rotation_vector = vector(angular_velocity);
  if (dice.below(4) != 0) query.path_b.rotation_vector = vector(angular_velocity);
  const Triple away = dice.direction();
  const Triple aside = vector(1.2 * size);
  const double far = size * dice.between(0.5, 5), speed = dice.coin() ? dice.between(0, 2) : 0.1;
  for (size_t i = 0; i < 3; ++i) {
    query.path_b.position[i] = far * away[i];
    query.path_b.displacement[i] = -speed * far * away[i] + aside[i];
  }
  return query;
}

TEST(convex_toi, is_where_dense_sampling_first_finds_contact_for_all_kinds) {
  Dice dice(14);
  double worst_contact = 0, worst_early = 0, worst_near = 0;
  int hits = 0, clears = 0, starts = 0, uncertain = 0, samples = 0, samples_max = 0, count = 0;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      if (i == 7 && j == 7) continue;
      for (uint32_t k = 0; k < rounds(10); ++k) {
        const double unit = k % 10 == 0 ? 1e-3 : k % 10 == 1 ? 100 : 1;
        const Query query = random_query(dice, static_cast<Kind>(i), static_cast<Kind>(j), unit);
        const Encounter encounter = encounter_of(query);
        const Verdict verdict = judge(encounter);
        ASSERT_TRUE(verdict.complete);
        const Number size = verdict.size;
        ++count;
        samples += verdict.samples;
        samples_max = std::max(samples_max, verdict.samples);
        uncertain += verdict.certain ? 0 : 1;
        if (verdict.hit && verdict.time == 0) {
          ++starts;
          EXPECT_LE(signed_gap_at(encounter, 0), verdict.contact);
          continue;
        }
        (verdict.hit ? hits : clears) += 1;
        if (verdict.hit) worst_contact = worst_of(worst_contact, signed_gap_at(encounter, verdict.time) / size);
        constexpr int k_dense = 60;
        for (int l = 0; l <= k_dense; ++l) {
          // For a hit denser towards it.
          const Number back = static_cast<Number>(l) / k_dense;
          const Number time = verdict.hit ? verdict.time * (1 - back * back * back) : back;
          const Number gap =
              separation_of(encounter.a, encounter.b, placement_at(encounter, time), {1e-14L * size, 1e-6L}).gap;
          if (verdict.hit) {
            worst_early = std::max(worst_early, static_cast<double>(-gap / size));
          } else {
            EXPECT_GE(gap, verdict.gap_min_floor) << i << " " << j << " " << k;
            worst_near = std::max(worst_near, static_cast<double>((verdict.gap_min - gap) / verdict.gap_min));
          }
        }
      }
    }
  }
  printf("all kinds: %d hits, %d clear, %d overlapped at the start, %d uncertain; samples %.0f, at most %d\n", hits,
         clears, starts, uncertain, static_cast<double>(samples) / count, samples_max);
  printf("all kinds: |gap| at contact %.1e of size, depth before %.1e of size, least gap %.1e of itself\n",
         worst_contact, worst_early, worst_near);
  EXPECT_GT(hits, 100);
  EXPECT_GT(clears, 100);
  EXPECT_LE(uncertain, count / 50);
  EXPECT_LT(worst_contact, 1e-13);
  EXPECT_LT(worst_early, 1e-12);
  EXPECT_LT(worst_near, 1.5e-2);
}

TEST(convex_toi, does_not_depend_on_the_place) {
  Dice dice(15);
  for (int i = 0; i < 40; ++i) {
    Query query = random_query(dice, static_cast<Kind>(i % 7), static_cast<Kind>((i + 2) % 7), 1);
    for (double& x : query.path_b.position) x = round(x * 8) / 8;
    const Verdict near = judge(query);
    for (size_t k = 0; k < 3; ++k) {
      query.path_a.position[k] += 1e7;
      query.path_b.position[k] += 1e7;
    }
    const Verdict far = judge(query);
    EXPECT_EQ(near.hit, far.hit);
    EXPECT_EQ(near.time, far.time);
    EXPECT_EQ(near.gap_min, far.gap_min);
  }
}

TEST(convex_toi, chord_less_excess_bounds_the_separation_along_any_turning_axis) {
  Dice dice(16);
  double tightest = HUGE_VAL;
  for (int i = 0; i < 3000; ++i) {
    const Kind kind_a = static_cast<Kind>(dice.below(7)), kind_b = static_cast<Kind>(dice.below(7));
    const Query query = random_query(dice, kind_a, kind_b, 1);
    const Encounter e = encounter_of(query);
    const Arrow axis = dice.arrow(1);
    const int choice = dice.below(4);
    const Arrow omega = choice == 0   ? Arrow{0, 0, 0}
                        : choice == 1 ? e.turn_a
                        : choice == 2 ? e.turn_b
                                      : dice.arrow(dice.between(0, 12));
    const Number from = dice.between(0, 1), to = from + (1 - from) * dice.between(0, 0.5);
    const auto separation = [&](Number time) {
      return separation_along(e.a, e.b, placement_at(e, time), turned(axis, omega * (time - from)));
    };
    const Number at_from = separation(from), at_to = separation(to);
    const Number excess = chord_excess(e, axis, omega, from, to);
    for (int k = 1; k < 16; ++k) {
      const Number r = k / 16.0L;
      const Number bound = at_from * (1 - r) + at_to * r - 4 * excess * r * (1 - r);
      const Number left = separation(from + (to - from) * r) - bound;
      EXPECT_GE(left, -1e-17L) << i;
      if (excess > 1e-9L) tightest = std::min(tightest, static_cast<double>(left / (4 * excess * r * (1 - r))));
    }
  }
  printf("bound: what is left at least, of the excess: %.2e\n", tightest);
}

}  // namespace
}  // namespace detent_oracle
