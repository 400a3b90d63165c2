#include <detent/contact.h>
#include <math.h>

#include <vector>

#include "contact/contact_points.h"
#include "ports/host/cook/cook.h"
#include "tests/unit/contact/pairs.h"

/// Which face of a hull a contact belongs to, if several faces are equally good or none is flat.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using Points = std::vector<detent_cook::Point>;

/// A cooked hull and its shape.
struct HullShape {
  std::vector<uint8_t> bytes;
  Convex convex;

  explicit HullShape(const Points& points) {
    detent_cook::CookOptions options;
    options.frame = detent_cook::Frame::source;
    bytes = detent_cook::cook_hull(points, options).bytes;
    EXPECT_OK(make_hull({bytes.data(), static_cast<uint32_t>(bytes.size())}, 0.0, convex));
  }
};

Points box_points(const Vector& low, const Vector& high) {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.push_back({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  return points;
}

/// A prism of 16 sides, 1 m across and 0.5 m high, whose corners are up to `off` away from the plane of their face.
Points uneven_prism(Samples& samples, double off) {
  Points points;
  for (int i = 0; i < 32; ++i) {
    const double angle = 2 * M_PI * (i / 2) / 16;
    points.push_back({0.5 * cos(angle), (i % 2 == 0 ? -0.25 : 0.25) + uniform(samples, -off, off), 0.5 * sin(angle)});
  }
  return points;
}

Pose pose_of(const Vector& position, const Quaternion& rotation) {
  return {position_near(position), rotation_near(rotation)};
}

ContactManifold contact_between(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  ContactManifold manifold;
  EXPECT_OK(contact_points(a, pose_a, b, pose_b, real_near(0.01), manifold));
  return manifold;
}

/// The area, m^2, of the outline of the points, projected along y.
double area_of(const ContactManifold& manifold) {
  double most = 0;
  for (uint32_t i = 0; i < manifold.count; ++i) {
    for (uint32_t j = 0; j < manifold.count; ++j) {
      for (uint32_t k = 0; k < manifold.count; ++k) {
        for (uint32_t l = 0; l < manifold.count; ++l) {
          const Vector p = host(manifold.point[k].from_a) - host(manifold.point[i].from_a);
          const Vector q = host(manifold.point[l].from_a) - host(manifold.point[j].from_a);
          most = std::max(most, fabs(p[0] * q[2] - p[2] * q[0]) / 2);
        }
      }
    }
  }
  return most;
}

constexpr Quaternion k_upright = {0, 0, 0, 1};

/// Unit cubes 100 m from the origins of their frames: a hull's thickness must not depend on that.
DETENT_TEST(hull_face, does_not_depend_on_where_the_frame_is) {
  const HullShape cube(box_points({{99.5, 99.5, 99.5}}, {{100.5, 100.5, 100.5}}));
  const Quaternion rotation_vector = {-0.067375552151483983, 0.80460079670757689, -0.45307617678679085,
                                      0.37788896641484493};
  const Vector centre = {{100, 100, 100}}, displacement = {{-1.3, 0.19, 0.71}};
  const Vector turned = (axis_of(rotation_vector, 0) + axis_of(rotation_vector, 1) + axis_of(rotation_vector, 2)) * 100;
  const ContactManifold manifold = contact_between(cube.convex, pose_of(centre * -1, k_upright), cube.convex,
                                                   pose_of(displacement - turned, rotation_vector));
  ASSERT_GT(manifold.count, 0u);
  EXPECT_NEAR(unit_to_host(manifold.normal.x), -1, 1e-3);
  EXPECT_NEAR(unit_to_host(manifold.normal.y), 0, 1e-3);
  EXPECT_NEAR(unit_to_host(manifold.normal.z), 0, 1e-3);
  double deepest = 1;
  for (uint32_t i = 0; i < manifold.count; ++i) deepest = std::min(deepest, real_to_host(manifold.point[i].separation));
  EXPECT_NEAR(deepest, -0.0042, 1e-3);
}

/// The two sides of an edge meet at it, and the triangle at its end is steeper than they are.
DETENT_TEST(hull_face, on_whose_edge_a_hull_stands_touches_with_both_ends) {
  const HullShape wedge({{-1, 1, -0.1}, {1, 1, -0.1}, {-1, 1, 0.1}, {1, 1, 0.1}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}});
  const HullShape block(box_points({{-3, -0.5, -3}}, {{3, 0.5, 3}}));
  Convex ground;
  EXPECT_OK(make_convex(half_space(), ground));
  for (const double lean : {0.0, 5e-4, -9e-4}) {
    const Quaternion rotation_vector = detent_oracle::rotation_by({{0, 0, lean}});
    const double depth = 0.001 + 0.5 * fabs(lean);
    const Pose pose = pose_of({{0, -0.5 - depth + 0.5 * fabs(lean), 0}}, rotation_vector);
    for (const ContactManifold& manifold :
         {contact_between(ground, pose_of({{0, 0, 0}}, k_upright), wedge.convex, pose),
          contact_between(block.convex, pose_of({{0, -0.5, 0}}, k_upright), wedge.convex, pose)}) {
      ASSERT_EQ(manifold.count, 2u) << lean;
      const Vector ends = host(manifold.point[0].from_b) - host(manifold.point[1].from_b);
      EXPECT_NEAR(fabs(ends[0]), 1, 1e-2) << lean;
    }
  }
}

/// Faces within a tolerance of each other count as one face, at every tilt of the body.
DETENT_TEST(hull_face, that_is_not_quite_flat_carries_as_a_whole) {
  Samples samples = {5};
  for (int round = 0; round < 200; ++round) {
    const HullShape lower(uneven_prism(samples, 0.0005)), upper(uneven_prism(samples, 0.0005));
    const double lean = uniform(samples, 0, 5e-3), rotation_vector = uniform(samples, 0, 6),
                 about = uniform(samples, 0, 6);
    const Quaternion rotation = detent_oracle::rotation_by({{lean * cos(about), 0, lean * sin(about)}}) *
                                detent_oracle::rotation_by({{0, rotation_vector, 0}});
    const ContactManifold manifold = contact_between(lower.convex, pose_of({{0, -0.25, 0}}, k_upright), upper.convex,
                                                     pose_of({{0.1, 0.249, 0.05}}, rotation));
    ASSERT_EQ(manifold.count, 4u) << round;
    EXPECT_GT(area_of(manifold), 0.345) << round;  // that of both is 0.68
    EXPECT_GT(unit_to_host(manifold.normal.y), 0.9999) << round;
  }
}

/// Edges cross at the least depth, on either side of the face; the face separates as well.
DETENT_TEST(hull_face, that_leans_against_edges_that_cross_touches_in_several_points) {
  Convex bar;
  EXPECT_OK(make_convex(box(reals_near({{0.2, 0.02, 0.04}})), bar));
  const double leans[][2] = {{0.02, 0.004}, {-0.02, 0.005}, {0.01, -0.004}, {0.02, 0}};
  for (const double(&lean)[2] : leans) {
    const Quaternion rotation_vector =
        detent_oracle::rotation_by({{lean[0], 0, lean[1]}}) * detent_oracle::rotation_by({{0, 1.5, 0}});
    const double distance_max = 0.04 + 0.04 * (fabs(lean[0]) + fabs(lean[1]));
    const ContactManifold manifold = contact_between(bar, pose_of({{0, 0, 0}}, k_upright), bar,
                                                     pose_of({{0, distance_max - 0.001, 0}}, rotation_vector));
    EXPECT_GE(manifold.count, 2u) << lean[0] << " " << lean[1];
    EXPECT_GT(unit_to_host(manifold.normal.y), 0.99) << lean[0] << " " << lean[1];
  }
}

/// The edge is long, so far away from the bar it is much deeper below the face than at the bar.
DETENT_TEST(hull_face, that_leans_against_a_long_edge_touches_it_on_both_sides) {
  const double half = 0.7071067811865476;
  const HullShape bar_points(box_points({{-0.03, -0.6, -0.04}}, {{0.03, 0.6, 0.04}}));
  Convex bar, long_box;
  EXPECT_OK(make_convex(box(reals_near({{0.03, 0.6, 0.04}})), bar));
  EXPECT_OK(make_convex(box(reals_near({{0.5, 0.5, 5}})), long_box));
  const Pose below = pose_of({{0, -half, 0}}, detent_oracle::rotation_by({{0, 0, M_PI / 4}}));
  for (const double lean : {0.0, 3e-4, 1e-3, -1e-3, 3e-3}) {
    // The bar lies across the edge, rotated about its own long axis by `lean`.
    const Quaternion rotation =
        detent_oracle::rotation_by({{lean, 0, 0}}) * detent_oracle::rotation_by({{0, 0, M_PI / 2}});
    const Pose above = pose_of({{0.1, 0.03 - 0.0001, 0.2}}, rotation);
    for (const Convex& upper : {bar, bar_points.convex}) {
      const ContactManifold manifold = contact_between(long_box, below, upper, above);
      ASSERT_EQ(manifold.count, 2u) << lean;
      EXPECT_NEAR(fabs(host(manifold.point[0].from_b)[2] - host(manifold.point[1].from_b)[2]), 0.08, 1e-3) << lean;
    }
  }
}

/// The lower edge of a chamfer is nearly parallel to the face, but is not part of it.
DETENT_TEST(hull_face, between_chamfers_is_the_face_alone) {
  Points points;
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? 0.5 : -0.5, y = i & 2 ? 0.5 : -0.5, z = i & 4 ? 0.5 : -0.5, in = 0.99;
    points.push_back({in * x, y, in * z});
    points.push_back({x, in * y, in * z});
    points.push_back({in * x, in * y, z});
  }
  const HullShape cube(points);
  Convex ground;
  EXPECT_OK(make_convex(half_space(), ground));
  const ContactManifold manifold =
      contact_between(ground, pose_of({{0, 0, 0}}, k_upright), cube.convex, pose_of({{0, 0.499, 0}}, k_upright));
  ASSERT_EQ(manifold.count, 4u);
  for (uint32_t i = 0; i < 4; ++i) {
    const Vector at = host(manifold.point[i].from_b);
    EXPECT_NEAR(fabs(at[0]), 0.495, 1e-3);
    EXPECT_NEAR(fabs(at[2]), 0.495, 1e-3);
    EXPECT_NEAR(real_to_host(manifold.point[i].separation), -0.001, 1e-5);
  }
}

