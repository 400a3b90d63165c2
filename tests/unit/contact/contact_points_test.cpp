#include <detent/contact.h>
#include <detent/numbers.h>

#include <string>

#include "contact/contact_clip.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/distance/placed_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Real real(double value) {
  Real result = 0.0;
  EXPECT_OK(real_from_host(value, result));
  return result;
}
Coord coord(double value) {
  Coord result = 0.0;
  EXPECT_OK(coord_from_host(value, result));
  return result;
}
Arrow operator+(const Arrow& a, const Arrow& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Arrow operator*(const Arrow& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
Arrow operator-(const Arrow& a) { return {-a.x, -a.y, -a.z}; }
Arrow arrow(const Vec3<Real>& v) { return {real_to_host(v.x), real_to_host(v.y), real_to_host(v.z)}; }
Arrow unit_arrow(const Vec3<Unit>& v) { return {unit_to_host(v.x), unit_to_host(v.y), unit_to_host(v.z)}; }
Vec3<Real> reals(const Arrow& v) { return {real(v.x), real(v.y), real(v.z)}; }
Position position(const Arrow& v) { return {coord(v.x), coord(v.y), coord(v.z)}; }

double uniform(Samples& samples, double low, double high) {
  return low + (high - low) * static_cast<double>(samples.bits() >> 11) * 0x1p-53;
}
Arrow random_direction(Samples& samples) {
  for (;;) {
    const Arrow v = {uniform(samples, -1, 1), uniform(samples, -1, 1), uniform(samples, -1, 1)};
    const double size = length(v);
    if (size < 1 && size > 0.1) return v * (1 / size);
  }
}

/// The test's model of a convex shape: its core and the radius of its ball.
struct Body {
  Convex convex;
  std::vector<Arrow> points;  ///< of a polytope
  double radius = 0, half_length = 0, ball = 0;
  double size = 0;    ///< of the core, or else the ball: greatest distance from the centre
  bool thin = false;  ///< without faces around it
};

/// The greatest d.p over the core, for a unit vector d in its axes.
double core_support(const Body& body, const Arrow& d) {
  if (body.convex.type == ShapeType::cylinder)
    return body.radius * sqrt(d.x * d.x + d.z * d.z) + body.half_length * fabs(d.y);
  if (body.convex.type == ShapeType::cone)
    return std::max(1.5 * body.half_length * d.y,
                    body.radius * sqrt(d.x * d.x + d.z * d.z) - body.half_length / 2 * d.y);
  double most = body.points.empty() ? 0 : -HUGE_VAL;
  for (const Arrow& p : body.points) most = std::max(most, dot(d, p));
  return most;
}

struct Placement {
  Arrow position;
  Quat rotation;
  Arrow axis[3];  ///< the local axes
  Pose pose() const { return {detent::position(position), rotation}; }
  Arrow to_local(const Arrow& v) const { return {dot(axis[0], v), dot(axis[1], v), dot(axis[2], v)}; }
};

Placement placement(const Arrow& at, double x, double y, double z, double w) {
  const double size = sqrt(x * x + y * y + z * z + w * w);
  const auto unit = [&](double c) {
    Unit result = 0.0;
    EXPECT_OK(unit_from_host(c / size, result));
    return result;
  };
  Placement result = {at, {unit(x), unit(y), unit(z), unit(w)}, {}};
  const Quat& q = result.rotation;
  x = unit_to_host(q.x), y = unit_to_host(q.y), z = unit_to_host(q.z), w = unit_to_host(q.w);
  result.axis[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  result.axis[1] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  result.axis[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
  return result;
}
/// A placement rotated by `rotation_vector`, rad, of any length.
Placement turned(const Arrow& at, const Arrow& rotation_vector) {
  const double angle = length(rotation_vector), s = angle == 0 ? 0 : sin(angle / 2) / angle;
  return placement(at, rotation_vector.x * s, rotation_vector.y * s, rotation_vector.z * s, cos(angle / 2));
}
Placement random_placement(Samples& samples, const Arrow& at) {
  return turned(at, random_direction(samples) * uniform(samples, 0, 3));
}

/// Rounds the position to the coordinates of the configuration.
void settle(Placement& placement) {
  const Position held = position(placement.position);
  placement.position = {coord_to_host(held.x), coord_to_host(held.y), coord_to_host(held.z)};
}

constexpr ShapeType k_types[] = {ShapeType::sphere, ShapeType::capsule, ShapeType::box,     ShapeType::cylinder,
                                 ShapeType::cone,   ShapeType::hull,    ShapeType::triangle};

Body body_of(const Shape& shape) {
  Body body;
  EXPECT_OK(make_convex(shape, body.convex));
  const double half = real_to_host(shape.half_length), radius = real_to_host(shape.radius);
  switch (shape.type) {
    case ShapeType::box: {
      const Vec3<Real>& h = shape.half_extents;
      for (int i = 0; i < 8; ++i) {
        const auto side = [i](int bit, Real extent) { return ((i >> bit & 1) != 0 ? -1 : 1) * real_to_host(extent); };
        body.points.push_back({side(0, h.x), side(1, h.y), side(2, h.z)});
      }
      body.size = length(body.points[0]);
      break;
    }
    case ShapeType::capsule:
      body.points = {{0, half, 0}, {0, -half, 0}};
      body.size = half;
      body.thin = true;
      break;
    case ShapeType::sphere:
      body.thin = true;
      break;
    default:
      body.radius = radius;
      body.half_length = half;
      body.size = std::max(sqrt(radius * radius + half * half / (shape.type == ShapeType::cone ? 4 : 1)),
                           shape.type == ShapeType::cone ? 1.5 * half : 0);
  }
  body.ball =
      shape.type == ShapeType::sphere || shape.type == ShapeType::capsule ? radius : real_to_host(shape.rounding);
  if (body.size == 0) body.size = body.ball;
  return body;
}

Body hull_body(bool prism, double rounding) {
  Body body;
  const Asset asset = prism ? Asset{detent_hulls::k_prism, sizeof detent_hulls::k_prism}
                            : Asset{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron};
  EXPECT_OK(make_hull(asset, real(rounding), body.convex));
  const HullView hull = hull_of(body.convex);
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const double unit = ldexp(1, hull.exponent() - 30);
    body.points.push_back(arrow(Vec32{hull.x(i), hull.y(i), hull.z(i)}) * unit);
    body.size = std::max(body.size, length(body.points.back()));
  }
  body.ball = rounding;
  return body;
}

Body random_body(Samples& samples, ShapeType type) {
  // Drawn in a fixed order, so that all compilers produce the same shapes.
  const Real first = real(uniform(samples, 0.2, 1)), second = real(uniform(samples, 0.2, 1)),
             third = real(uniform(samples, 0.2, 1));
  const double rounding = samples.below(2) == 0 ? 0 : uniform(samples, 0.01, 0.2);
  switch (type) {
    case ShapeType::sphere:
      return body_of(sphere(first));
    case ShapeType::capsule:
      return body_of(capsule(first, second));
    case ShapeType::box:
      return body_of(rounded(box({first, second, third}), real(rounding)));
    case ShapeType::cylinder:
      return body_of(rounded(cylinder(first, second), real(rounding)));
    case ShapeType::cone:
      return body_of(rounded(cone(first, second), real(rounding)));
    case ShapeType::hull:
      return hull_body(samples.below(2) == 0, rounding);
    default: {
      Body body;
      Vec3<Real> corners[3];
      for (int i = 0; i < 3; ++i) {
        body.points.push_back(random_direction(samples) * uniform(samples, 0.3, 1));
        corners[i] = reals(body.points.back());
        body.size = std::max(body.size, length(body.points.back()));
      }
      EXPECT_OK(make_triangle(corners, real(rounding), body.convex));
      body.ball = rounding;
      body.thin = true;
      return body;
    }
  }
}

/// The greatest d.p over the shape including its ball, world axes, from its centre.
double support_along(const Body& body, const Placement& at, const Arrow& d) {
  return core_support(body, at.to_local(d)) + body.ball;
}
/// The gap between A and B along the unit vector n from A to B; negative if they overlap along it.
double gap_along(const Body& a, const Placement& at_a, const Body& b, const Placement& at_b, const Arrow& n) {
  return dot(n, at_b.position - at_a.position) - support_along(a, at_a, n) - support_along(b, at_b, -n);
}

double to_host(Real value) { return real_to_host(value); }
uint32_t swapped(uint32_t feature) { return (feature >> 12 | feature << 12) & 0xffffff; }

#if defined(DETENT_F32)
constexpr double k_ulps = 1e-6;
#else
constexpr double k_ulps = 2e-8;  ///< of the pair's extent, m here: blocks, normals, and the test's own rotations
#endif

struct Tally {
  uint32_t contacts = 0, points = 0, mirrored_less = 0, leaning = 0, shallow = 0, capped = 0;
  double above_max = 0;  ///< by how much the deepest point is above the least gap along the normal
  double beyond_max = 0;
  double axis_max = 0;
};

void check_manifold(const Body& a, const Placement& at_a, const Body& b, const Placement& at_b, double distance_max,
                    Samples& samples, Tally& tally) {
  ContactManifold manifold;
  ASSERT_OK(contact_points(a.convex, at_a.pose(), b.convex, at_b.pose(), real(distance_max), manifold));
  Closest closest;
  ASSERT_OK(closest_points(a.convex, at_a.pose(), b.convex, at_b.pose(), closest));
  const double distance = to_host(closest.distance);
  if (manifold.count == 0) {
    ASSERT_FALSE(closest.overlap);
    ASSERT_GT(distance, distance_max - k_ulps);
    return;
  }
  tally.capped += manifold.capped ? 1 : 0;
  ASSERT_LT(distance, distance_max + k_ulps);
  ++tally.contacts;
  tally.points += manifold.count;
  const Arrow n = unit_arrow(manifold.normal);
  ASSERT_NEAR(length(n), 1, 1e-6);
  const double gap = gap_along(a, at_a, b, at_b, n);
  const double size = std::min(a.size, b.size);
  // The axis is nearly the best one: no other axis separates the shapes by much more. A distance is the greatest gap
  // over all axes.
  double best = closest.overlap ? gap : distance;
  for (int i = 0; i < 40; ++i) best = std::max(best, gap_along(a, at_a, b, at_b, random_direction(samples)));
  tally.axis_max = std::max(tally.axis_max, (best - gap) / size);
  double least = HUGE_VAL;
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.point[i];
    const double separation = to_host(point.separation);
    least = std::min(least, separation);
    ASSERT_NE(point.feature, 0u);
    for (uint32_t k = 0; k < i; ++k) ASSERT_NE(point.feature, manifold.point[k].feature);
    ASSERT_LE(separation, distance_max + k_ulps);
    // An edge is extended by a 64th beyond its end, and its slope may be up to a 32nd.
    ASSERT_GE(separation, gap - size / 2048 - k_ulps) << "deeper than the shapes are along the normal";
    // Each surface is half the separation away from the point. The points lie in the shapes, except that the sides of
    // the areas are moved outward.
    const Arrow on_a = arrow(point.from_a) - n * (separation / 2), on_b = arrow(point.from_b) + n * (separation / 2);
    ASSERT_LT(length(arrow(point.from_a) - arrow(point.from_b) - (at_b.position - at_a.position)), k_ulps);
    for (int k = 0; k < 40; ++k) {
      const Arrow d = k == 0 ? n : k == 1 ? -n : random_direction(samples);
      const double beyond =
          std::max(dot(d, on_a) - support_along(a, at_a, d), dot(d, on_b) - support_along(b, at_b, d));
      tally.beyond_max = std::max(tally.beyond_max, beyond / size);
      ASSERT_LE(beyond, std::max(a.size, b.size) / 32 + k_ulps) << "point " << i << " lies outside";
    }
  }
  // The deepest point is found: compared with the least distance, and with the depth along the normal.
  tally.above_max = std::max(tally.above_max, (least - gap) / size);
  ASSERT_LE(least, (closest.overlap ? distance_max : distance) + size / 32 + k_ulps);
  // A face at an angle of up to 2^-3 rad to crossing edges may lie far above an edge beyond its sides; but no point is
  // deeper than the axis by more than a 64th.
  const bool leans = manifold.count > 1 && (best - gap > size / 64 + k_ulps || least - gap > size / 32);
  tally.leaning += leans ? 1 : 0;
  if (leans) {
    // The axis of the edges is found by search.
    Arrow axis = n;
    best = gap;
    for (double step = 0.125; step > 1e-4; step *= 0.98) {
      const Arrow near = axis + random_direction(samples) * step, tried = near * (1 / length(near));
      const double apart = gap_along(a, at_a, b, at_b, tried);
      if (apart > best) axis = tried;
      best = std::max(best, apart);
    }
    ASSERT_LE(best - gap, (a.size + b.size) / 8 + k_ulps);
    ASSERT_GE(least, best - size / 64 - k_ulps);
  } else {
    ASSERT_LE(best - gap, size / 64 + k_ulps);
  }
  if (least - (leans ? best : gap) > size / 32) ++tally.shallow;
  // A and B change places.
  ContactManifold other;
  ASSERT_OK(contact_points(b.convex, at_b.pose(), a.convex, at_a.pose(), real(distance_max), other));
  // On a round surface the search may end at any point whose depth is within ulps of the least.
  const bool curved = a.radius > 0 || b.radius > 0;
  const double place_error = curved ? 2e-3 : 1e-5;
  bool mirrored = other.count == manifold.count && length(unit_arrow(other.normal) + n) < (curved ? 2e-3 : 1e-6);
  for (uint32_t i = 0; i < manifold.count && mirrored; ++i) {
    bool found = false;
    for (uint32_t k = 0; k < other.count; ++k) {
      const ManifoldPoint &p = manifold.point[i], &q = other.point[k];
      if (swapped(p.feature) != q.feature) continue;
      found = fabs(to_host(p.separation) - to_host(q.separation)) < (curved ? place_error / 8 : k_ulps) &&
              length(arrow(p.from_a) - arrow(q.from_b)) < place_error;
    }
    mirrored = found;
  }
  tally.mirrored_less += mirrored ? 0 : 1;
}

void report(ShapeType type_a, ShapeType type_b, const Tally& tally, uint32_t rounds) {
  printf(
      "%u %u: %u contacts, %u points, %u not mirrored, %u leaning, %u shallow, %u capped, above %.1e, beyond %.1e, "
      "axis %.1e of "
      "size\n",
      static_cast<uint32_t>(type_a), static_cast<uint32_t>(type_b), tally.contacts, tally.points, tally.mirrored_less,
      tally.leaning, tally.shallow, tally.capped, tally.above_max, tally.beyond_max, tally.axis_max);
  EXPECT_GT(tally.contacts, rounds / 20);
  EXPECT_LE(tally.mirrored_less, tally.contacts / 100);
  const auto curved = [](ShapeType type) { return type == ShapeType::cylinder || type == ShapeType::cone; };
  const int count = (curved(type_a) ? 1 : 0) + (curved(type_b) ? 1 : 0);
  EXPECT_LE(tally.capped, count == 2 ? tally.contacts / 10 : count == 1 ? tally.contacts / 1000 : 0);
  EXPECT_EQ(tally.shallow, 0u);
  EXPECT_LE(tally.leaning, tally.contacts / 50);
}

DETENT_TEST(contact, points_of_every_pair_of_shapes_lie_on_both_and_none_deeper_is_missed) {
  Samples samples{7};
  const uint32_t rounds = detent_oracle::rounds(2000);
  for (const ShapeType type_a : k_types) {
    for (const ShapeType type_b : k_types) {
      Tally tally;
      for (uint32_t i = 0; i < rounds; ++i) {
        const Body a = random_body(samples, type_a), b = random_body(samples, type_b);
        const Placement at_a = random_placement(samples, {0.25, -1, 3});
        const Arrow displacement = random_direction(samples);
        Placement at_b = random_placement(samples, at_a.position);
        // Separated along `displacement`, then moved back.
        const double apart = -gap_along(a, at_a, b, at_b, displacement);
        at_b.position = at_b.position + displacement * (apart + uniform(samples, -0.1, 0.1));
        settle(at_b);
        check_manifold(a, at_a, b, at_b, 0.05, samples, tally);
        if (HasFatalFailure()) {
          FAIL() << "shape types " << static_cast<uint32_t>(type_a) << " and " << static_cast<uint32_t>(type_b)
                 << ", round " << i;
        }
      }
      report(type_a, type_b, tally, rounds);
    }
  }
}

/// The outward normal of a random face or side of the body, in its axes.
Arrow random_face(const Body& body, Samples& samples) {
  switch (body.convex.type) {
    case ShapeType::box: {
      const uint32_t axis = samples.below(3);
      const double side = samples.below(2) == 0 ? 1 : -1;
      return {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
    }
    case ShapeType::hull: {
      const HullView hull = hull_of(body.convex);
      const HullPlane plane = hull.plane(samples.below(hull.face_count));
      return arrow(Vec32{plane.normal[0], plane.normal[1], plane.normal[2]}) * 0x1p-30;
    }
    case ShapeType::triangle: {
      const Arrow n = cross(body.points[1] - body.points[0], body.points[2] - body.points[0]);
      return n * ((samples.below(2) == 0 ? 1 : -1) / length(n));
    }
    case ShapeType::capsule:
    case ShapeType::cylinder:
    case ShapeType::cone: {
      const uint32_t displacement = samples.below(3);
      if (displacement == 0) return {0, -1, 0};
      if (displacement == 1 && body.convex.type != ShapeType::cone) return {0, 1, 0};
      const double angle = uniform(samples, 0, 6.28), rise = body.convex.type == ShapeType::cone ? body.radius : 0;
      const double across = body.convex.type == ShapeType::cone ? 2 * body.half_length : 1;
      const double size = sqrt(rise * rise + across * across);
      return {cos(angle) * across / size, rise / size, sin(angle) * across / size};
    }
    default:
      return random_direction(samples);
  }
}

/// A placement at `position`, rotated so that the local direction `face` points along `towards`, and by a random angle
/// about `towards`.
Placement facing(Samples& samples, const Arrow& face, const Arrow& towards, double tilt, bool straight) {
  // q = (axis of both, half way) for the shortest turn, then a turn about `towards`.
  Arrow axis = cross(face, towards);
  const double cosine = dot(face, towards);
  if (length(axis) < 1e-9) {
    axis = cross(face, fabs(face.x) < 0.9 ? Arrow{1, 0, 0} : Arrow{0, 1, 0});
  }
  axis = axis * (1 / length(axis));
  const double half = acos(std::max(-1.0, std::min(1.0, cosine))) / 2;
  const Arrow p = axis * sin(half);
  const double w = cos(half), angular_velocity = straight ? 0 : uniform(samples, 0, 3);
  const Arrow about = towards * sin(angular_velocity) + random_direction(samples) * (tilt / 2);
  const double v = cos(angular_velocity);
  const Arrow q = about * w + p * v + cross(about, p);
  return placement({0, 0, 0}, q.x, q.y, q.z, v * w - dot(about, p));
}

DETENT_TEST(contact, of_faces_and_sides_that_meet_flush_or_nearly_is_of_several_points) {
  Samples samples{8};
  const uint32_t rounds = detent_oracle::rounds(1000);
  for (const ShapeType type_a : k_types) {
    for (const ShapeType type_b : k_types) {
      Tally tally;
      for (uint32_t i = 0; i < rounds; ++i) {
        const Body a = random_body(samples, type_a),
                   b = samples.below(4) == 0 && type_a == type_b ? a : random_body(samples, type_b);
        constexpr double k_tilts[] = {0, 1e-7, 1e-5, 1e-3, 0.02};
        const Placement at_a = random_placement(samples, {0.25, -1, 3});
        const Arrow face = random_face(a, samples);
        const Arrow displacement = at_a.axis[0] * face.x + at_a.axis[1] * face.y + at_a.axis[2] * face.z;
        Placement at_b =
            facing(samples, random_face(b, samples), -displacement, k_tilts[samples.below(5)], samples.below(2) == 0);
        const Arrow aside =
            cross(displacement, random_direction(samples)) * (samples.below(3) == 0 ? 0.0 : 0.7 * a.size);
        at_b.position = at_a.position + aside;
        const double apart = -gap_along(a, at_a, b, at_b, displacement);
        constexpr double k_gaps[] = {0, 1e-9, -1e-9, 1e-6, -1e-6, 0.01, -0.01};
        at_b.position = at_b.position + displacement * (apart + k_gaps[samples.below(7)]);
        settle(at_b);
        check_manifold(a, at_a, b, at_b, 0.05, samples, tally);
        if (HasFatalFailure()) {
          FAIL() << "shape types " << static_cast<uint32_t>(type_a) << " and " << static_cast<uint32_t>(type_b)
                 << ", round " << i;
        }
      }
      report(type_a, type_b, tally, rounds);
    }
  }
}

/// The cores are far apart relative to their lengths, so an error in the height of a sloping edge causes a large error.
DETENT_TEST(contact, of_fat_capsules_nearly_parallel_is_as_deep_as_they_are) {
  Samples samples{9};
  const Body a = body_of(capsule(1.0, 0.25)), b = body_of(capsule(0.75, 0.375));
  Tally tally;
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    const Arrow tilt = {uniform(samples, -0.02, 0.02), 0, uniform(samples, -0.02, 0.02)};
    const Placement at_a = turned({0.25, -1, 3}, tilt * -0.5);
    Placement at_b = turned(at_a.position + Arrow{0, uniform(samples, -0.3, 0.3), 0}, tilt);
    const double angle = uniform(samples, 0, 6.28);
    const Arrow displacement = {cos(angle), 0, sin(angle)};
    at_b.position =
        at_b.position + displacement * (uniform(samples, -0.02, 0.02) - gap_along(a, at_a, b, at_b, displacement));
    settle(at_b);
    check_manifold(a, at_a, b, at_b, 0.05, samples, tally);
    ASSERT_FALSE(HasFatalFailure()) << "round " << i;
  }
  EXPECT_GT(tally.points, 3 * tally.contacts / 2);
}

struct Resting {
  const char* name;
  Body body;
  Arrow face;  ///< looks down
};

std::vector<Resting> things_at_rest() {
  return {{"box", body_of(box({0.5, 0.25, 0.375})), {0, -1, 0}},
          {"rounded box", body_of(rounded(box({0.5, 0.25, 0.375}), 0.0625)), {0, -1, 0}},
          {"cylinder", body_of(cylinder(0.25, 0.5)), {0, -1, 0}},
          {"lying cylinder", body_of(cylinder(0.25, 0.5)), {0.6, 0, 0.8}},
          {"cone", body_of(cone(0.375, 0.5)), {0, -1, 0}},
          {"lying capsule", body_of(capsule(0.25, 0.5)), {1, 0, 0}},
          {"standing capsule", body_of(capsule(0.25, 0.5)), {0, -1, 0}},
          {"prism on its end", hull_body(true, 0), {0, 0, -1}},
          {"rounded prism", hull_body(true, 0.0625), {0, 0, -1}}};
}

/// The number of points whose features are new in the manifold or have disappeared from it.
int changes(const ContactManifold& from, const ContactManifold& to) {
  int count = 0;
  for (uint32_t i = 0; i < from.count; ++i) {
    bool kept = false;
    for (uint32_t k = 0; k < to.count; ++k) kept = kept || from.point[i].feature == to.point[k].feature;
    count += kept ? 0 : 1;
  }
  return count + (from.count > to.count ? 0 : static_cast<int>(to.count - from.count));
}

DETENT_TEST(contact, keeps_its_features_while_a_pair_at_rest_trembles) {
  const uint32_t frames = detent_oracle::rounds(1000) < 1000 ? 200 : 1000;
  Samples samples{11};
  std::vector<Resting> grounds = {{"half-space", {}, {0, 1, 0}},
                                  {"broad box", body_of(box({4, 1, 3})), {0, 1, 0}},
                                  {"prism's end", hull_body(true, 0), {0, 0, 1}},
                                  {"prism's side", hull_body(true, 0), {}},
                                  {"cylinder", body_of(cylinder(2, 1)), {0, 1, 0}}};
  EXPECT_OK(make_convex(half_space(), grounds[0].body.convex));
  const HullPlane side = hull_of(grounds[3].body.convex).plane(0);
  grounds[3].face = arrow(Vec32{side.normal[0], side.normal[1], side.normal[2]}) * 0x1p-30;
  int scenes = 0, changed = 0;
  const auto tremble = [&](const Resting& ground, const Resting& thing, double gap, const Arrow& aside, bool same_turn,
                           bool aligned = false) {
    const Placement at_a = same_turn ? placement({0, 0, 0}, 0, 0, 0, 1) : random_placement(samples, {0.25, -1, 3});
    const Arrow& f = ground.face;
    const Arrow up = at_a.axis[0] * f.x + at_a.axis[1] * f.y + at_a.axis[2] * f.z;
    const Placement still = aligned ? at_a : facing(samples, thing.face, -up, 0, same_turn);
    Arrow at = at_a.position + (aside - up * dot(aside, up));
    Placement probe = still;
    probe.position = at;
    at = at + up * (gap - (dot(up, at - at_a.position) - support_along(ground.body, at_a, up) -
                           support_along(thing.body, probe, -up)));
    const Quat& q = still.rotation;
    ContactManifold first;
    int worst = 0;
    for (uint32_t frame = 0; frame < frames; ++frame) {
      const Arrow shift = random_direction(samples) * 1e-6, t = random_direction(samples) * 0.5e-6;
      const double x = unit_to_host(q.x), y = unit_to_host(q.y), z = unit_to_host(q.z), w = unit_to_host(q.w);
      const Placement now = placement(at + shift, x + t.x * w + t.y * z - t.z * y, y + t.y * w + t.z * x - t.x * z,
                                      z + t.z * w + t.x * y - t.y * x, w - t.x * x - t.y * y - t.z * z);
      ContactManifold manifold;
      ASSERT_OK(contact_points(ground.body.convex, at_a.pose(), thing.body.convex, now.pose(), real(0.02), manifold));
      if (frame == 0) first = manifold;
      worst = std::max(worst, changes(first, manifold));
      ASSERT_GT(dot(unit_arrow(manifold.normal), up), 0.9999);
    }
    ++scenes;
    changed += worst != 0 ? 1 : 0;
    EXPECT_EQ(worst, 0) << thing.name << " on " << ground.name << ", gap " << gap;
    EXPECT_GT(first.count, 0u) << thing.name << " on " << ground.name << ", gap " << gap;
  };
  for (const double gap : {-1e-3, 0.0, 1e-5}) {
    for (const Resting& ground : grounds) {
      for (const Resting& thing : things_at_rest()) {
        tremble(ground, thing, gap, {0, 0, 0}, true);
        tremble(ground, thing, gap, random_direction(samples) * 0.1, false);
      }
    }
    for (const Resting& thing : things_at_rest()) {  // on its like, flush
      Resting ground = thing;
      ground.face = -thing.face;
      if (thing.body.convex.type == ShapeType::box || thing.body.convex.type == ShapeType::hull) {
        tremble(ground, thing, gap, {0, 0, 0}, true);
      }
    }
  }
  // A triangle at the corner of a box's face, flush with two of its sides.
  Resting corner = {"triangle", {}, {0, -1, 0}};
  const Resting box_below = {"box", body_of(box({0.5, 0.25, 0.375})), {0, 1, 0}};
  corner.body.points = {{0.5, 0, 0.375}, {0.5, 0, -0.125}, {-0.25, 0, 0.375}};
  const Vec3<Real> corners[3] = {{0.5, 0.0, 0.375}, {0.5, 0.0, -0.125}, {-0.25, 0.0, 0.375}};
  EXPECT_OK(make_triangle(corners, 0.0, corner.body.convex));
  for (int i = 0; i < 10; ++i) tremble(box_below, corner, i % 2 == 0 ? 0.0 : -1e-5, {0, 0, 0}, false, true);
  printf("%d scenes of %u frames, features changed in %d\n", scenes, frames, changed);
}

DETENT_TEST(contact, with_a_half_space_is_where_the_shape_reaches_lowest) {
  Samples samples{13};
  Body ground;
  EXPECT_OK(make_convex(half_space(), ground.convex));
  for (const ShapeType type : k_types) {
    double above_max = 0;
    uint32_t points = 0;
    for (uint32_t i = 0; i < detent_oracle::rounds(5000); ++i) {
      const Body body = random_body(samples, type);
      Placement at_ground = random_placement(samples, random_direction(samples) * uniform(samples, 0, 1000));
      settle(at_ground);
      const Arrow up = at_ground.axis[1];
      Placement at = random_placement(samples, {0, 0, 0});
      if (samples.below(2) == 0) {
        at = facing(samples, random_face(body, samples), -up, uniform(samples, 0, 0.6), false);
      }
      const Arrow aside = cross(up, random_direction(samples)) * 500;
      const double height = support_along(body, at, -up);
      at.position = at_ground.position + aside + up * (height + uniform(samples, -0.3, 0.06));
      settle(at);
      const double separation = dot(up, at.position - at_ground.position) - height;
      if (fabs(separation - 0.05) < 1e-4) continue;
      ContactManifold manifold;
      const bool plane_is_a = samples.below(2) == 0;
      ASSERT_OK(plane_is_a
                    ? contact_points(ground.convex, at_ground.pose(), body.convex, at.pose(), real(0.05), manifold)
                    : contact_points(body.convex, at.pose(), ground.convex, at_ground.pose(), real(0.05), manifold));
      constexpr double k_far = sizeof(Real) == 4 ? 2e-4 : 3e-6;  // rotations of 2^-30, or a float, over 500 m
      ASSERT_EQ(manifold.count > 0, separation <= 0.05);
      if (manifold.count == 0) continue;
      ASSERT_LT(length(unit_arrow(manifold.normal) - up * (plane_is_a ? 1 : -1)), 1e-6);
      double least = HUGE_VAL;
      points += manifold.count;
      for (uint32_t k = 0; k < manifold.count; ++k) {
        const ManifoldPoint& point = manifold.point[k];
        least = std::min(least, to_host(point.separation));
        for (uint32_t m = 0; m < k; ++m) ASSERT_NE(point.feature, manifold.point[m].feature);
        const Arrow from_ground = arrow(plane_is_a ? point.from_a : point.from_b);
        const Arrow from_body = arrow(plane_is_a ? point.from_b : point.from_a);
        ASSERT_NEAR(dot(up, from_ground), to_host(point.separation) / 2, k_far);
        ASSERT_LT(length(from_ground + at_ground.position - from_body - at.position), 1e-4);
        const Arrow on_body = from_body + up * (to_host(point.separation) / 2);
        for (int m = 0; m < 20; ++m) {
          const Arrow d = random_direction(samples);
          ASSERT_LE(dot(d, on_body) - support_along(body, at, d), k_far);
        }
      }
      ASSERT_GE(least, separation - k_far);
      above_max = std::max(above_max, (least - separation - k_far) / body.size);
    }
    printf("%u: %u points, the deepest at most %.1e of size too high\n", static_cast<uint32_t>(type), points,
           above_max);
    EXPECT_LE(above_max, 0x1p-10);
  }
}

DETENT_TEST(contact, keeps_the_deepest_of_many_points_in_place_of_the_nearest) {
  AreaChoice choice(1000, 10, ManifoldReduction::projected_extremes);
  constexpr int64_t k_ring[12][2] = {{100, 0},  {87, 50},   {50, 87},   {0, 100},  {-50, 87}, {-87, 50},
                                     {-100, 0}, {-87, -50}, {-50, -87}, {0, -100}, {50, -87}, {87, -50}};
  const auto ring = [&](int64_t low) {
    AreaChoice made(1000, 10, ManifoldReduction::projected_extremes);
    for (uint8_t i = 0; i < 12; ++i) {
      made.add({k_ring[i][0], k_ring[i][1], i == 0 ? low : 0, AreaPoint::Kind::vertex, i, 0});
    }
    EXPECT_FALSE(made.again());
    EXPECT_EQ(made.count(), 4);
    return made;
  };
  const AreaChoice level = ring(0), trembling = ring(-10), tilted = ring(-11);
  int kept = 0;
  bool has_deepest = false;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(level[i].incident, trembling[i].incident);
    EXPECT_NE(level[i].incident, 0);
    kept += level[i].incident == tilted[i].incident ? 1 : 0;
    has_deepest = has_deepest || tilted[i].incident == 0;
  }
  EXPECT_EQ(kept, 3);
  EXPECT_TRUE(has_deepest);
}

DETENT_TEST(contact, keeps_the_deepest_and_the_largest_area_where_that_is_asked_for) {
  Samples samples{18};
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    std::vector<AreaPoint> points;
    const uint32_t count = 5 + samples.below(20);
    const int length = 4 + static_cast<int>(samples.below(26));
    const bool on_a_line = samples.below(8) == 0;
    for (uint32_t k = 0; k < count; ++k) {
      const int64_t u = samples.integer(length), v = on_a_line ? u : samples.integer(length);
      points.push_back({u, v, samples.integer(8), AreaPoint::Kind::vertex, static_cast<uint8_t>(k), 0});
    }
    AreaChoice choice(INT64_MAX, 0, ManifoldReduction::deepest_area);
    do {
      for (const AreaPoint& point : points) choice.add(point);
    } while (choice.again());
    const AreaChoice& chosen = choice;
    const int kept = choice.count();
    ASSERT_GE(kept, 1);
    const auto distance = [](const AreaPoint& p, const AreaPoint& q) {
      return hypot(static_cast<double>(p.u - q.u), static_cast<double>(p.v - q.v));
    };
    const auto area = [](const AreaPoint& p, const AreaPoint& q, const AreaPoint& r) {
      return static_cast<double>(q.u - p.u) * static_cast<double>(r.v - p.v) -
             static_cast<double>(q.v - p.v) * static_cast<double>(r.u - p.u);
    };
    constexpr double k_less = 1 - 1e-9;
    const double triangle = kept > 2 ? area(chosen[0], chosen[1], chosen[2]) : 0;
    const auto beyond = [&](const AreaPoint& p) {
      double most = 0;
      for (int side = 0; side < 3; ++side) {
        const double inside = area(chosen[side], chosen[(side + 1) % 3], p);
        most = fmax(most, triangle > 0 ? -inside : inside);
      }
      return most;
    };
    for (const AreaPoint& point : points) {
      EXPECT_GE(point.w, chosen[0].w);
      if (kept > 1) {
        EXPECT_LE(distance(chosen[0], point) * k_less, distance(chosen[0], chosen[1]));
      }
      EXPECT_LE(kept > 2 ? fabs(area(chosen[0], chosen[1], point)) * k_less : 0, fabs(triangle));
      EXPECT_LE(kept > 2 ? beyond(point) * k_less : 0, kept > 3 ? beyond(chosen[3]) : 0);
    }
    if (on_a_line) {
      EXPECT_LE(kept, 2);
    }
  }
}

