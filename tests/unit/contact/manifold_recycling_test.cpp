#include "contact/manifold_recycling.h"

#include "tests/unit/contact/pairs.h"

/// Recycled contact points, compared with the same points in double, and with points that are found anew.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Vector turned(const Quaternion& q, const Vector& v) {
  return detent_oracle::axis_of(q, 0) * v[0] + detent_oracle::axis_of(q, 1) * v[1] +
         detent_oracle::axis_of(q, 2) * v[2];
}

struct ReusedPair {
  OraclePair bodies;
  ContactGeometry found;
  ManifoldState kept;
};

struct Reuse {
  bool used;
  ContactGeometry contact;
  ManifoldState after;
};

ManifoldState kept_of(const OraclePair& pair, const ContactGeometry& contact) {
  const Matrix3 rotation_a = matrix_from(pair.a.pose.rotation), rotation_b = matrix_from(pair.b.pose.rotation);
  return kept_manifold({pair.a.pose, pair.a.properties, rotation_a}, {pair.b.pose, pair.b.properties, rotation_b},
                       contact);
}

Reuse reuse_of(const ReusedPair& pair, const OraclePair& now, double tolerance, double distance_max) {
  const Matrix3 rotation_a = matrix_from(now.a.pose.rotation), rotation_b = matrix_from(now.b.pose.rotation);
  uint32_t feature[k_manifold_points_max] = {};
  for (uint32_t i = 0; i < pair.found.count; ++i) feature[i] = pair.found.point[i].feature;
  Reuse reuse;
  reuse.used = recycle_manifold({now.a.pose, now.a.properties, rotation_a}, {now.b.pose, now.b.properties, rotation_b},
                                pair.kept, feature, pair.found.count, real_near(tolerance), real_near(distance_max),
                                reuse.contact, reuse.after);
  return reuse;
}

/// Shapes that have faces; all their sizes are about `size`.
BodyProperties faced_properties(Samples& samples, uint32_t kind, double size) {
  const auto some = [&] { return real_near(size * uniform(samples, 0.5, 1)); };
  const Real round = real_near(size / 16);
  const Real x = some(), y = some(), z = some();
  switch (kind) {
    case 0:
      return properties_of(box({x, y, z}));
    case 1:
      return properties_of(cylinder(x, y));
    case 2:
      return properties_of(rounded(box({x, y, z}), round));
    default:
      return properties_of(rounded(cylinder(x, y), round));
  }
}

/// B on top of A: rotated and moved at random on its face, penetrating by a thousandth of its size. The pair has a
/// random orientation.
ReusedPair standing_pair(Samples& samples, double size_a, double size_b) {
  ReusedPair pair;
  pair.bodies.a.properties = faced_properties(samples, samples.below(4), size_a);
  pair.bodies.b.properties = faced_properties(samples, samples.below(4), size_b);
  const auto half_height = [](const BodyProperties& properties) {
    return (host(properties.size.y) + host(properties.rounding)) * unit_of(properties);
  };
  const Quaternion frame = any_rotation(samples);
  const Quaternion change_of_rotation = detent_oracle::rotation_by({{0, uniform(samples, -3, 3), 0}});
  pair.bodies.a.pose.rotation = rotation_near(normalised(frame));
  pair.bodies.b.pose.rotation = rotation_near(normalised(frame * change_of_rotation));
  const Vector at = any_direction(samples) * uniform(samples, 0, sizeof(Coord) == 4 ? 1000 : 1e5);
  pair.bodies.a.pose.position = position_near(at);
  const double smaller = fmin(size_a, size_b), distance_max = fmax(size_a, size_b) / 4;
  const Vector up = detent_oracle::axis_of(normalised(frame), 1), side = detent_oracle::axis_of(normalised(frame), 0);
  pair.bodies.b.pose.position = position_near(
      at + up * (half_height(pair.bodies.a.properties) + half_height(pair.bodies.b.properties) - smaller / 1000) +
      side * uniform(samples, -distance_max, distance_max));
  pair.found = contact_of(pair.bodies.a, pair.bodies.b, extent_of(pair.bodies) / 64);
  pair.kept = kept_of(pair.bodies, pair.found);
  return pair;
}

Vector place_of(const OracleBody& body) {
  return {
      {coord_to_host(body.pose.position.x), coord_to_host(body.pose.position.y), coord_to_host(body.pose.position.z)}};
}
OracleBody moved(const OracleBody& body, const Vector& pivot, const Quaternion& change_of_rotation,
                 const Vector& between) {
  OracleBody result = body;
  result.pose.position = position_near(pivot + turned(change_of_rotation, place_of(body) - pivot) + between);
  result.pose.rotation = rotation_near(normalised(change_of_rotation * normalised(host(body.pose.rotation))));
  return result;
}

