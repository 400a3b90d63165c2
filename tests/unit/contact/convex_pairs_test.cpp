#include <detent/contact.h>
#include <math.h>
#include <string.h>

#include "contact/body_convex.h"
#include "contact/compound_ops.h"
#include "ports/host/cook/cook.h"
#include "tests/unit/contact/pairs.h"
#include "tests/unit/shape/compounds.h"
#include "tests/unit/shape/hull_bytes.h"

/// Bodies of every shape as convex sets, and their pairs that go through contact_points().
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

const Asset k_assets[] = {{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                          {detent_hulls::k_prism, sizeof detent_hulls::k_prism}};
const AssetTable k_table = {k_assets, 2};
constexpr double k_step = DETENT_FIXED || sizeof(Unit) == 8 ? 1.0 : 64.0;  ///< of a size, in 2^-30
// lib/distance and lib/toi use 30 bits in every configuration.
constexpr double k_length_error = sizeof(Unit) == 4 && !DETENT_FIXED ? 0x1p-21 : 0x1p-27;

/// A shape of about `size`, m, whose rounding is up to `rounding` times that.
Shape random_shape(Samples& samples, uint32_t kind, double size, double rounding) {
  const auto some = [&] { return real_near(size * uniform(samples, 1, 3)); };
  const Real ball = real_near(rounding == 0 ? 0 : size * rounding * uniform(samples, 0.1, 1));
  switch (kind % 7) {
    case 0:
      return sphere(some());
    case 1:
      return capsule(some(), samples.below(4) == 0 ? Real(0.0) : some());
    case 2:
      return rounded(box({some(), some(), some()}), ball);
    case 3:
      return rounded(cylinder(some(), some()), ball);
    case 4:
      return rounded(cone(some(), some()), ball);
    default:
      return rounded(hull(kind % 7 - 5), ball);
  }
}

Status made(const Shape& shape, Convex& convex) {
  if (shape.type == ShapeType::hull) return make_hull(k_assets[shape.asset], shape.rounding, convex);
  return make_convex(shape, convex);
}

OracleBody body_of(const Shape& shape) {
  OracleBody body;
  EXPECT_OK(set_shape_properties(shape, body.properties, k_table));
  body.properties.type = static_cast<uint32_t>(BodyType::dynamic);
  return body;
}

double metres(int32_t raw, int32_t exponent) { return ldexp(raw, exponent - 30); }

DETENT_TEST(body_convex, is_what_make_convex_makes_of_the_shape_but_for_the_rounding_of_the_bodys_sizes) {
  Samples samples = {31};
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const double size = i % 7 < 5 ? exp2(uniform(samples, -13, 9)) : 1;
    const double rounding = i % 3 == 0 ? 0 : exp2(uniform(samples, -1, i % 7 < 5 ? 5 : 11));
    const Shape shape = random_shape(samples, i, size, fmax(rounding, rounding == 0 ? 0 : 10 * 0x1p-14 / size));
    const OracleBody body = body_of(shape);
    Convex right, given;
    ASSERT_OK(made(shape, right));
    ASSERT_TRUE(body_convex(body.properties, k_table, given));
    const double step = k_step * ldexp(1.0, body.properties.size_exponent - 30);
    EXPECT_EQ(given.type, right.type);
    EXPECT_EQ(given.hull, right.hull);
    EXPECT_EQ(given.vertex_count, right.vertex_count);
    EXPECT_NEAR(metres(given.radius, given.radius_exponent), metres(right.radius, right.radius_exponent), step);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(metres(given.size[k], given.exponent), metres(right.size[k], right.exponent), 2 * step);
    }
    const double core = metres(right.core_radius, right.exponent);
    EXPECT_GE(metres(given.core_radius, given.exponent), core - 3 * ldexp(1.0, right.exponent - 30));
    EXPECT_LE(metres(given.core_radius, given.exponent), core + 16 * step);
    // In the unit that the core asks for, as all of lib/distance and lib/toi relies on.
    EXPECT_LE(given.core_radius, 1 << 30);
    if (given.core_radius != 0 && given.type != ShapeType::hull && given.exponent > -14) {
      EXPECT_GE(given.core_radius, 1 << 29);
    }
  }
}

DETENT_TEST(body_convex, of_a_hull_is_refused_only_if_its_bytes_are_missing) {
  const OracleBody body = body_of(hull(1));
  Convex convex;
  convex.radius = 77;
  const Asset hole[] = {k_assets[0], {}};
  EXPECT_FALSE(body_convex(body.properties, {}, convex));
  EXPECT_FALSE(body_convex(body.properties, {k_assets, 1}, convex));
  EXPECT_FALSE(body_convex(body.properties, {hole, 2}, convex));
  EXPECT_EQ(convex.radius, 77);
  EXPECT_TRUE(body_convex(body.properties, k_table, convex));
}

