#include "proximity/support.h"

#include "geometry/hull.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The rim point of a disc of radius `radius` in the direction (x, z), at height y.
CorePoint rim_point(int32_t radius, int32_t y, const Vec32& direction, int64_t across) {
  if (across == 0) return {{0, y, 0}, k_no_feature};
  const auto part = [&](int32_t a) {
    const int64_t product = int64_t{radius} * a;
    const int64_t half = across / 2;
    return static_cast<int32_t>((product + (product < 0 ? -half : half)) / across);
  };
  return {{part(direction.x), y, part(direction.z)}, k_no_feature};
}

int64_t length_across(const Vec32& direction) {
  return square_root_nearest(static_cast<uint64_t>(int64_t{direction.x} * direction.x) +
                             static_cast<uint64_t>(int64_t{direction.z} * direction.z));
}

Vec32 corner_of(const Convex& triangle, int i) {
  return {triangle.corner[i][0], triangle.corner[i][1], triangle.corner[i][2]};
}

/// A box's vertex by the signs of its coordinates: bit i of the feature is set where coordinate i is negative.
CorePoint box_vertex(const Convex& box, bool x, bool y, bool z) {
  const int32_t* size = box.size;
  return {{x ? -size[0] : size[0], y ? -size[1] : size[1], z ? -size[2] : size[2]},
          static_cast<uint8_t>((x ? 1 : 0) | (y ? 2 : 0) | (z ? 4 : 0))};
}

CorePoint capsule_end(const Convex& capsule, bool back) {
  return {{0, back ? -capsule.size[1] : capsule.size[1], 0}, static_cast<uint8_t>(back ? 1 : 0)};
}

CorePoint hull_vertex(const HullView& hull, uint32_t i) {
  return {{hull.x(i), hull.y(i), hull.z(i)}, static_cast<uint8_t>(i)};
}

CorePoint hull_support(const HullView& hull, const Vec32& direction) {
  const int64_t dx = direction.x, dy = direction.y, dz = direction.z;
  const uint32_t count = hull.vertex_count;
  uint32_t best = 0;
  int64_t best_value = INT64_MIN;
  for (uint32_t i = 0; i < count; ++i) {
    const int64_t value = dx * hull.x(i) + dy * hull.y(i) + dz * hull.z(i);
    if (value > best_value) {
      best_value = value;
      best = i;
    }
  }
  return hull_vertex(hull, best);
}

}  // namespace

bool core_vertex(const Convex& convex, uint8_t feature, CorePoint& point) {
  switch (convex.type) {
    case ShapeType::sphere:
      point = {{0, 0, 0}, 0};
      return feature == 0;
    case ShapeType::capsule:
      point = capsule_end(convex, feature == 1);
      return feature < 2;
    case ShapeType::box:
      point = box_vertex(convex, (feature & 1) != 0, (feature & 2) != 0, (feature & 4) != 0);
      return feature < 8;
    case ShapeType::triangle:
      if (feature >= 3) return false;
      point = {corner_of(convex, feature), feature};
      return true;
    case ShapeType::hull:
      if (feature >= convex.vertex_count) return false;
      point = hull_vertex(hull_view(convex.hull), feature);
      return true;
    default:
      return false;
  }
}

CorePoint local_support(const Convex& convex, const Vec32& direction) {
  const int32_t* size = convex.size;
  switch (convex.type) {
    case ShapeType::capsule:
      return capsule_end(convex, direction.y < 0);
    case ShapeType::box:
      return box_vertex(convex, direction.x < 0, direction.y < 0, direction.z < 0);
    case ShapeType::cylinder:
      return rim_point(size[0], direction.y < 0 ? -size[1] : size[1], direction, length_across(direction));
    case ShapeType::cone: {
      const int64_t across = length_across(direction);
      if (2 * int64_t{size[1]} * direction.y >= int64_t{size[0]} * across) {
        return {{0, size[1] + size[1] / 2, 0}, k_no_feature};
      }
      return rim_point(size[0], -(size[1] / 2), direction, across);
    }
    case ShapeType::hull:
      return hull_support(hull_view(convex.hull), direction);
    case ShapeType::triangle: {
      int best = 0;
      int64_t best_value = INT64_MIN;
      for (int i = 0; i < 3; ++i) {
        const int64_t value = dot(corner_of(convex, i), direction);
        if (value > best_value) {
          best_value = value;
          best = i;
        }
      }
      return {corner_of(convex, best), static_cast<uint8_t>(best)};
    }
    case ShapeType::sphere:
    case ShapeType::half_space:
      break;
  }
  return {{0, 0, 0}, 0};
}

