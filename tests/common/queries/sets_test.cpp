#include "tests/common/queries/sets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/common/oracle/convex_solid.h"
#include "tests/common/queries/aim.h"
#include "tests/common/queries/gap.h"
#include "tests/common/queries/solids.h"

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
  expect_floats(path.rotation_vector);
}

bool same(const Solid& a, const Solid& b) {
  return a.kind == b.kind && a.radius == b.radius && a.half_length == b.half_length &&
         a.half_extents == b.half_extents && a.rounding == b.rounding && a.points == b.points;
}
bool same(const Path& a, const Path& b) {
  return a.position == b.position && a.rotation == b.rotation && a.displacement == b.displacement &&
         a.rotation_vector == b.rotation_vector;
}
bool same(const Query& a, const Query& b) {
  return same(a.a, b.a) && same(a.b, b.b) && same(a.path_a, b.path_a) && same(a.path_b, b.path_b);
}

bool is_at_bounds(const Solid& box, const Triple& point, size_t axis) {
  return fabs(fabs(point[axis]) - box.half_extents[axis]) < 1e-12;
}

/// Of how many corners the feature of a box is on which the point lies: 1 a vertex, 2 an edge, 3 a face, 4 none.
uint32_t corners_at(const Solid& box, const Triple& point) {
  uint32_t corners = 4;
  for (size_t axis = 0; axis < 3; ++axis) corners -= is_at_bounds(box, point, axis) ? 1u : 0u;
  return corners;
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
        EXPECT_GE(length(path->rotation_vector), low - 1e-6);
        EXPECT_LE(length(path->rotation_vector), high + 1e-6);
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

TEST(sets, triangles_meet_triangles_boxes_and_hulls_and_half_are_slivers) {
  uint32_t partners[3] = {}, slivers = 0, rest = 0;
  double thinnest = 1;
  const std::vector<Query> queries = make_queries(*find_set("11"), k_seed, 8 * k_count, {});
  for (const Query& query : queries) {
    ASSERT_EQ(query.a.kind, Kind::triangle);
    EXPECT_TRUE(is_polytope(query.b));
    ++partners[query.b.kind == Kind::triangle ? 0 : query.b.kind == Kind::box ? 1 : 2];
    const std::vector<Triple>& corner = query.a.points;
    double side = 0;
    for (size_t i = 0; i < 3; ++i) side = std::max(side, length(corner[i] - corner[(i + 1) % 3]));
    EXPECT_GE(side, 0.1 - 1e-6);
    EXPECT_LE(side, 1.2 + 1e-6);
    const double aspect = length(cross(corner[1] - corner[0], corner[2] - corner[0])) / (side * side);
    thinnest = std::min(thinnest, aspect);
    slivers += aspect < 0.1 ? 1u : 0u;
    rest += length(query.path_a.displacement) + length(query.path_a.rotation_vector) == 0 ? 1u : 0u;
  }
  for (const uint32_t count : partners) EXPECT_EQ(count, 8 * k_count / 3);
  EXPECT_GT(thinnest, 0.0099);
  EXPECT_LT(thinnest, 0.02);
  for (const uint32_t count : {slivers, rest}) {
    EXPECT_GT(count, 3 * k_count);
    EXPECT_LT(count, 5 * k_count);
  }
}

TEST(sets, a_point_that_faces_a_direction_lies_on_a_vertex_an_edge_or_a_face) {
  Random random(k_seed);
  const Solid solid = box({0.5, 1, 2});
  for (uint32_t i = 0; i < 300; ++i) {
    const Triple direction = random.direction();
    const uint32_t corners = 1 + i % 3;
    const Triple point = point_facing(random, solid, direction, corners);
    EXPECT_EQ(corners_at(solid, point), corners);
    double facing = -INFINITY;
    for (size_t axis = 0; axis < 3; ++axis) {
      if (is_at_bounds(solid, point, axis)) facing = std::max(facing, point[axis] * direction[axis]);
    }
    EXPECT_GT(facing, 0);
  }
}

TEST(sets, features_that_are_aimed_at_each_other_meet_or_pass_as_stated) {
  Random random(k_seed);
  uint32_t meet = 0;
  for (uint32_t i = 0; i < 200; ++i) {
    const Solid a = box({0.5, 1, 2}), b = box({1, 0.25, 0.75});
    Query query = at_one_place(random, a, b, 1);
    angular_velocity(random, query, 0.05, 1);
    const bool edges = i % 2 == 0;
    const Meeting meeting = aim_at_feature(random, query, edges, {});
    EXPECT_GT(gap_at(query, 0), 0);
    const uint32_t corners_a = corners_at(query.a, meeting.point_a), corners_b = corners_at(query.b, meeting.point_b);
    EXPECT_EQ(corners_a == 2, edges);
    EXPECT_EQ(corners_a + corners_b, 4u);

    query.path_b.displacement = meeting.displacement;
    const detent_oracle::Placement placement = placement_at(detent_oracle::encounter_of(query), meeting.time);
    const auto arrow = [](const Triple& v) { return detent_oracle::Arrow{v[0], v[1], v[2]}; };
    const detent_oracle::Arrow at_a = to_world(placement.a, arrow(meeting.point_a));
    const detent_oracle::Arrow at_b = placement.offset + to_world(placement.b, arrow(meeting.point_b));
    EXPECT_NEAR(static_cast<double>(detent_oracle::length(at_b - at_a)), meeting.beside, 1e-12);
    meet += meeting.beside == 0 ? 1u : 0u;
  }
  EXPECT_GT(meet, 60u);
  EXPECT_LT(meet, 140u);
}

TEST(sets, far_queries_are_far) {
  for (const Query& query : queries_of("5far")) {
    for (const double coordinate : query.path_a.position) EXPECT_NEAR(fabs(coordinate), 1e7, 4);
  }
}

}  // namespace detent_queries