/// 4 to 40 points about a centre, unevenly spread. In half of the cases the centre is the frame's origin.
Points random_points(Samples& samples) {
  const int count = 4 + static_cast<int>(uniform(samples, 0, 36));
  const double aside = uniform(samples, -1, 1) < 0 ? 0 : 0.3;
  const Vector centre = {
      {uniform(samples, -aside, aside), uniform(samples, -aside, aside), uniform(samples, -aside, aside)}};
  Points points;
  for (int i = 0; i < count; ++i) {
    const double z = i < 4 ? 0.5 * i - 0.75 : uniform(samples, -1, 1);
    const double across = sqrt(1 - z * z), angle = i < 4 ? 2.4 * i : uniform(samples, 0, 5),
                 out = uniform(samples, 0.9, 1);
    points.push_back(
        {centre[0] + out * across * cos(angle), centre[1] + out * across * sin(angle), centre[2] + out * z});
  }
  return points;
}

Placed placed_alone(const Convex& convex) {
  return place(convex, matrix_from(Quat32{0, 0, 0, k_one}), convex.exponent);
}

Vec32 normal_of(const HullView& hull, uint32_t face) {
  const HullPlane plane = hull.plane(face);
  return {plane.normal[0], plane.normal[1], plane.normal[2]};
}

