#include "contact/contact_axis.h"

#include <algorithm>

#include "distance/penetration.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/contact/pairs.h"

/// The axis of cores that overlap, if one is a cylinder: by a smaller cylinder where that gives the same.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Quat k_unturned = {0.0, 0.0, 0.0, 1.0};

Convex convex_of(const Shape& shape) {
  Convex convex;
  EXPECT_OK(make_convex(shape, convex));
  return convex;
}

int32_t depth_by_polytope(const RestingPair& pair) {
  Simplex simplex;
  if (gjk(pair.a, pair.b, pair.offset, simplex, {}).outcome != GjkOutcome::overlap) return -1;
  const Penetration found = penetration(pair.a, pair.b, pair.offset, simplex);
  return found.capped ? -1 : found.depth;
}

DETENT_TEST(contact_axes, of_cylinders_are_those_of_least_penetration) {
  Samples samples = {77};
  uint32_t compared = 0;
  int64_t worst = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(4000); ++i) {
    const auto some = [&] { return real_near(uniform(samples, 0.2, 1)); };
    const Vec3<Real> size_a = {some(), some(), some()}, size_b = {some(), some(), some()};
    const Convex a = convex_of(cylinder(size_a.x, size_a.y));
    const Convex b = convex_of(i % 2 == 0 ? cylinder(size_b.x, size_b.y) : box(size_b));
    // Half of the pairs are level with each other, as bodies that rest.
    const Quat turned = i % 4 < 2 ? rotation_near(any_rotation(samples)) : k_unturned;
    const auto within = [&] { return uniform(samples, -1.6, 1.6); };
    const Vector at = {{within(), within(), within()}};
    RestingPair pair;
    ASSERT_OK(rest(a, {{0.0, 0.0, 0.0}, k_unturned}, b, {position_near(at), turned}, pair));
    const int32_t depth = depth_by_polytope(pair);
    if (depth < 0) continue;
    ContactAxis axis;
    ASSERT_TRUE(find_contact_axis(pair, INT32_MAX, nullptr, axis));
    ++compared;
    const int64_t more = -axis.separation - depth;
    worst = std::max(worst, more < 0 ? -more : more);
    // The points lie on the surfaces, as far apart as the axis says.
    const int64_t between = dot(axis.normal, subtract(add(pair.offset, axis.point_b), axis.point_a)) >> 30;
    EXPECT_NEAR(static_cast<double>(between), static_cast<double>(axis.separation), 0x1p14);
  }
  EXPECT_GT(compared, detent_oracle::rounds(4000) / 4);
  EXPECT_LE(worst, 1100);  // 2^-30 of the unit of length; 1,024 of them by the smaller cylinder
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
