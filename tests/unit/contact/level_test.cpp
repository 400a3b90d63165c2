#include "tests/unit/contact/ground.h"
#include "tests/unit/shape/levels.h"

/// Bodies against real levels.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A body of about `size`, m, near some place of the surface.
OracleBody body_near(Samples& samples, const Terrain& terrain, uint32_t kind, double size) {
  OracleBody body = body_of(kind == 0   ? sphere(real_near(0.4 * size))
                            : kind == 1 ? box(reals_near(Vector{{0.4, 0.25, 0.3}} * size))
                                        : capsule(real_near(0.25 * size), real_near(0.4 * size)));
  const TerrainTriangle t = terrain.triangle(samples.below(terrain.mesh.triangle_count));
  const double p = uniform(samples, 0, 1), q = uniform(samples, 0, 1 - p);
  Vector at = any_direction(samples) * (size * uniform(samples, 0.3, 0.9));
  const double weight[3] = {p, q, 1 - p - q}, step = ldexp(1.0, terrain.exponent() - 30);
  for (int k = 0; k < 3; ++k) {
    const Vec32& corner = t.corner[k];
    at = at + Vector{{corner.x * step, corner.y * step, corner.z * step}} * weight[k];
  }
  body.pose.position = position_near(at);
  body.pose.rotation = rotation_near(any_rotation(samples));
  return body;
}

DETENT_TEST(level, bodies_beside_real_levels_are_as_far_from_them_as_from_the_nearest_triangle) {
  uint32_t met = 0, levels = 0;
  for (const char* name : detent_terrains::k_levels) {
    Source source;
    if (!detent_terrains::read_level(name, source)) continue;
    ++levels;
    const Ground level(source);
    const double size = level.terrain.exponent() > 8 ? 100 : 1, distance_max = 0.1 * size;
    Samples samples = {37};
    for (uint32_t n = 0; n < detent_oracle::rounds(100); ++n) {
      const OracleBody body = body_near(samples, level.terrain, n % 3, size);
      const TerrainContacts contacts = contacts_of(level, body, distance_max);
      EXPECT_FALSE(contacts.capped);
      Vector normal{};
      const double right = distance_from(level, body, normal, 2 * size);
      if (right <= 0 || right > 0.99 * distance_max) continue;
      ++met;
      ASSERT_GE(contacts.count, 1u) << name << " " << n;
      EXPECT_NEAR(deepest_of(contacts), right, 0.005 * size) << name << " " << n;
      bool found = false;
      for (uint32_t i = 0; i < contacts.count; ++i) {
        found = found || dot(host(contacts.contact[i].geometry.normal), normal) > 0.98;
      }
      EXPECT_TRUE(found) << name << " " << n;
    }
  }
  if (levels == 0) GTEST_SKIP() << "no meshes under DETENT_DATA";
  EXPECT_EQ(levels, 5u);
  EXPECT_GT(met, 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