ContactGeometry collided(const OracleBody& a, const OracleBody& b, double distance_max,
                         const AssetTable& assets = k_table) {
  const Matrix3 rotation_a = matrix_from(a.pose.rotation), rotation_b = matrix_from(b.pose.rotation);
  ContactGeometry contact;
  contact.capped = true;
  collide({a.pose, a.properties, rotation_a}, {b.pose, b.properties, rotation_b}, real_near(distance_max), contact,
          assets);
  return contact;
}

/// The middle of the overlap of a body with one that is up to 1,000 times larger may lie anywhere.
DETENT_TEST(convex_pairs, hold_the_arms_of_a_body_deep_in_another) {
  Samples samples = {37};
  uint32_t points = 0, held = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const double size = exp2(uniform(samples, 0, 10));
    OracleBody a = body_of(random_shape(samples, samples.below(5), size, 0.2));
    OracleBody b = body_of(random_shape(samples, samples.below(7), 1, 0.2));
    a.pose.rotation = rotation_near(any_rotation(samples));
    b.pose.rotation = rotation_near(any_rotation(samples));
    a.pose.position = position_near({{1, 2, 3}});
    const Vector direction = any_direction(samples);  // drawn in one order by every compiler
    b.pose.position = position_near(Vector{{1, 2, 3}} + direction * (size * uniform(samples, 0, 1)));
    const ContactGeometry contact = collided(a, b, 0.01), turned = collided(b, a, 0.01);
    for (uint32_t k = 0; k < turned.count; ++k) expect_arms_held(turned.point[k]);
    for (uint32_t k = 0; k < contact.count; ++k, ++points) {
      expect_arms_held(contact.point[k]);
      held += length(host(contact.point[k].arm_b)) > 1.24 ? 1u : 0u;
    }
  }
  EXPECT_GT(points, held);
  EXPECT_GT(held, detent_oracle::rounds(4000) / 4);
}

/// Every pair without a collision function of its own gives the result of contact_points() for the two shapes.
DETENT_TEST(convex_pairs, agree_with_contact_points_of_the_same_shapes) {
  Samples samples = {32};
  uint32_t touching = 0, points = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const uint32_t kind_a = samples.below(7), kind_b = 3 + samples.below(4);
    const double rounding = i % 2 == 0 ? 0 : 0.2;
    const Shape shapes[] = {random_shape(samples, kind_a, 0.25, rounding),
                            random_shape(samples, kind_b, 0.25, rounding)};
    OracleBody a = body_of(shapes[0]), b = body_of(shapes[1]);
    const Vector start = any_direction(samples) * uniform(samples, 0, 8000);
    const double apart = (host(a.properties.bounding_radius) * unit_of(a.properties) +
                          host(b.properties.bounding_radius) * unit_of(b.properties)) *
                         uniform(samples, 0.3, 1.0);
    a.pose.position = position_near(start);
    b.pose.position = position_near(start + any_direction(samples) * apart);
    a.pose.rotation = rotation_near(any_rotation(samples));
    b.pose.rotation = rotation_near(any_rotation(samples));
    const double distance_max = 0.01;
    Convex convex_a, convex_b;
    ASSERT_OK(made(shapes[0], convex_a));
    ASSERT_OK(made(shapes[1], convex_b));
    ContactManifold right;
    ASSERT_OK(contact_points(convex_a, {a.pose.position, a.pose.rotation}, convex_b, {b.pose.position, b.pose.rotation},
                             real_near(distance_max), right));
    const ContactGeometry given = collided(a, b, distance_max);
    EXPECT_EQ(given.capped, right.capped);
    EXPECT_EQ(given.count != 0, right.count != 0);
    if (given.count == 0 || given.count != right.count) continue;
    ++touching;
    const double error = 0.01 * (DETENT_FIXED || sizeof(Unit) == 8 ? 1e-4 : 1);
    double deepest_given = 1, deepest_right = 1;
    for (uint32_t k = 0; k < given.count; ++k) {
      ++points;
      deepest_given = fmin(deepest_given, real_to_host(given.point[k].separation));
      deepest_right = fmin(deepest_right, real_to_host(right.point[k].separation));
      EXPECT_NE(given.point[k].feature, 0u);
      for (uint32_t other = 0; other < k; ++other) EXPECT_NE(given.point[k].feature, given.point[other].feature);
      // Both arms lead to the same point.
      const Vector from_a = host(given.point[k].arm_a) * unit_of(a.properties);
      const Vector from_b = host(given.point[k].arm_b) * unit_of(b.properties);
      const Vector between = difference(b.pose.position, a.pose.position);
      EXPECT_LE(length(from_a - (from_b + between)), k_length_error * (unit_of(a.properties) + unit_of(b.properties)));
    }
    EXPECT_NEAR(deepest_given, deepest_right, error);
    EXPECT_NEAR(length(host(given.normal)), 1, k_length_error);
  }
  EXPECT_GT(touching, detent_oracle::rounds(4000) / 4);
  EXPECT_GT(points, touching);
}