DETENT_TEST(hull_face, that_is_nearest_to_the_middle_gives_the_half_thickness) {
  Samples samples = {6};
  int from_origin_count = 0;
  for (int round = 0; round < 200; ++round) {
    const HullShape shape(random_points(samples));
    const HullView hull = hull_view(shape.convex.hull);
    int64_t sum[3] = {};
    for (uint32_t v = 0; v < hull.vertex_count; ++v) {
      sum[0] += hull.x(v);
      sum[1] += hull.y(v);
      sum[2] += hull.z(v);
    }
    const auto mean = [&](int axis) { return static_cast<int32_t>(sum[axis] / static_cast<int>(hull.vertex_count)); };
    int64_t from_origin = INT32_MAX, from_mean = INT32_MAX;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
      const int64_t offset = hull.plane(f).offset;
      from_origin = std::min(from_origin, offset);
      from_mean = std::min(from_mean, offset - (dot(normal_of(hull, f), Vec32{mean(0), mean(1), mean(2)}) >> 30));
    }
    EXPECT_EQ(core_half_thickness(placed_alone(shape.convex)), std::max(from_origin, from_mean)) << round;
    from_origin_count += from_origin > from_mean;
  }
  EXPECT_GT(from_origin_count, 20);
  EXPECT_LT(from_origin_count, 180);
}