DETENT_TEST(contact, scales_exactly_by_powers_of_two) {
  Samples samples{17};
  uint32_t compared = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    const auto size = [&] { return ldexp(static_cast<double>((1 << 14) + samples.below(1 << 20)), -20); };
    const double x = size(), y = size(), z = size(), r = size(), h = size(), rounding = size() / 8;
    const bool upright = samples.below(2) == 0;
    const Placement at_a = random_placement(samples, {0, 0, 0});
    Placement at_b = upright ? at_a : random_placement(samples, {0, 0, 0});
    const uint32_t kind = samples.below(3);
    const auto step = [&] { return ldexp(static_cast<double>(1 + samples.below(1 << 12)), -12); };
    const Arrow at = {step(), step(), step()};
    ContactManifold manifold[2];
    for (int scaled = 0; scaled < 2; ++scaled) {
      const double s = scaled == 0 ? 1 : 16;
      Convex a, b;
      ASSERT_OK(make_convex(rounded(box({real(s * x), real(s * y), real(s * z)}), real(s * rounding)), a));
      ASSERT_OK(make_convex(kind == 0   ? cylinder(real(s * r), real(s * h))
                            : kind == 1 ? capsule(real(s * r), real(s * h))
                                        : box({real(s * r), real(s * h), real(s * x)}),
                            b));
      at_b.position = at * s;
      ASSERT_OK(contact_points(a, at_a.pose(), b, at_b.pose(), real(s * 0.125), manifold[scaled]));
    }
    ASSERT_EQ(manifold[0].count, manifold[1].count);
    compared += manifold[0].count;
    for (uint32_t k = 0; k < manifold[0].count; ++k) {
      const ManifoldPoint &p = manifold[0].point[k], &q = manifold[1].point[k];
      ASSERT_EQ(p.feature, q.feature);
      ASSERT_EQ(16 * to_host(p.separation), to_host(q.separation));
      // Balls are added in steps of 2^-46 m.
      ASSERT_LT(length(arrow(p.from_a) * 16 - arrow(q.from_a)), 16 * (DETENT_FIXED ? 0x1p-44 : 1e-6));
      ASSERT_LT(length(arrow(p.from_b) * 16 - arrow(q.from_b)), 16 * (DETENT_FIXED ? 0x1p-44 : 1e-6));
    }
  }
  EXPECT_GT(compared, detent_oracle::rounds(2000) / 2);
}