/// A body of shape `shape`, turned at random, whose lowest point lies `sunk` under a tilted plane that passes through
/// `origin`; the plane's own position is `away` m from there.
struct OnPlane {
  OracleBody plane, body;
  OnPlane(Samples& samples, const Shape& shape, const Vector& origin, double away, double sunk) {
    plane.properties = properties_of(half_space());
    plane.properties.type = static_cast<uint32_t>(BodyType::fixed);
    plane.pose.rotation = rotation_near({0, 0, 0, 1});
    body = body_of(shape);
    body.pose.rotation = rotation_near(any_rotation(samples));
    plane.pose.position = position_near(origin + Vector{{away, 0, away / 3}});
    double low = 0;  // of the centre over the lowest point: by bisection on the answer's own sign
    double high = 2 * unit_of(body.properties);
    for (int i = 0; i < 40; ++i) {
      const double middle = (low + high) / 2;
      body.pose.position = position_near(origin + Vector{{0, middle, 0}});
      const ContactGeometry contact = collided(plane, body, 4 * unit_of(body.properties));
      double least = 8 * unit_of(body.properties);
      for (uint32_t k = 0; k < contact.count; ++k) least = fmin(least, real_to_host(contact.point[k].separation));
      (least > -sunk ? high : low) = middle;
    }
    body.pose.position = position_near(origin + Vector{{0, high, 0}});
  }
};

DETENT_TEST(convex_pairs, a_plane_gives_the_same_contact_however_far_its_origin) {
  Samples samples = {33};
  for (uint32_t i = 0; i < detent_oracle::rounds(300); ++i) {
    const Shape shape = random_shape(samples, 3 + i % 4, 0.25, i % 2 == 0 ? 0 : 0.2);
    const uint64_t seed = samples.bits();
    Samples one = {seed}, two = {seed};
    const double far = sizeof(Coord) == 4 ? 16384 : 1e7;
    const OnPlane near(one, shape, {{1, 2, 3}}, 0, 0.002), away(two, shape, {{1, 2, 3}}, far, 0.002);
    const ContactGeometry a = collided(near.plane, near.body, 0.01), b = collided(away.plane, away.body, 0.01);
    ASSERT_GT(a.count, 0u);
    EXPECT_FALSE(a.capped);
    ASSERT_EQ(a.count, b.count);
    for (uint32_t k = 0; k < a.count; ++k) {
      EXPECT_EQ(a.point[k].separation, b.point[k].separation);
      EXPECT_EQ(a.point[k].arm_b, b.point[k].arm_b);
      EXPECT_EQ(a.point[k].feature, b.point[k].feature);
      EXPECT_EQ(a.point[k].arm_a, (Vec3<Unit>{0.0, 0.0, 0.0}));
    }
    // With the bodies exchanged, the contact is the same except for the sign, the feature names and the order of
    // roundings.
    const ContactGeometry c = collided(near.body, near.plane, 0.01);
    ASSERT_EQ(c.count, a.count);
    EXPECT_EQ(c.normal, -a.normal);
    for (uint32_t k = 0; k < a.count; ++k) {
      EXPECT_NEAR(real_to_host(c.point[k].separation), real_to_host(a.point[k].separation), 0x1p-26);
    }
  }
}

DETENT_TEST(convex_pairs, a_body_far_below_a_plane_is_still_in_contact_within_its_own_bounds) {
  Samples samples = {34};
  for (uint32_t i = 0; i < 28; ++i) {
    const Shape shape = random_shape(samples, 3 + i % 4, 0.25, 0);
    OracleBody plane, body = body_of(shape);
    plane.properties = properties_of(half_space());
    plane.pose.rotation = rotation_near({0, 0, 0, 1});
    body.pose.rotation = rotation_near(any_rotation(samples));
    for (const double depth : {1.0, 100.0, sizeof(Coord) == 4 ? 10000.0 : 100000.0}) {
      body.pose.position = position_near({{0, -depth, 0}});
      const ContactGeometry contact = collided(plane, body, 0.01);
      ASSERT_GT(contact.count, 0u);
      double least = 0;
      for (uint32_t k = 0; k < contact.count; ++k) {
        least = fmin(least, real_to_host(contact.point[k].separation));
        for (int axis = 0; axis < 3; ++axis) EXPECT_LE(fabs(host(contact.point[k].arm_b)[axis]), 1.5);
      }
      EXPECT_LE(least, -depth);
      EXPECT_GE(least, -depth - unit_of(body.properties));
    }
  }
}