DETENT_TEST(hull_face, has_the_index_of_each_of_its_edges) {
  Samples samples = {7};
  for (int round = 0; round < 50; ++round) {
    const HullShape shape(random_points(samples));
    const Placed placed = placed_alone(shape.convex);
    uint32_t found = 0;
    for (uint32_t a = 0; a < placed.hull.vertex_count; ++a) {
      for (uint32_t b = 0; b < placed.hull.vertex_count; ++b) {
        const uint32_t index = edge_index(placed, a, b);
        if (a == b || index >= 768) continue;
        ++found;
        ASSERT_LT(index, placed.hull.edge_count);
        EXPECT_EQ(placed.hull.edge(index).a, std::min(a, b));
        EXPECT_EQ(placed.hull.edge(index).b, std::max(a, b));
      }
    }
    EXPECT_EQ(found, 2 * placed.hull.edge_count) << round;
  }
}

/// Compares with a search through all vertices and all faces.
DETENT_TEST(hull_face, has_the_most_of_the_vertices_that_are_level) {
  Samples samples = {8};
  int several = 0;
  for (int round = 0; round < 2000; ++round) {
    const HullShape shape(random_points(samples));
    const Placed placed = placed_alone(shape.convex);
    const HullView& hull = placed.hull;
    const Vec32 about = normal_of(hull, static_cast<uint32_t>(uniform(samples, 0, hull.face_count)));
    const double off = ldexp(1, static_cast<int>(uniform(samples, 10, 30)));
    const auto near = [&](int32_t component) { return component + static_cast<int64_t>(uniform(samples, -off, off)); };
    const Vec32 d = unit_vector_raw(scaled_to_30_bits(Vec64{near(about.x), near(about.y), near(about.z)}));
    const int32_t thickness = 1 << static_cast<int>(uniform(samples, 24, 31));
    int64_t top = INT64_MIN;
    for (uint32_t v = 0; v < hull.vertex_count; ++v) top = std::max(top, dot(hull.vertex(v), d));
    const auto is_level = [&](uint32_t v) { return dot(hull.vertex(v), d) >= top - (thickness >> 6) * k_one_64; };
    uint32_t best = 0, most = 0;
    for (uint32_t f = 0; f < hull.face_count; ++f) {
      uint32_t level = 0;
      for (uint32_t i = 0; i < hull.face(f).count; ++i) level += is_level(hull.face(f).index[i]) ? 1u : 0u;
      if (level < most || level == 0) continue;
      if (level == most && dot(normal_of(hull, f), d) <= dot(normal_of(hull, best), d)) continue;
      best = f;
      most = level;
    }
    several += most > 1;
    Feature face;
    ASSERT_TRUE(supporting_face(placed, d, thickness, face));
    const bool is_region = face.index == hull.face_count;
    EXPECT_TRUE(is_region || face.index == best) << round;
  }
  EXPECT_GT(several, 200);
}