DETENT_TEST(contact, of_stacked_boxes_and_of_crossed_and_parallel_edges_is_as_drawn) {
  Convex cube, rod;
  ASSERT_OK(make_convex(box({0.5, 0.5, 0.5}), cube));
  ASSERT_OK(make_convex(capsule(0.25, 1.0), rod));
  const Placement origin = turned({0, 0, 0}, {0, 0, 0});
  ContactManifold manifold;
  // One cube above the other, with a gap of 1/8.
  ASSERT_OK(contact_points(cube, origin.pose(), cube, turned({0, 1.125, 0}, {0, 0, 0}).pose(), 0.25, manifold));
  ASSERT_EQ(manifold.count, 4u);
  EXPECT_TRUE(manifold.normal == (Vec3<Unit>{0.0, 1.0, 0.0}));
  for (uint32_t i = 0; i < 4; ++i) {
    const ManifoldPoint& p = manifold.point[i];
    EXPECT_NEAR(to_host(p.separation), 0.125, 1e-8);
    EXPECT_NEAR(to_host(p.from_a.y), 0.5625, 1e-8);
    EXPECT_NEAR(fabs(to_host(p.from_a.x)), 0.5, 1e-8);
    EXPECT_NEAR(fabs(to_host(p.from_a.z)), 0.5, 1e-8);
    EXPECT_NEAR(to_host(p.from_b.y), -0.5625, 1e-8);
  }
  ASSERT_OK(contact_points(cube, origin.pose(), cube, turned({0, 1.125, 0}, {0, 0, 0}).pose(), 0.0625, manifold));
  EXPECT_EQ(manifold.count, 0u);
  // Touching exactly, at a face, an edge and a vertex; and one inside the other.
  for (const Arrow& at : {Arrow{1, 0, 0}, Arrow{1, 1, 0}, Arrow{1, 1, 1}}) {
    ASSERT_OK(contact_points(cube, origin.pose(), cube, turned(at, {0, 0, 0}).pose(), 0.0, manifold));
    ASSERT_GT(manifold.count, 0u);
    for (uint32_t i = 0; i < manifold.count; ++i) EXPECT_NEAR(to_host(manifold.point[i].separation), 0, 1e-8);
  }
  ASSERT_OK(contact_points(cube, origin.pose(), cube, origin.pose(), 0.0, manifold));
  ASSERT_EQ(manifold.count, 4u);
  EXPECT_NEAR(to_host(manifold.point[0].separation), -1, 1e-8);
  // Two rods: crossed, parallel, and end to end.
  constexpr double k_quarter = 1.5707963267948966;
  ASSERT_OK(contact_points(rod, origin.pose(), rod, turned({0.375, 0, 0}, {k_quarter, 0, 0}).pose(), 0.0, manifold));
  ASSERT_EQ(manifold.count, 1u);
  EXPECT_NEAR(to_host(manifold.point[0].separation), -0.125, 1e-8);
  EXPECT_NEAR(to_host(manifold.point[0].from_a.x), 0.1875, 1e-8);
  ASSERT_OK(contact_points(rod, origin.pose(), rod, turned({0.375, 0.5, 0}, {0, 0, 0}).pose(), 0.0, manifold));
  ASSERT_EQ(manifold.count, 2u);
  for (uint32_t i = 0; i < 2; ++i) EXPECT_NEAR(to_host(manifold.point[i].separation), -0.125, 1e-8);
  EXPECT_NEAR(fabs(to_host(manifold.point[0].from_a.y) - to_host(manifold.point[1].from_a.y)), 1.5, 0.02);
  ASSERT_OK(contact_points(rod, origin.pose(), rod, turned({0, 2.375, 0}, {0, 0, 0}).pose(), 0.0, manifold));
  ASSERT_EQ(manifold.count, 1u);
  EXPECT_NEAR(to_host(manifold.point[0].separation), -0.125, 1e-8);
  EXPECT_NEAR(unit_to_host(manifold.normal.y), 1, 1e-8);
}

