#pragma once
#include <detent/detail/scratch.h>

#include "math/arithmetic.h"
#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if defined(DETENT_F64)
inline constexpr Coord k_coord_limit = 0x1p1000;
#else
inline constexpr Coord k_coord_limit =
    Coord::from_raw(sizeof(Coord) == 8 ? static_cast<Coord::Raw>(INT64_MAX) : INT32_MAX);
#endif
inline constexpr Bounds k_everywhere = {{-k_coord_limit, -k_coord_limit, -k_coord_limit},
                                        {k_coord_limit, k_coord_limit, k_coord_limit}};

/// Half the size of the shape's axis-aligned bounds, m, world axes. Not for a half-space.
/// Rounding: within 2^-28 of the body's unit of length.
inline Vec3<Real> half_bounds(const BodyTraits& traits, const Matrix3& rotation) {
  const Unit zero = 0.0;
  Vec3<Unit> half = {zero, zero, zero};
  switch (static_cast<ShapeType>(traits.shape)) {
    case ShapeType::sphere:
      half = {traits.size.x, traits.size.x, traits.size.x};
      break;
    case ShapeType::capsule: {
      const Vec3<Unit>& axis = rotation.column[1];
      half = {abs(axis.x) * traits.size.y + traits.size.x, abs(axis.y) * traits.size.y + traits.size.x,
              abs(axis.z) * traits.size.y + traits.size.x};
      break;
    }
    case ShapeType::box: {
      const Vec3<Unit>&x = rotation.column[0], &y = rotation.column[1], &z = rotation.column[2];
      half = {dot(Vec3<Unit>{abs(x.x), abs(y.x), abs(z.x)}, traits.size),
              dot(Vec3<Unit>{abs(x.y), abs(y.y), abs(z.y)}, traits.size),
              dot(Vec3<Unit>{abs(x.z), abs(y.z), abs(z.z)}, traits.size)};
      break;
    }
    default:
      break;
  }
  return {real_from_unit(half.x, traits.size_exponent), real_from_unit(half.y, traits.size_exponent),
          real_from_unit(half.z, traits.size_exponent)};
}

inline bool overlap(const Bounds& a, const Bounds& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y &&
         a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
