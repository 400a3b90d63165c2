#include "contact/collide_mesh.h"

#include <detent/contact.h>

#include <algorithm>

#include "contact/body_convex.h"
#include "tests/unit/contact/ground.h"

/// Bodies against meshes and height fields.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_terrains;

constexpr double k_normal_error = sizeof(Unit) == 4 && !DETENT_FIXED ? 0x1p-22 : 0x1p-26;
constexpr double k_length_error = sizeof(Coord) == 4                   ? 0x1p-16  // a position's step
                                  : sizeof(Unit) == 4 && !DETENT_FIXED ? 0x1p-20
                                                                       : 0x1p-24;

double normal_error(const TerrainContact& contact, const Vector& right) {
  return length(host(contact.geometry.normal) - right);
}

/// Shapes of about a metre; a prism's faces are flat to rounding.
Shape shape_of(uint32_t kind) {
  switch (kind) {
    case 0:
      return sphere(0.5);
    case 1:
      return capsule(0.25, 0.5);
    case 2:
      return box({0.5, 0.25, 0.375});
    case 3:
      return rounded(box({0.5, 0.25, 0.375}), 0.125);
    case 4:
      return cylinder(0.5, 0.25);
    case 5:
      return cone(0.5, 0.25);
    default:
      return hull(0);
  }
}

/// The depth of the lowest point of the body below its centre, from its contact with a half-space.
double depth_below(const OracleBody& body) {
  OracleBody plane;
  plane.properties = properties_of(half_space());
  plane.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  plane.pose.position = position_near({{0, 0, 0}});
  OracleBody low = body;
  low.pose.position = position_near({{0, 0, 0}});
  const Matrix3 a = matrix_from(plane.pose.rotation), b = matrix_from(low.pose.rotation);
  ContactGeometry contact;
  collide({plane.pose, plane.properties, a}, {low.pose, low.properties, b}, real_near(10), contact, k_table);
  double least = 1e9;
  for (uint32_t i = 0; i < contact.count; ++i) least = fmin(least, real_to_host(contact.point[i].separation));
  return -least;
}

Quaternion rotate_about(const Vector& axis, double angle) {
  const Vector n = normalised(axis) * sin(angle / 2);
  return {n[0], n[1], n[2], cos(angle / 2)};
}

/// The rotation that takes the y axis to this direction. Range: not straight down.
Quaternion turn_from_up(const Vector& to) {
  const Vector axis = {{to[2], 0, -to[0]}};
  return rotate_about(axis, acos(to[1]));
}

DETENT_TEST(mesh_contact, anything_slid_over_a_tessellated_plane_sees_its_normal_alone_and_no_jump_of_depth) {
  const Ground ground(plane(16, 0.25));
  Samples samples = {11};
  for (uint32_t kind = 0; kind < 7; ++kind) {
    for (uint32_t pose = 0; pose < 4; ++pose) {
      OracleBody body = body_of(shape_of(kind));
      body.pose.rotation = rotation_near(pose == 0   ? Quaternion{0, 0, 0, 1}
                                         : pose == 1 ? rotate_about({{1, 0, 0}}, 1.5707963267948966)
                                         : pose == 2 ? rotate_about({{0, 1, 0}}, 0.3)
                                                     : any_rotation(samples));
      const double depth = depth_below(body);
      for (const double gap : {0.02, 0.0, -0.005}) {
        for (uint32_t step = 0; step < detent_oracle::rounds(60); ++step) {
          // The body moves past corners, along edges and along diagonals.
          const double x = -1 + step * 0.03125, z = pose % 2 == 0 ? 0.25 : x * 0.7;
          body.pose.position = position_near({{x, depth + gap, z}});
          const TerrainContacts contacts = contacts_of(ground, body);
          ASSERT_EQ(contacts.count, 1u) << kind << " " << pose << " " << gap << " " << x;
          EXPECT_EQ(contacts.dropped, 0u);
          EXPECT_FALSE(contacts.capped);
          EXPECT_LE(normal_error(contacts.contact[0], {{0, 1, 0}}), k_normal_error);
          EXPECT_NEAR(deepest_of(contacts), gap, 8 * k_length_error) << kind << " " << pose << " " << x;
        }
      }
    }
  }
}