DETENT_TEST(contact, of_planks_that_cross_edge_on_edge_by_a_little_is_of_their_faces) {
  Samples samples{23};
  Convex plank;
  ASSERT_OK(make_convex(box({1.0, 0.125, 0.125}), plank));
  const Body body = body_of(box({1.0, 0.125, 0.125}));
  for (int i = 0; i < 200; ++i) {
    const auto roll = [&] { return uniform(samples, 0.0002, 0.0008) * (samples.below(2) == 0 ? 1 : -1); };
    const Placement at_a = turned({0, 0, 0}, {roll(), 0, 0});
    const double half = 0.78539816339744831, r = roll() / 2;  // a quarter turn about y, then rolled about z
    const Placement probe = placement({0, 0, 0}, -r * sin(half), sin(half), r * cos(half), cos(half));
    const Arrow up = {0, 1, 0};
    const double height = support_along(body, at_a, up) + support_along(body, probe, -up);
    const Placement at_b = placement({0, height + uniform(samples, -0.01, 0.0005), 0}, -r * sin(half), sin(half),
                                     r * cos(half), cos(half));
    ContactManifold manifold;
    ASSERT_OK(contact_points(plank, at_a.pose(), plank, at_b.pose(), 0.0625, manifold));
    ASSERT_EQ(manifold.count, 4u) << i;
  }
}

