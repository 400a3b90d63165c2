#include "tests/queries/sets.h"

#include <gtest/gtest.h>

#include "tests/queries/gap.h"
#include "tests/queries/solids.h"

namespace detent_queries {

namespace {

constexpr uint32_t k_count = 48;
constexpr uint64_t k_seed = 7;

/// Every set that needs nothing from outside, with its queries.
template <class Check>
void for_each_set(const Check& check) {
  for (const Set& set : all_sets()) {
    if (std::string(set.name) == "game") continue;
    SCOPED_TRACE(set.name);
    check(set, make_queries(set, k_seed, k_count, {}));
  }
}

std::vector<Query> queries_of(const char* name) { return make_queries(*find_set(name), k_seed, k_count, {}); }

void expect_floats(const Triple& a) { EXPECT_EQ(a, to_float(a)); }

void expect_floats(const Solid& solid) {
  EXPECT_EQ(solid.radius, to_float(solid.radius));
  EXPECT_EQ(solid.half_length, to_float(solid.half_length));
  EXPECT_EQ(solid.rounding, to_float(solid.rounding));
  expect_floats(solid.half_extents);
  for (const Triple& point : solid.points) expect_floats(point);
}

void expect_floats(const Path& path) {
  double square = 0;
  for (const double component : path.rotation) {
    EXPECT_EQ(component, to_float(component));
    square += component * component;
  }
  EXPECT_NEAR(square, 1, 1e-6);
  expect_floats(path.position);
  expect_floats(path.displacement);
  expect_floats(path.turn);
}

bool same(const Solid& a, const Solid& b) {
  return a.kind == b.kind && a.radius == b.radius && a.half_length == b.half_length &&
         a.half_extents == b.half_extents && a.rounding == b.rounding && a.points == b.points;
}
bool same(const Path& a, const Path& b) {
  return a.position == b.position && a.rotation == b.rotation && a.displacement == b.displacement && a.turn == b.turn;
}
bool same(const Query& a, const Query& b) {
  return same(a.a, b.a) && same(a.b, b.b) && same(a.path_a, b.path_a) && same(a.path_b, b.path_b);
}

double approach_of(const Query& query) { return closest_approach(query).gap / size_of(query); }

}  // namespace

TEST(sets, every_number_is_a_float) {
  for_each_set([](const Set&, const std::vector<Query>& queries) {
    for (const Query& query : queries) {
      expect_floats(query.a);
      expect_floats(query.b);
      expect_floats(query.path_a);
      expect_floats(query.path_b);
    }
  });
}

TEST(sets, a_query_depends_on_its_seed_and_index_alone) {
  for_each_set([](const Set& set, const std::vector<Query>& queries) {
    EXPECT_TRUE(same(make_query(set, k_seed, k_count - 1, {}), queries.back()));
    EXPECT_FALSE(same(make_query(set, k_seed + 1, k_count - 1, {}), queries.back()));
    EXPECT_FALSE(same(queries[0], queries[1]));
  });
}

TEST(sets, every_point_of_a_hull_is_extreme) {
  for_each_set([](const Set&, const std::vector<Query>& queries) {
    for (const Query& query : queries) {
      for (const Solid* solid : {&query.a, &query.b}) {
        if (solid->kind != Kind::hull) continue;
        std::vector<Triple> points = solid->points;
        keep_extreme(points, 1e-7 * bound_of(*solid));
        EXPECT_EQ(points.size(), solid->points.size());
      }
    }
  });
}

TEST(sets, a_point_within_a_hull_is_not_extreme) {
  std::vector<Triple> points = {{0, 0, 0}, {0.25, 0.25, 0.25}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0, 0, 1}};
  keep_extreme(points, 1e-12);
  EXPECT_EQ(points, (std::vector<Triple>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

TEST(sets, no_query_starts_overlapped) {
  for_each_set([](const Set&, const std::vector<Query>& queries) {
    for (const Query& query : queries) EXPECT_GT(gap_at(query, 0), 0);
  });
}

TEST(sets, sets_that_move_hold_hits_and_misses) {
  for_each_set([](const Set& set, const std::vector<Query>& queries) {
    if (!set.moves) return;
    uint32_t hits = 0;
    for (const Query& query : queries) hits += closest_approach(query).gap < 0 ? 1u : 0u;
    EXPECT_GT(hits, k_count / 6);
    EXPECT_LT(hits, k_count - k_count / 10);
  });
}

TEST(sets, every_other_query_turns_but_in_2_3_9_and_at_rest) {
  for_each_set([](const Set& set, const std::vector<Query>& queries) {
    const std::string name = set.name;
    for (uint32_t i = 0; i < k_count; ++i) {
      const bool never = !set.moves || name == "2", always = name == "3" || name == "3c" || name == "9";
      EXPECT_EQ(turns(queries[i]), always || (!never && i % 2 == 0)) << i;
    }
  });
}

TEST(sets, rods_turn_as_far_as_stated_and_start_within_each_others_bounds) {
  for (const auto& [name, low, high] : {std::tuple{"3", 0.5, 3.0}, {"3c", 0.5, 3.0}, {"9", 3.2, 12.0}}) {
    for (const Query& query : queries_of(name)) {
      for (const Path* path : {&query.path_a, &query.path_b}) {
        EXPECT_GE(length(path->turn), low - 1e-6);
        EXPECT_LE(length(path->turn), high + 1e-6);
      }
      EXPECT_LT(length(query.path_b.position - query.path_a.position), bound_of(query.a) + bound_of(query.b));
    }
  }
}

TEST(sets, grazing_queries_come_as_near_as_stated_from_both_sides) {
  uint32_t meet = 0;
  for (const Query& query : queries_of("4")) {
    const double approach = approach_of(query);
    EXPECT_GT(fabs(approach), 0.8e-6);
    EXPECT_LT(fabs(approach), 1.2e-3);
    meet += approach < 0 ? 1u : 0u;
  }
  EXPECT_GT(meet, k_count / 4);
  EXPECT_LT(meet, k_count - k_count / 4);
}

TEST(sets, near_queries_start_as_near_as_stated) {
  for (const Query& query : queries_of("7")) {
    EXPECT_GT(gap_at(query, 0), 0.9e-6);
    EXPECT_LT(gap_at(query, 0), 1.1e-4);
  }
}

TEST(sets, far_queries_are_far) {
  for (const Query& query : queries_of("5far")) {
    for (const double coordinate : query.path_a.position) EXPECT_NEAR(fabs(coordinate), 1e7, 4);
  }
}

}  // namespace detent_queries
