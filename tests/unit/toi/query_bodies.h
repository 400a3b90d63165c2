#pragma once
#include "tests/bench/cooked.h"
#include "tests/common/queries/query.h"
#include "tests/unit/distance/bodies_at.h"

/// Converts the solids and paths of the query sets to a configuration's types.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline Vector vector_of(const detent_queries::Triple& v) { return {{v[0], v[1], v[2]}}; }

inline Convex convex_of(const detent_queries::Solid& solid) {
  using detent_queries::Kind;
  const Real radius = real(solid.radius), half_length = real(solid.half_length), rounding = real(solid.rounding);
  Convex convex;
  switch (solid.kind) {
    case Kind::sphere:
      EXPECT_OK(make_convex(sphere(radius), convex));
      break;
    case Kind::capsule:
      EXPECT_OK(make_convex(capsule(radius, half_length), convex));
      break;
    case Kind::box:
      EXPECT_OK(make_convex(rounded(box(reals(vector_of(solid.half_extents))), rounding), convex));
      break;
    case Kind::cylinder:
      EXPECT_OK(make_convex(rounded(cylinder(radius, half_length), rounding), convex));
      break;
    case Kind::cone:
      EXPECT_OK(make_convex(rounded(cone(radius, half_length), rounding), convex));
      break;
    case Kind::half_space:
      EXPECT_OK(make_convex(half_space(), convex));
      break;
    case Kind::hull: {
      const detent_bench::CookedHull& cooked = detent_bench::cooked_hull(solid.points);
      const Asset asset = {reinterpret_cast<const uint8_t*>(cooked.words.data()), cooked.byte_count};
      EXPECT_OK(make_hull(asset, rounding, convex));
      break;
    }
    case Kind::triangle: {
      const Vec3<Real> corners[3] = {reals(vector_of(solid.points[0])), reals(vector_of(solid.points[1])),
                                     reals(vector_of(solid.points[2]))};
      EXPECT_OK(make_triangle(corners, rounding, convex));
      break;
    }
  }
  return convex;
}

inline BodyAt body_of(const detent_queries::Path& path) {
  const std::array<double, 4>& q = path.rotation;
  return {vector_of(path.position), normalised(Quaternion{q[0], q[1], q[2], q[3]}), vector_of(path.displacement),
          vector_of(path.rotation_vector)};
}

/// The query with its positions on the configuration's grid. Where the grid is coarse, this rounded query is tested and
/// compared.
inline detent_queries::Query on_grid(detent_queries::Query query) {
  if (k_config == Config::f64) return query;
  for (detent_queries::Path* path : {&query.path_a, &query.path_b}) {
    for (double& coordinate : path->position) coordinate = round(coordinate / k_position_step) * k_position_step;
  }
  return query;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