DETENT_TEST(mesh_contact, a_box_lying_on_a_tessellated_plane_has_its_four_corners_for_points_wherever_it_lies) {
  const Ground ground(plane(16, 0.25));
  OracleBody body = body_of(box({0.5, 0.25, 0.375}));
  uint32_t key = 0, features[4] = {};
  for (uint32_t step = 0; step < 50; ++step) {
    body.pose.rotation = rotation_near(rotate_about({{0, 1, 0}}, 0.2));
    body.pose.position = position_near({{-0.7 + step * 0.029, 0.249, 0.13}});
    const TerrainContacts contacts = contacts_of(ground, body);
    ASSERT_EQ(contacts.count, 1u);
    const TerrainContact& contact = contacts.contact[0];
    ASSERT_EQ(contact.geometry.count, 4u);
    std::vector<uint32_t> names;
    for (uint32_t k = 0; k < 4; ++k) {
      const Vector arm = host(contact.geometry.point[k].arm_b) * unit_of(body.properties);
      EXPECT_NEAR(length(arm), sqrt(0.25 + 0.140625 + 0.0625), 0.002);
      EXPECT_NEAR(real_to_host(contact.geometry.point[k].separation), -0.001, 8 * k_length_error);
      names.push_back(contact.geometry.point[k].feature);
    }
    std::sort(names.begin(), names.end());
    if (step == 0) {
      key = contact.key;
      for (uint32_t k = 0; k < 4; ++k) features[k] = names[k];
    }
    EXPECT_EQ(contact.key, key);
    for (uint32_t k = 0; k < 4; ++k) EXPECT_EQ(features[k], names[k]);
  }
}

/// All edges of the dome are convex with small angles, or too flat to count as edges. The true contact is on one of
/// them, or at a corner.
DETENT_TEST(mesh_contact, a_ball_on_a_finely_tessellated_dome_does_not_fall_between_the_triangles) {
  const double cases[][2] = {{0.04, 16}, {0.1, 16}, {0.05, 2}, {0.1, 3}};
  for (const double(&pair)[2] : cases) {
    const double size = pair[0], radius = pair[1];
    const Ground dome(
        ground(40, size, [&](double x, double z) { return sqrt(radius * radius - x * x - z * z) - radius; }), true);
    const uint32_t kinds[] = {0, 1, 2, 4};  // those whose lowest point is below the centre
    for (const uint32_t kind : kinds) {
      OracleBody body = body_of(shape_of(kind));
      body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
      const double depth = depth_below(body);
      for (uint32_t step = 0; step < detent_oracle::rounds(12); ++step) {
        body.pose.position = position_near({{0.01 * size * step, depth - 0.001, 0.007 * size * step}});
        const TerrainContacts contacts = contacts_of(dome, body);
        ASSERT_GE(contacts.count, 1u) << size << " " << kind << " " << step;
        EXPECT_NEAR(deepest_of(contacts), -0.001, 1.5e-3) << size << " " << kind << " " << step;
        for (uint32_t i = 0; i < contacts.count; ++i) {
          EXPECT_LE(normal_error(contacts.contact[i], {{0, 1, 0}}),
                    sqrt(4 * k_reach / radius) + 0.01);  // as far as a flat side is in reach
        }
      }
    }
  }
}