/// Also where the thickness of one of them is given, as for a part of a compound.
DETENT_TEST(hull_face, of_two_bodies_of_one_hull_is_that_of_two_equal_hulls) {
  Samples samples = {9};
  for (int round = 0; round < 300; ++round) {
    const HullShape shape(random_points(samples)), other(shape);
    Convex thick = shape.convex, copy = shape.convex;
    if (round % 2 == 0) thick.size[0] = 1 << static_cast<int>(uniform(samples, 20, 31));
    copy.hull = other.bytes.data();
    copy.size[0] = thick.size[0];
    const Pose pose_a = pose_of({{0, 0, 0}}, k_upright);
    const Pose pose_b = pose_of(
        {{0, uniform(samples, 1.6, 2), 0}},
        detent_oracle::rotation_by({{uniform(samples, -3, 3), uniform(samples, -3, 3), uniform(samples, -3, 3)}}));
    const ContactManifold found = contact_between(shape.convex, pose_a, thick, pose_b);
    const ContactManifold expected = contact_between(shape.convex, pose_a, copy, pose_b);
    ASSERT_EQ(found.count, expected.count) << round;
    EXPECT_EQ(found.normal, expected.normal) << round;
    for (uint32_t i = 0; i < found.count; ++i) {
      EXPECT_EQ(found.point[i].from_a, expected.point[i].from_a) << round;
      EXPECT_EQ(found.point[i].from_b, expected.point[i].from_b) << round;
      EXPECT_EQ(found.point[i].feature, expected.point[i].feature) << round;
    }
  }
}

DETENT_TEST(hull_face, of_no_contact_of_edges_that_cross_is_named) {
  Samples samples = {10};
  int compared = 0;
  for (int round = 0; round < 1000; ++round) {
    const HullShape a(random_points(samples)), b(random_points(samples));
    const Pose pose_b =
        pose_of({{0, uniform(samples, 1.6, 2), 0}}, detent_oracle::rotation_by({{uniform(samples, -3, 3), 0, 1}}));
    RestingPair pair;
    ASSERT_EQ(rest(a.convex, pose_of({{0, 0, 0}}, k_upright), b.convex, pose_b, pair), Status::ok);
    BlockManifold found;
    find_contact_points(pair, rules_of(int64_t{1} << 39, ManifoldReduction::projected_extremes), nullptr, found);
    if (found.count != 1 || found.turns || found.leans) continue;
    const auto lies_on_face = [](const Placed& placed, const Vec32& outward) {
      Feature face;
      return !supporting_face(placed, outward, core_half_thickness(placed), face) ||
             dot(face.normal, outward) > k_one_64 * k_one_64 - (int64_t{1} << 35);
    };
    const Vec32 back = negate(found.normal);
    Feature edge_a, edge_b;
    supporting_edge(pair.a, found.normal, k_one >> 5, edge_a);
    supporting_edge(pair.b, back, k_one >> 5, edge_b);
    if (lies_on_face(pair.a, found.normal) || lies_on_face(pair.b, back)) continue;
    if (edge_a.count != 2 || edge_b.count != 2) continue;
    EXPECT_EQ(found.point[0].feature, feature_pair(edge_a.name(), edge_b.name())) << round;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

/// The lowest point of the rim lies between the corners that stand for it, and is added.
DETENT_TEST(hull_face, under_a_cylinder_that_leans_is_named_by_all_points) {
  const HullShape cube(box_points({{-1, -1, -1}}, {{1, 1, 1}}));
  Convex cylinder_convex;
  EXPECT_OK(make_convex(cylinder(real_near(0.5), real_near(0.25)), cylinder_convex));
  const double about = M_PI / 8;
  const Quaternion rotation = detent_oracle::rotation_by({{0.03 * sin(about), 0, -0.03 * cos(about)}});
  const ContactManifold manifold = contact_between(cube.convex, pose_of({{0, 0, 0}}, k_upright), cylinder_convex,
                                                   pose_of({{0, 1.264, 0}}, rotation));
  ASSERT_GT(manifold.count, 1u);
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const uint32_t name = manifold.point[i].feature & 0xfff;
    EXPECT_EQ(name, manifold.point[0].feature & 0xfff) << i;
    EXPECT_EQ(name >> 10, static_cast<uint32_t>(FeatureType::face)) << i;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