/// Moves both bodies by any common motion, and then the smaller one by up to `part` of its size.
OraclePair moved(const OraclePair& pair, Samples& samples, double part) {
  const double size = fmax(unit_of(pair.a.properties), unit_of(pair.b.properties));
  const Quaternion change_of_rotation = any_rotation(samples);
  const Vector between = any_direction(samples) * size;
  OraclePair now = {moved(pair.a, place_of(pair.a), change_of_rotation, between),
                    moved(pair.b, place_of(pair.a), change_of_rotation, between)};
  OracleBody& smaller = unit_of(pair.b.properties) <= unit_of(pair.a.properties) ? now.b : now.a;
  const double bound = unit_of(smaller.properties);
  const Vector angular_velocity = any_direction(samples) * (uniform(samples, 0, part) * extent_of(pair) / bound);
  const Vector shift = any_direction(samples) * (uniform(samples, 0, part) * extent_of(pair));
  smaller = moved(smaller, place_of(smaller), detent_oracle::rotation_by(angular_velocity), shift);
  Quat& q = smaller.pose.rotation;
  if (samples.below(2) == 0) q = {-q.x, -q.y, -q.z, -q.w};  // the same rotation
  return now;
}

/// Converts a vector to the axes of a body, and back.
Vector local_of(const OracleBody& body, const Vector& v) {
  const Quaternion q = normalised(host(body.pose.rotation));
  return turned({-q.x, -q.y, -q.z, q.w}, v);
}
Vector world_of(const OracleBody& body, const Vector& v) { return turned(normalised(host(body.pose.rotation)), v); }

/// The precision of a position in this pair, m.
double grain_of(const OraclePair& pair) {
  return 64 * step_of(pair) + 8 * (sizeof(Coord) == 4 ? 1.6e-5 : 2.4e-10) + unit_of(pair.b.properties) * unit_steps(64);
}

void expect_moved_along(double size_a, double size_b, uint64_t seed) {
  Samples samples = {seed};
  uint32_t used = 0;
  const uint32_t count = detent_oracle::rounds(1000);
  for (uint32_t i = 0; i < count; ++i) {
    const ReusedPair pair = standing_pair(samples, size_a, size_b);
    if (!is_kept(pair.kept)) continue;
    ASSERT_TRUE(is_manifold(pair.bodies.a.properties, pair.bodies.b.properties, pair.found.count, pair.kept));
    const double part = 1.0 / 256, extent = extent_of(pair.bodies);
    const OraclePair now = moved(pair.bodies, samples, part);
    const Reuse reuse = reuse_of(pair, now, 4 * part * extent, extent / 32);
    if (!reuse.used) continue;
    ++used;
    const bool base_is_a = unit_of(pair.bodies.a.properties) * host(pair.bodies.a.properties.bounding_radius) >=
                           unit_of(pair.bodies.b.properties) * host(pair.bodies.b.properties.bounding_radius);
    const OracleBody &base = base_is_a ? pair.bodies.a : pair.bodies.b, &base_now = base_is_a ? now.a : now.b;
    const OracleBody &other = base_is_a ? pair.bodies.b : pair.bodies.a, &other_now = base_is_a ? now.b : now.a;
    const double sign = base_is_a ? 1 : -1;
    const Vector normal = world_of(base_now, local_of(base, host(pair.found.normal)));
    EXPECT_LT(length(normal - host(reuse.contact.normal)), unit_steps(64));
    // The relative displacement, along the normal, of the two surface points that faced each other.
    ASSERT_EQ(reuse.contact.count, pair.found.count);
    for (uint32_t k = 0; k < reuse.contact.count; ++k) {
      const ContactGeometryPoint &before = pair.found.point[k], &after = reuse.contact.point[k];
      EXPECT_EQ(after.feature, before.feature);
      const Vector middle = host(base_is_a ? before.arm_b : before.arm_a) * unit_of(other.properties);
      const Vector from_base = middle + difference(other.pose.position, base.pose.position);
      const Vector on_other = world_of(other_now, local_of(other, middle));
      const Vector on_base = world_of(base_now, local_of(base, from_base));
      const Vector between = difference(other_now.pose.position, base_now.pose.position) + on_other - on_base;
      const double expected = real_to_host(before.separation) + sign * dot(normal, between);
      const double anchor_error = unit_of(other.properties) * 0x1p-15 * 8 * part;
      EXPECT_NEAR(real_to_host(after.separation), expected, grain_of(pair.bodies) + anchor_error);
      const Vector arm = host(base_is_a ? after.arm_b : after.arm_a) * unit_of(other.properties);
      EXPECT_LT(length(arm - on_other), unit_of(other.properties) * 0x1p-15 + grain_of(pair.bodies));
      // Both arms lead to the same place.
      const Vector arm_base = host(base_is_a ? after.arm_a : after.arm_b) * unit_of(base.properties);
      const Vector apart = difference(other_now.pose.position, base_now.pose.position) + arm - arm_base;
      EXPECT_LT(length(apart), grain_of(pair.bodies));
    }
  }
  EXPECT_GT(used, count / 3);
}