DETENT_TEST(mesh_contact, a_real_edge_gives_what_the_box_itself_gives) {
  const Ground ground(box_terrain(1, 1, 1, 4), true);
  OracleBody block = body_of(box({1.0, 1.0, 1.0}));
  block.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  block.pose.position = position_near({{0, 0, 0}});
  Samples samples = {13};
  uint32_t met = 0;
  for (uint32_t n = 0; n < detent_oracle::rounds(800); ++n) {
    const uint32_t kind = n % 3;
    OraclePair pair = {block, body_of(shape_of(kind == 2 ? 3 : kind))};
    pair.b.pose.rotation = rotation_near(any_rotation(samples));
    // The displacement points to an edge or a corner: two or three components have the same magnitude.
    Vector displacement =
        any_direction(samples) * 0.3 + Vector{{1, samples.below(2) == 0 ? 1.0 : -1.0, samples.below(2) * 1.0}};
    double near = 0, far = 4;
    const double gap = kind == 2 ? 0.01 : -0.01;
    Convex a, b;
    ASSERT_TRUE(body_convex(pair.a.properties, k_table, a));
    ASSERT_TRUE(body_convex(pair.b.properties, k_table, b));
    ContactManifold right;
    for (int i = 0; i < 24; ++i) {
      const double middle = (near + far) / 2;
      pair.b.pose.position = position_near(displacement * middle);
      ASSERT_OK(contact_points(a, {pair.a.pose.position, pair.a.pose.rotation}, b,
                               {pair.b.pose.position, pair.b.pose.rotation}, real_near(4), right));
      double least = 1e9;
      for (uint32_t k = 0; k < right.count; ++k) least = fmin(least, real_to_host(right.point[k].separation));
      (least < gap ? near : far) = middle;
    }
    const TerrainContacts contacts = contacts_of(ground, pair.b);
    ASSERT_GE(contacts.count, 1u) << n;
    uint32_t best = 0;
    double least = 1e9;
    for (uint32_t i = 0; i < contacts.count; ++i) {
      const ContactGeometry& geometry = contacts.contact[i].geometry;
      for (uint32_t k = 0; k < geometry.count; ++k) {
        const double separation = real_to_host(geometry.point[k].separation);
        if (separation < least) best = i;
        least = fmin(least, separation);
      }
      // Nothing that the block's own corners would not give.
      EXPECT_GT(dot(host(geometry.normal), displacement), 0) << n;
    }
    EXPECT_NEAR(least, gap, 1e-4) << n;
    EXPECT_LE(length(host(contacts.contact[best].geometry.normal) - host(right.normal)), 0.05) << n;
    ++met;
  }
  EXPECT_GT(met, 100u);
}

DETENT_TEST(mesh_contact, a_box_beside_a_tessellated_wall_and_on_the_ground_is_not_lifted_by_the_walls_top) {
  const Ground wall(box_terrain(1, 0.5, 1, 5), true);
  OracleBody body = body_of(box({0.25, 0.75, 0.25}));
  body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  for (const double gap : {0.01, 0.0, -0.001, -0.004}) {
    for (uint32_t step = 0; step < 20; ++step) {
      body.pose.position = position_near({{1.25 + gap, 0.25, -0.7 + 0.07 * step}});
      const TerrainContacts contacts = contacts_of(wall, body);
      ASSERT_EQ(contacts.count, 1u) << gap << " " << step;
      EXPECT_LE(normal_error(contacts.contact[0], {{1, 0, 0}}), k_normal_error);
      EXPECT_NEAR(deepest_of(contacts), gap, 2e-5);
    }
  }
}

/// The two points on the ridge carry the stick. The four corners of the search are in range, but farther away.
DETENT_TEST(mesh_contact, a_stick_across_a_mild_ridge_lies_on_both_sides_of_its_width) {
  const Ground ridge(ground(4, 1, [&](double x, double) { return -0.01 * fabs(x); }));
  OracleBody body = body_of(box(reals_near({{0.4, 0.03, 0.03}})));
  body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  body.pose.position = position_near({{0, 0.03 - 0.0001, 0.3}});
  const TerrainContacts contacts = contacts_of(ridge, body);
  uint32_t on_ridge = 0;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    for (uint32_t k = 0; k < contacts.contact[i].geometry.count; ++k) {
      const ContactGeometryPoint& point = contacts.contact[i].geometry.point[k];
      const Vector arm = host(point.arm_b) * unit_of(body.properties);
      if (real_to_host(point.separation) > 0) continue;
      EXPECT_LT(fabs(arm[0]), 0.011);
      EXPECT_NEAR(fabs(arm[2]), 0.03, 1e-3);
      on_ridge |= arm[2] < 0 ? 1u : 2u;
    }
  }
  EXPECT_EQ(on_ridge, 3u);
}