DETENT_TEST(convex_pairs, a_hull_without_its_bytes_is_reported_and_touches_nothing) {
  OracleBody a = body_of(hull(1)), b = body_of(sphere(real_near(0.5)));
  a.pose.rotation = b.pose.rotation = rotation_near({0, 0, 0, 1});
  EXPECT_GT(collided(a, b, 0.01).count, 0u);
  const ContactGeometry contact = collided(a, b, 0.01, {});
  EXPECT_EQ(contact.count, 0u);
  EXPECT_TRUE(contact.capped);
}

/// A prism of 96 sides: of each end face, the 32 vertices that are extreme along 32 directions represent the face.
DETENT_TEST(body_convex, a_small_box_stands_on_all_corners_near_the_rim_of_a_face_of_many_vertices) {
  constexpr double k_pi = 3.14159265358979323846;
  std::vector<detent_cook::Point> points;
  for (int i = 0; i < 96; ++i) {
    const double angle = 2 * k_pi * i / 96;
    for (const double y : {-0.25, 0.25}) points.push_back({cos(angle), y, sin(angle)});
  }
  detent_cook::CookOptions options;
  options.frame = detent_cook::Frame::source;
  const std::vector<uint8_t> cooked = detent_cook::cook_hull(points, options).bytes;
  std::vector<uint64_t> words(cooked.size() / 8);
  memcpy(words.data(), cooked.data(), cooked.size());
  Convex prism, small;
  ASSERT_OK(make_hull({reinterpret_cast<const uint8_t*>(words.data()), static_cast<uint32_t>(cooked.size())}, Real(0.0),
                      prism));
  ASSERT_OK(make_convex(box(reals_near({{0.0625, 0.0625, 0.0078125}})), small));
  const Pose still = {position_near({{0, 0, 0}}), rotation_near({0, 0, 0, 1})};
  for (int i = 0; i < 128; ++i) {
    // The 32 vertices contain a disc of radius 0.995; without one of them, a disc of 0.981.
    const double angle = 2 * k_pi * i / 128, radius = 0.9225, x = radius * cos(angle), z = radius * sin(angle);
    const double half = -angle / 2;
    const Pose pose = {position_near({{x, 0.3125, z}}), rotation_near({0, sin(half), 0, cos(half)})};
    ContactManifold manifold;
    ASSERT_OK(contact_points(prism, still, small, pose, real_near(0.01), manifold));
    ASSERT_EQ(manifold.count, 4u) << i;
    for (int corner = 0; corner < 4; ++corner) {
      const double along = corner % 2 == 0 ? -0.0625 : 0.0625, aside = corner < 2 ? -0.0078125 : 0.0078125;
      const double at_x = x + along * cos(angle) - aside * sin(angle),
                   at_z = z + along * sin(angle) + aside * cos(angle);
      double nearest = 1;
      for (uint32_t k = 0; k < 4; ++k) {
        const Vector at = host(manifold.point[k].from_a);
        nearest = fmin(nearest, hypot(at[0] - at_x, at[2] - at_z));
      }
      EXPECT_LT(nearest, 2e-3) << i << " " << corner;
    }
  }
}

DETENT_TEST(body_convex, of_a_part_of_a_compound_has_the_half_thickness_of_its_core) {
  for (const double rounding : {0.0, 0.0625}) {
    const detent_terrains::Bytes bytes =
        detent_compounds::cooked({detent_compounds::box({0, 0, 0}, {0.5, 0.25, 0.5}, rounding),
                                  detent_compounds::box({1, 0, 0}, {0.5, 0.25, 0.125}, rounding)});
    const Asset asset = {bytes.data(), bytes.count()};
    const AssetTable table = {&asset, 1};
    BodyProperties properties{};
    ASSERT_OK(set_shape_properties(compound(0), properties, table));
    const ConvexParts parts(properties, table);
    ASSERT_EQ(parts.count(), 2u);
    for (uint32_t i = 0; i < 2; ++i) {
      Convex convex;
      ASSERT_TRUE(parts.convex(i, false, convex));
      EXPECT_NEAR(metres(convex.radius, convex.radius_exponent), rounding, 1e-6);
      EXPECT_NEAR(metres(convex.size[0], convex.exponent), i == 0 ? 0.25 : 0.125, 1e-6);
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