DETENT_TEST(contact, along_rods_that_are_not_quite_parallel_follows_them) {
  Convex rod;
  ASSERT_OK(make_convex(capsule(0.25, 1.0), rod));
  const Placement origin = turned({0, 0, 0}, {0, 0, 0});
  constexpr double k_tilt = 0.02;
  for (const double side : {-1.0, 1.0}) {
    ContactManifold manifold;
    // Pitched: one end of the rod is nearer than the other.
    const Placement pitched = turned({0.4 * side, 0, 0}, {0, 0, k_tilt});
    ASSERT_OK(contact_points(rod, origin.pose(), rod, pitched.pose(), 0.0, manifold));
    ASSERT_EQ(manifold.count, 2u);
    for (uint32_t i = 0; i < 2; ++i) {
      const ManifoldPoint& p = manifold.point[i];
      const double along = to_host(p.from_a.y), between = 0.4 * side - sin(k_tilt) * along;
      EXPECT_NEAR(fabs(along), 1, 0.03);
      EXPECT_NEAR(to_host(p.separation), fabs(between) - 0.5, 2e-4);
      EXPECT_NEAR(to_host(p.from_a.x), between / 2, 1e-3);
    }
    // Twisted: the midpoint between the rods is at half the lateral distance of the other rod.
    const Placement twisted = turned({0.4 * side, 0, 0}, {k_tilt, 0, 0});
    ASSERT_OK(contact_points(rod, origin.pose(), rod, twisted.pose(), 0.0, manifold));
    ASSERT_EQ(manifold.count, 2u);
    for (uint32_t i = 0; i < 2; ++i) {
      const ManifoldPoint& p = manifold.point[i];
      EXPECT_NEAR(to_host(p.separation), -0.1, 1e-4);
      EXPECT_NEAR(to_host(p.from_a.z), sin(k_tilt) * to_host(p.from_a.y) / 2, 1e-3);
    }
  }
}