/// The two sides of the ridge differ by less than a cube notices, and by more than fits under a long thin rod.
DETENT_TEST(mesh_contact, a_rod_across_a_low_ridge_has_a_manifold_on_each_side_and_a_cube_has_one) {
  const Ground ridge(ground(4, 1, [&](double x, double) { return -0.004 * fabs(x); }));
  for (const bool is_rod : {true, false}) {
    OracleBody body = body_of(box(is_rod ? reals_near({{0.7, 0.02, 0.1}}) : reals_near({{0.3, 0.3, 0.3}})));
    body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
    body.pose.position = position_near({{0, (is_rod ? 0.02 : 0.3) - 0.0001, 0.3}});
    EXPECT_EQ(contacts_of(ridge, body).count, is_rod ? 2u : 1u);
  }
}

/// The centre of the rod lies behind the plane of the triangle below its end.
DETENT_TEST(mesh_contact, a_rod_that_reaches_over_a_ridge_is_not_pulled_through_it) {
  const double slope = 0.5;
  const Ground ridge(ground(4, 1, [&](double x, double) { return -slope * fabs(x); }));
  OracleBody body = body_of(capsule(real_near(0.01), real_near(0.5)));
  const double rotation_vector = -atan(slope);
  body.pose.rotation = rotation_near(rotate_about({{0, 0, 1}}, rotation_vector - M_PI / 2));
  for (const double over : {0.002, 0.01, 0.03}) {
    // Positions along the slope, `over` beyond the ridge, on the surface.
    const double along = 0.5 - over, lift = 0.01;
    body.pose.position = position_near({{along * cos(rotation_vector) - lift * sin(rotation_vector),
                                         along * sin(rotation_vector) + lift * cos(rotation_vector), 0.3}});
    const TerrainContacts contacts = contacts_of(ridge, body);
    ASSERT_GE(contacts.count, 1u) << over;
    for (uint32_t i = 0; i < contacts.count; ++i) EXPECT_GT(host(contacts.contact[i].geometry.normal)[1], 0.8) << over;
    EXPECT_NEAR(deepest_of(contacts), 0, 1e-4) << over;
  }
}

/// The middle of the rod lies behind the planes of triangles that are two or more away, on ground that curves in both
/// directions.
DETENT_TEST(mesh_contact, a_rod_that_lies_over_waves_is_met_from_above_alone) {
  const auto height = [](double x, double z) { return 0.35 * sin(1.1 * x) * cos(0.8 * z); };
  const Ground waves(ground(24, 0.25, height));
  Samples samples = {5};
  uint32_t touching = 0;
  for (uint32_t trial = 0; trial < 400; ++trial) {
    constexpr double k_radius = 0.005, k_half = 0.8;
    OracleBody body = body_of(trial % 2 == 0 ? capsule(real_near(k_radius), real_near(k_half))
                                             : box({real_near(k_radius), real_near(k_half), real_near(k_radius)}));
    const auto within = [&](double limit) { return limit * unit_to_host(samples.uniform()); };
    const double heading = within(3.14), slope = within(0.3);
    const Vector along = detent_oracle::normalised({{cos(heading), slope, sin(heading)}});
    body.pose.rotation = rotation_near(turn_from_up(along));
    const Vector middle = {{within(1.5), 0, within(1.5)}};
    double lift = -1e9;  // so that it touches
    for (int i = -100; i <= 100; ++i) {
      const Vector at = middle + along * (k_half * i / 100);
      lift = fmax(lift, height(at[0], at[2]) - at[1]);
    }
    body.pose.position = position_near({{middle[0], lift + k_radius / 2, middle[2]}});
    const TerrainContacts contacts = contacts_of(waves, body, 0.001);
    for (uint32_t i = 0; i < contacts.count; ++i) {
      ++touching;
      EXPECT_GT(host(contacts.contact[i].geometry.normal)[1], 0.5) << trial;
    }
  }
  EXPECT_GT(touching, 300u);
}