DETENT_TEST(manifold_recycling, separations_follow_the_motion_along_the_normal) { expect_moved_along(0.5, 0.5, 41); }
DETENT_TEST(manifold_recycling, separations_follow_the_motion_on_a_body_a_hundred_times_as_large) {
  expect_moved_along(50, 0.5, 42);
}
DETENT_TEST(manifold_recycling, separations_follow_the_motion_whichever_body_is_the_larger) {
  expect_moved_along(0.5, 5, 43);
}
DETENT_TEST(manifold_recycling, separations_follow_the_motion_of_small_bodies) {
  if (sizeof(Coord) == 4) return;  // whose smallest body is 10 cm
  expect_moved_along(0.005, 0.004, 44);
}

DETENT_TEST(manifold_recycling, points_used_again_are_those_found_anew_but_for_the_square_of_the_motion) {
  Samples samples = {45};
  uint32_t same = 0, compared = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(1000); ++i) {
    const ReusedPair pair = standing_pair(samples, 0.5, 0.5);
    const double part = 1.0 / 512, extent = extent_of(pair.bodies), distance_max = extent / 32;
    const OraclePair now = moved(pair.bodies, samples, part);
    const Reuse reuse = reuse_of(pair, now, 4 * part * extent, distance_max);
    if (!reuse.used) continue;
    ++compared;
    const ContactGeometry fresh = contact_of(now.a, now.b, distance_max);
    EXPECT_LT(length(host(fresh.normal) - host(reuse.contact.normal)), 4 * part);
    bool all = fresh.count == reuse.contact.count;
    for (uint32_t k = 0; k < reuse.contact.count; ++k) {
      bool found = false;
      for (uint32_t m = 0; m < fresh.count; ++m) {
        if (fresh.point[m].feature != reuse.contact.point[k].feature) continue;
        found = true;
        const double apart = length(host(fresh.point[m].arm_b) - host(reuse.contact.point[k].arm_b));
        if (apart > 16 * part) continue;  // where sides cross at a small angle, or of a rim
        EXPECT_NEAR(real_to_host(fresh.point[m].separation), real_to_host(reuse.contact.point[k].separation),
                    64 * part * part);
      }
      all = all && found;
    }
    same += all ? 1u : 0u;
  }
  EXPECT_GT(compared, detent_oracle::rounds(1000) / 3);
  EXPECT_GT(same * 10, compared * 6);  // the rest have a rim, or sides that just cross
}

DETENT_TEST(manifold_recycling, a_pair_is_found_anew_once_a_point_of_the_smaller_body_has_moved_by_the_tolerance) {
  Samples samples = {46};
  uint32_t within = 0, beyond = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(3000); ++i) {
    const ReusedPair pair = standing_pair(samples, 0.5, 0.4);
    if (!is_kept(pair.kept) || pair.found.count < 3) continue;  // the body can turn about one or two points
    const double extent = extent_of(pair.bodies), tolerance = extent / 256;
    const OraclePair now = moved(pair.bodies, samples, i % 2 == 0 ? 1.0 / 128 : 1.0 / 1024);
    // The motion of the points of the smaller body's bounding sphere, in the frame of the larger body.
    const bool base_is_a = unit_of(pair.bodies.a.properties) * host(pair.bodies.a.properties.bounding_radius) >=
                           unit_of(pair.bodies.b.properties) * host(pair.bodies.b.properties.bounding_radius);
    const OracleBody &base = base_is_a ? pair.bodies.a : pair.bodies.b, &base_now = base_is_a ? now.a : now.b;
    const OracleBody &other = base_is_a ? pair.bodies.b : pair.bodies.a, &other_now = base_is_a ? now.b : now.a;
    const double radius = unit_of(other.properties) * host(other.properties.bounding_radius);
    double most = 0, least = 1e9;
    for (int k = 0; k < 26; ++k) {
      const Vector point = any_direction(samples) * radius;
      const Vector before =
          local_of(base, difference(other.pose.position, base.pose.position) + world_of(other, point));
      const Vector after =
          local_of(base_now, difference(other_now.pose.position, base_now.pose.position) + world_of(other_now, point));
      most = fmax(most, length(after - before));
      least = fmin(least, length(after - before));
    }
    const bool used = reuse_of(pair, now, tolerance, extent / 16).used;
    if (most > tolerance) {
      ++beyond;
      EXPECT_FALSE(used);
    } else if (most < tolerance / 3) {
      ++within;
      EXPECT_TRUE(used);
    }
  }
  EXPECT_GT(beyond, detent_oracle::rounds(3000) / 10);
  EXPECT_GT(within, detent_oracle::rounds(3000) / 10);
}