SupportValue support_value(const Convex& convex, const Vec32& direction, const Vec32& rate) {
  switch (convex.type) {
    case ShapeType::sphere:
    case ShapeType::half_space:
      return {0, 0};
    case ShapeType::capsule: {
      const int64_t y = direction.y < 0 ? -convex.size[1] : convex.size[1];
      return {y * direction.y, y * rate.y};
    }
    case ShapeType::box: {
      const int64_t x = direction.x < 0 ? -convex.size[0] : convex.size[0];
      const int64_t y = direction.y < 0 ? -convex.size[1] : convex.size[1];
      const int64_t z = direction.z < 0 ? -convex.size[2] : convex.size[2];
      return {x * direction.x + y * direction.y + z * direction.z, x * rate.x + y * rate.y + z * rate.z};
    }
    default: {
      const Vec32 point = local_support(convex, direction).local;
      return {dot(direction, point), dot(rate, point)};
    }
  }
}

Placed place(const Convex& convex, const Matrix32& rotation, int pair_exponent) {
  Placed placed;
  placed.convex = &convex;
  placed.rotation = rotation;
  placed.shift = pair_exponent - convex.exponent;
  DETENT_VERIFY_RANGE(placed.shift >= 0 || convex.core_radius == 0);
  if (convex.type == ShapeType::box || convex.type == ShapeType::capsule) {
    const int n = 30 + placed.shift;
    for (int i = 0; i < 3; ++i) {
      const Vec32& c = rotation.column[i];
      const int64_t size = convex.size[i];
      placed.axis[i] = n > 62 ? Vec32{0, 0, 0} : round_shift(Vec64{c.x * size, c.y * size, c.z * size}, n);
    }
  }
  return placed;
}

Vec32 Placed::point(const Vec32& local) const {
  switch (convex->type) {
    case ShapeType::sphere:
    case ShapeType::half_space:
      return {0, 0, 0};
    case ShapeType::capsule:
      return local.y < 0 ? negate(axis[1]) : axis[1];
    case ShapeType::box: {
      const Vec32 x = local.x < 0 ? negate(axis[0]) : axis[0];
      const Vec32 y = local.y < 0 ? negate(axis[1]) : axis[1];
      const Vec32 z = local.z < 0 ? negate(axis[2]) : axis[2];
      return add(add(x, y), z);
    }
    default:
      return shift > 32 ? Vec32{0, 0, 0} : round_shift(multiply(rotation, local), 30 + shift);
  }
}

SupportPoint support(const Placed& placed, const Vec32& direction) {
  const Convex& convex = *placed.convex;
  const Vec32* axis = placed.axis;
  CorePoint core;
  switch (convex.type) {
    case ShapeType::sphere:
    case ShapeType::half_space:
      core = {{0, 0, 0}, 0};
      break;
    case ShapeType::capsule:
      core = capsule_end(convex, dot(direction, axis[1]) < 0);
      break;
    case ShapeType::box:
      core = box_vertex(convex, dot(direction, axis[0]) < 0, dot(direction, axis[1]) < 0, dot(direction, axis[2]) < 0);
      break;
    default:
      core = local_support(convex, rotate_inverse(placed.rotation, direction));
      break;
  }
  return {placed.point(core.local), core};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