DETENT_TEST(mesh_contact, in_a_concave_corner_each_wall_gives_its_own_normal) {
  const double slope = 0.75;
  const Ground valley(ground(8, 0.5, [&](double x, double) { return slope * fabs(x); }));
  const double scale = 1 / sqrt(1 + slope * slope);
  for (uint32_t kind = 0; kind < 4; ++kind) {
    OracleBody body = body_of(kind == 0 ? sphere(0.5) : kind == 1 ? capsule(0.25, 0.5) : shape_of(kind));
    if (kind == 1)
      body.pose.rotation = rotation_near(rotate_about({{1, 0, 0}}, 1.5707963267948966));
    else
      body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
    const double size = kind == 0 ? 0.5 / scale : kind == 1 ? 0.25 / scale : 0;
    // A box stands on its edges: its lower corners are at +-0.5.
    const double height = kind < 2 ? size : kind == 2 ? 0.25 + 0.5 * slope : 0.25 + 0.5 * slope + 0.125 / scale;
    body.pose.position = position_near({{0, height, 0.1}});
    const TerrainContacts contacts = contacts_of(valley, body);
    ASSERT_EQ(contacts.count, 2u) << kind;
    for (uint32_t i = 0; i < 2; ++i) {
      const double side = host(contacts.contact[i].geometry.normal)[0] > 0 ? 1 : -1;
      EXPECT_LE(normal_error(contacts.contact[i], {{side * slope * scale, scale, 0}}), 4 * k_normal_error) << kind;
    }
    EXPECT_NE(contacts.contact[0].key, contacts.contact[1].key);
    EXPECT_NEAR(deepest_of(contacts), 0, 3e-5) << kind;
  }
}

DETENT_TEST(mesh_contact, a_one_sided_terrain_is_met_from_its_front_alone) {
  const Ground one(plane(4, 0.5), true), both(plane(4, 0.5), false);
  OracleBody body = body_of(sphere(0.5));
  body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  body.pose.position = position_near({{0.1, 0.49, 0.2}});
  EXPECT_EQ(contacts_of(one, body).count, 1u);
  EXPECT_EQ(contacts_of(both, body).count, 1u);
  body.pose.position = position_near({{0.1, -0.49, 0.2}});
  EXPECT_EQ(contacts_of(one, body).count, 0u);
  const TerrainContacts contacts = contacts_of(both, body);
  ASSERT_EQ(contacts.count, 1u);
  EXPECT_LE(normal_error(contacts.contact[0], {{0, -1, 0}}), k_normal_error);
  EXPECT_NEAR(deepest_of(contacts), -0.01, k_length_error);
}