DETENT_TEST(contact, has_a_sound_normal_where_the_cores_all_but_touch) {
  Samples samples{19};
  Convex ball, drum;
  ASSERT_OK(make_convex(sphere(0.25), ball));
  ASSERT_OK(make_convex(cylinder(0.5, 0.5), drum));
  for (int i = 0; i < 2000; ++i) {
    const double angle = uniform(samples, 0, 6.28);
    const Arrow displacement = {cos(angle), 0, sin(angle)};
    Placement at = turned(
        displacement * (0.5 + uniform(samples, -1e-8, 1e-8)) + Arrow{0, uniform(samples, -0.4, 0.4), 0}, {0, 0, 0});
    settle(at);
    const double apart = sqrt(at.position.x * at.position.x + at.position.z * at.position.z) - 0.5;
    ContactManifold manifold;
    ASSERT_OK(contact_points(drum, turned({0, 0, 0}, {0, 0, 0}).pose(), ball, at.pose(), 0.0, manifold));
    ASSERT_EQ(manifold.count, 1u);
    ASSERT_GT(dot(unit_arrow(manifold.normal), displacement), 0.9999);
    ASSERT_NEAR(to_host(manifold.point[0].separation), apart - 0.25, 1e-6);
  }
}

DETENT_TEST(contact, refuses_bad_arguments) {
  Convex ground, ball;
  ASSERT_OK(make_convex(half_space(), ground));
  ASSERT_OK(make_convex(sphere(0.5), ball));
  const Pose pose = turned({0, 0, 0}, {0, 0, 0}).pose();
  Pose bent = pose;
  bent.rotation.w = Unit(0.5);
  ContactManifold manifold;
  manifold.count = 3;
  EXPECT_EQ(contact_points(ground, pose, ground, pose, 0.0, manifold), Status::bad_argument);
  EXPECT_EQ(contact_points(ground, pose, ball, bent, 0.0, manifold), Status::not_normalised);
  EXPECT_EQ(contact_points(ground, pose, ball, pose, -0.5, manifold), Status::out_of_range);
  EXPECT_EQ(manifold.count, 3u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