DETENT_TEST(manifold_recycling, a_point_that_parts_is_left_out_and_a_pair_that_parts_is_found_anew) {
  ReusedPair pair;
  pair.bodies.a.properties = box_properties({{2, 0.5, 2}});
  pair.bodies.b.properties = box_properties({{0.5, 0.5, 0.5}});
  pair.bodies.a.pose.rotation = pair.bodies.b.pose.rotation = rotation_near({0, 0, 0, 1});
  pair.bodies.b.pose.position = position_near({{0, 1, 0}});
  pair.found = contact_of(pair.bodies.a, pair.bodies.b, 1.0 / 64);
  pair.kept = kept_of(pair.bodies, pair.found);
  ASSERT_EQ(pair.found.count, 4u);
  OraclePair now = pair.bodies;
  now.b.pose.rotation = rotation_near(detent_oracle::rotation_by({{0.001, 0, 0.001}}));
  const Reuse tipped = reuse_of(pair, now, 1, 0.0005);
  ASSERT_TRUE(tipped.used);
  ASSERT_EQ(tipped.contact.count, 3u);  // over a corner
  for (uint32_t k = 0; k < 3; ++k) EXPECT_LT(real_to_host(tipped.contact.point[k].separation), 0.0001);
  EXPECT_TRUE(is_manifold(now.a.properties, now.b.properties, 3, tipped.after));
  EXPECT_FALSE(is_manifold(now.a.properties, now.b.properties, 2, tipped.after));
  now.b.pose.rotation = rotation_near(detent_oracle::rotation_by({{0, 0, 0.002}}));
  EXPECT_FALSE(reuse_of(pair, now, 1, 0.0005).used);  // over an edge, about which it turns
  EXPECT_TRUE(reuse_of(pair, now, 1, 0.002).used);
  now = pair.bodies;
  now.b.pose.position = position_near({{0, 1.001, 0}});
  EXPECT_FALSE(reuse_of(pair, now, 1, 0.0005).used);
  EXPECT_TRUE(reuse_of(pair, now, 1, 0.002).used);
}

DETENT_TEST(manifold_recycling, contacts_about_which_a_body_can_turn_are_recycled_for_a_shorter_motion) {
  ReusedPair reused;
  OraclePair& pair = reused.bodies;
  pair.a.properties = box_properties({{2, 0.5, 2}});
  pair.b.properties = box_properties({{0.5, 0.5, 0.5}});
  pair.a.pose.rotation = rotation_near({0, 0, 0, 1});
  for (const double lean : {0.3, 0.7}) {  // on an edge, and on a corner
    const Quaternion on_edge = detent_oracle::rotation_by({{0, 0, lean}});
    const Quaternion corner = detent_oracle::rotation_by({{0.5, 0, 0}}) * on_edge;
    for (const Quaternion& change_of_rotation : {on_edge, corner}) {
      pair.b.pose.rotation = rotation_near(normalised(change_of_rotation));
      pair.b.pose.position = position_near({{0, 0, 0}});
      place(pair, {{0, 0, 0}}, {{0, 1, 0}}, -0.001);
      reused.found = contact_of(pair.a, pair.b, 1.0 / 64);
      ASSERT_GT(reused.found.count, 0u);
      ASSERT_LT(reused.found.count, 3u);
      reused.kept = kept_of(pair, reused.found);
      ASSERT_TRUE(is_kept(reused.kept));
      ASSERT_TRUE(is_manifold(pair.a.properties, pair.b.properties, reused.found.count, reused.kept));
      constexpr double k_tolerance = 0x1p-6;
      const auto moved_by = [&](double y) {
        OraclePair now = pair;
        now.b = moved(pair.b, place_of(pair.b), {0, 0, 0, 1}, {{0, y, 0}});
        return reuse_of(reused, now, k_tolerance, 1.0 / 64);
      };
      const Reuse same = moved_by(0.9 * k_tolerance / 64);
      EXPECT_TRUE(same.used);
      EXPECT_EQ(same.contact.count, reused.found.count);
      EXPECT_FALSE(moved_by(1.1 * k_tolerance / 64).used);
    }
  }
  pair.a.properties = properties_of(half_space());
  pair.b.pose.rotation = rotation_near({0, 0, 0, 1});
  pair.b.pose.position = position_near({{0, 0.5, 0}});
  const ContactGeometry found = contact_of(pair.a, pair.b, 1.0 / 64);  // half-spaces are found anew as fast
  ASSERT_EQ(found.count, 4u);
  EXPECT_FALSE(is_kept(kept_of(pair, found)));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