DETENT_TEST(mesh_contact, a_height_field_is_the_mesh_of_its_triangles) {
  Samples samples = {17};
  detent_cook::HeightFieldSource field;
  field.columns = field.rows = 12;
  field.origin = {-3, 0, -3};
  field.spacing_x = field.spacing_z = 0.5;
  for (uint32_t i = 0; i < 13 * 13; ++i) field.heights.push_back(0.3 * uniform(samples, -1, 1));
  for (uint32_t i = 0; i < 12 * 12; ++i) field.cells.push_back(static_cast<uint8_t>(samples.below(2) * 0x40 + i % 5));
  field.cells[40] = 0x80;
  const Ground heights(Bytes(detent_cook::cook_height_field(field).bytes));
  Source source;
  const int exponent = heights.terrain.exponent();
  for (uint32_t i = 0; i < 2 * 144; ++i) {
    if (i / 2 == 40) continue;
    const TerrainTriangle t = heights.terrain.triangle(i);
    uint32_t v[3];
    for (int k = 0; k < 3; ++k) {
      const auto metres = [&](int32_t raw) { return ldexp(raw, exponent - 30); };
      v[k] = add_vertex(source, metres(t.corner[k].x), metres(t.corner[k].y), metres(t.corner[k].z));
    }
    add_triangle(source, v[0], v[1], v[2], t.material);
  }
  const Ground mesh(source, true);
  ASSERT_EQ(mesh.terrain.exponent(), exponent);
  for (uint32_t n = 0; n < detent_oracle::rounds(200); ++n) {
    OracleBody body = body_of(shape_of(n % 7));
    body.pose.rotation = rotation_near(any_rotation(samples));
    body.pose.position =
        position_near({{uniform(samples, -3, 3), uniform(samples, 0.1, 0.6), uniform(samples, -3, 3)}});
    const TerrainContacts a = contacts_of(heights, body), b = contacts_of(mesh, body);
    // The triangles come in another order, which can change how manifolds are merged; the deepest point is the same.
    EXPECT_EQ(a.count == 0, b.count == 0);
    EXPECT_EQ(deepest_of(a), deepest_of(b)) << n;
  }
}

DETENT_TEST(mesh_contact, over_rough_ground_the_deepest_point_is_as_near_as_the_nearest_triangle) {
  Samples samples = {29};
  const Ground ground(detent_terrains::ground(12, 0.4, [&](double, double) { return 0.25 * uniform(samples, -1, 1); }));
  uint32_t met = 0;
  for (uint32_t n = 0; n < detent_oracle::rounds(60); ++n) {
    OracleBody body = body_of(shape_of(n % 7));
    body.pose.rotation = rotation_near(any_rotation(samples));
    const double x = uniform(samples, -1.6, 1.6), z = uniform(samples, -1.6, 1.6), gap = uniform(samples, 0.001, 0.04);
    double low = 0, high = 2;
    Vector normal{};
    for (int i = 0; i < 12; ++i) {
      const double middle = (low + high) / 2;
      body.pose.position = position_near({{x, middle, z}});
      (distance_from(ground, body, normal) < gap ? low : high) = middle;
    }
    body.pose.position = position_near({{x, high, z}});
    const double right = distance_from(ground, body, normal);
    const TerrainContacts contacts = contacts_of(ground, body);
    ASSERT_GE(contacts.count, 1u) << n;
    EXPECT_NEAR(deepest_of(contacts), right, 1e-3) << n;
    bool found = false;
    for (uint32_t i = 0; i < contacts.count; ++i) {
      const ContactGeometry& geometry = contacts.contact[i].geometry;
      EXPECT_GT(host(geometry.normal.y), 0.3) << n;
      found = found || length(host(geometry.normal) - normal) < 0.06;
    }
    EXPECT_TRUE(found) << n;
    ++met;
  }
  EXPECT_GT(met, 10u);
}

DETENT_TEST(mesh_contact, what_finds_no_room_joins_the_nearest_normal_and_the_deepest_stay) {
  // Narrow ridges side by side under one large box.
  const Ground ground(detent_terrains::ground(
      24, 0.1, [](double x, double z) { return 0.03 * sin(37 * x + 11 * z) + 0.02 * sin(29 * z + 3 * x) - 0.01 * x; }));
  OracleBody body = body_of(box({1.0, 0.25, 1.0}));
  body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  body.pose.position = position_near({{0, 0.25 + 0.065, 0}});
  const TerrainContacts contacts = contacts_of(ground, body, 0.2);
  EXPECT_EQ(contacts.count, k_terrain_manifolds_max);
  EXPECT_EQ(contacts.dropped, 0u);
  for (uint32_t i = 1; i < contacts.count; ++i) EXPECT_LT(contacts.contact[i - 1].key, contacts.contact[i].key);
  Vector normal{};
  const double right = distance_from(ground, body, normal);
  EXPECT_GT(right, 0);
  EXPECT_NEAR(deepest_of(contacts), right, 1e-3);
}

