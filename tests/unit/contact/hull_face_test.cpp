#include <detent/contact.h>
#include <math.h>

#include <vector>

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
    EXPECT_GT(area_of(manifold), 0.35) << round;  // that of both is 0.68
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

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