DETENT_TEST(mesh_contact, what_finds_no_room_and_no_near_normal_is_counted_and_the_deepest_stay) {
  TerrainManifolds found(int64_t{1} << 40, 5);
  constexpr uint32_t k_touches = k_terrain_manifolds_max + 1;
  for (uint32_t i = 0; i < k_touches; ++i) {
    TerrainTouch touch = {};
    touch.triangle = i;
    touch.deepest = i == 3 ? 0 : -int64_t{1} - i;  // the fourth is the shallowest
    // Directions on a spiral around a ball: all at least 0.6 rad apart.
    const double height = 1 - (2 * i + 1.0) / k_touches, across = sqrt(1 - height * height), angle = 2.4 * i;
    touch.manifold.normal = {static_cast<int32_t>(cos(angle) * across * (1 << 30)),
                             static_cast<int32_t>(sin(angle) * across * (1 << 30)),
                             static_cast<int32_t>(height * (1 << 30))};
    touch.manifold.count = 1;
    touch.manifold.point[0] = {{0, 0, 0}, {0, 0, 0}, touch.deepest, i + 1};
    found.add(touch);
  }
  EXPECT_EQ(found.dropped(), 1u);
  ASSERT_EQ(found.finish(), k_terrain_manifolds_max);
  for (uint32_t i = 0; i < k_terrain_manifolds_max; ++i) EXPECT_NE(found.manifold(i).triangle, 3u);
}

DETENT_TEST(mesh_contact, what_is_certain_finds_room_among_deeper_contacts_that_are_doubtful) {
  TerrainManifolds found(int64_t{1} << 40, 5);
  for (uint32_t i = 0; i <= k_terrain_manifolds_max; ++i) {
    TerrainTouch touch = {};
    touch.triangle = i;
    touch.doubtful = i < k_terrain_manifolds_max;
    touch.deepest = touch.doubtful ? -(int64_t{1} << 36) : 0;
    const double angle = 0.25 * i;
    touch.manifold.normal = {static_cast<int32_t>(cos(angle) * (1 << 30)), static_cast<int32_t>(sin(angle) * (1 << 30)),
                             0};
    touch.manifold.count = 1;
    touch.manifold.point[0] = {{0, 0, 0}, {0, 0, 0}, touch.deepest, i + 1};
    found.add(touch);
  }
  ASSERT_EQ(found.finish(), 1u);
  EXPECT_EQ(found.manifold(0).triangle, k_terrain_manifolds_max);
}

DETENT_TEST(mesh_contact, touches_on_a_face_and_at_an_edge_share_a_manifold_only_if_their_normals_are_equal) {
  for (const int32_t tilt : {0, 1 << 20}) {  // 2^-10 rad
    TerrainManifolds found(int64_t{1} << 40, 5);
    for (uint32_t i = 0; i < 4; ++i) {
      TerrainTouch touch = {};
      touch.triangle = i;
      touch.on_face = i % 2 == 0;
      touch.manifold.normal = {touch.on_face ? 0 : tilt, (1 << 30) - (touch.on_face ? 0 : tilt >> 11), 0};
      touch.manifold.count = 1;
      touch.manifold.point[0] = {{0, 0, 0}, {0, 0, int64_t{i} << 40}, 0, i + 1};
      found.add(touch);
    }
    const uint32_t count = tilt == 0 ? 1 : 2;
    ASSERT_EQ(found.finish(), count);
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(found.manifold(i).count, 4 / count);
  }
}

DETENT_TEST(mesh_contact, sizes_of_any_kind_together_stay_in_range) {
  Samples samples = {31};
  uint32_t met = 0;
  const double least = sizeof(Coord) == 4 ? -3 : -11;
  for (uint32_t n = 0; n < detent_oracle::rounds(300); ++n) {
    const double size = exp2(uniform(samples, least, 11)), body_size = exp2(uniform(samples, least, 12));
    Ground ground(detent_terrains::ground(4, size, [&](double, double) { return size * uniform(samples, -0.3, 0.3); }));
    ground.pose.rotation = rotation_near(any_rotation(samples));
    OracleBody body = body_of(n % 3 == 0   ? sphere(real_near(body_size))
                              : n % 3 == 1 ? box(reals_near(Vector{{1, 0.5, 0.7}} * body_size))
                                           : cylinder(real_near(body_size), real_near(body_size)));
    body.pose.rotation = rotation_near(any_rotation(samples));
    const double far = n % 4 == 0 ? 4 : uniform(samples, 0, 1.2);
    body.pose.position = position_near(any_direction(samples) * (far * (size + body_size)));
    const TerrainContacts contacts = contacts_of(ground, body, body_size / 16);
    EXPECT_LE(contacts.count, k_terrain_manifolds_max);
    for (uint32_t i = 0; i < contacts.count; ++i) {
      const ContactGeometry& geometry = contacts.contact[i].geometry;
      EXPECT_NEAR(length(host(geometry.normal)), 1, 1e-5);
      ASSERT_GE(geometry.count, 1u);
      for (uint32_t k = 0; k < geometry.count; ++k) {
        EXPECT_NE(geometry.point[k].feature, 0u);
        EXPECT_LE(real_to_host(geometry.point[k].separation), body_size / 16 * 1.0001);
        for (uint32_t other = 0; other < k; ++other)
          EXPECT_NE(geometry.point[k].feature, geometry.point[other].feature);
        expect_arms_held(geometry.point[k]);
      }
      for (uint32_t other = 0; other < i; ++other) EXPECT_NE(contacts.contact[i].key, contacts.contact[other].key);
    }
    met += contacts.count > 0 ? 1u : 0u;
  }
  EXPECT_GT(met, 20u);
}

DETENT_TEST(mesh_contact, a_small_body_rests_on_a_triangle_of_many_kilometres) {
  const Ground ground(plane(1, 16000));
  OracleBody body = body_of(box({0.25, 0.25, 0.25}));
  body.pose.rotation = {0.0, 0.0, 0.0, 1.0};
  for (uint32_t step = 0; step < 20; ++step) {
    body.pose.position = position_near({{-7000 + 700.0 * step, 0.249, 0.31 * step}});
    const TerrainContacts contacts = contacts_of(ground, body);
    ASSERT_EQ(contacts.count, 1u);
    EXPECT_EQ(contacts.contact[0].geometry.count, 4u) << step;
    EXPECT_LE(normal_error(contacts.contact[0], {{0, 1, 0}}), 1e-4);
    EXPECT_NEAR(deepest_of(contacts), -0.001, 1e-4);
  }
}

DETENT_TEST(mesh_contact, a_turned_and_moved_terrain_gives_turned_and_moved_contacts) {
  Ground ground(plane(16, 0.25));
  Samples samples = {19};
  for (uint32_t n = 0; n < detent_oracle::rounds(200); ++n) {
    ground.pose.rotation = rotation_near(any_rotation(samples));
    const double far = sizeof(Coord) == 4 ? 100 : 1000;
    const Vector at = any_direction(samples) * far;
    ground.pose.position = position_near(at);
    const Vector up = detent_oracle::axis_of(host(ground.pose.rotation), 1);
    OracleBody body = body_of(sphere(0.5));
    body.pose.rotation = rotation_near(any_rotation(samples));
    body.pose.position = position_near(at + up * 0.49);
    const TerrainContacts contacts = contacts_of(ground, body);
    ASSERT_EQ(contacts.count, 1u);
    EXPECT_LE(normal_error(contacts.contact[0], up), 4 * k_normal_error);
    EXPECT_NEAR(deepest_of(contacts), -0.01, 4 * k_length_error + (sizeof(Coord) == 4 ? 3e-5 : 1e-8));
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
