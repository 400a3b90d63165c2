#include "distance/support.h"

#include "math/root.h"
#include "shape/hull.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Returns the point of a disc's rim that is farthest along `direction`. The disc is perpendicular to the y axis, at
/// height `y`.
CorePoint rim_point(int32_t radius, int32_t y, const Vec32& direction) {
  if ((direction.x | direction.z) == 0) return {{0, y, 0}, k_no_feature};
  // Scaled, because the rounded length of a short vector would be too coarse.
  const Vec32 across = scaled_to_30_bits(Vec32{direction.x, 0, direction.z});
  const int64_t length = length_across(across);
  const auto part = [&](int32_t a) {
    const int64_t product = int64_t{radius} * a;
    const int64_t half = length / 2;
    return static_cast<int32_t>((product + (product < 0 ? -half : half)) / length);
  };
  return {{part(across.x), y, part(across.z)}, k_no_feature};
}

Vec32 corner_of(const Convex& triangle, int i) {
  return {triangle.corner[i][0], triangle.corner[i][1], triangle.corner[i][2]};
}

CorePoint capsule_end(const Convex& capsule, bool back) {
  return {{0, back ? -capsule.size[1] : capsule.size[1], 0}, static_cast<uint8_t>(back ? 1 : 0)};
}

CorePoint hull_vertex(const HullView& hull, uint32_t i) {
  return {{hull.x(i), hull.y(i), hull.z(i)}, static_cast<uint8_t>(i)};
}

/// Hill climbing: moves to the farthest neighbour while a neighbour lies farther than the current vertex. On a convex
/// hull the last vertex is the farthest of all.
uint32_t climb(const HullView& hull, const HullHeights& heights, uint32_t start) {
  uint32_t best = start < hull.vertex_count ? start : 0, last = best;
  int64_t best_value = heights.of(best);
  for (uint32_t step = 0; step < hull.vertex_count; ++step) {
    const HullIndices around = hull.neighbours(best);
    uint32_t next = best;
    for (uint32_t k = 0; k < around.count; ++k) {
      const uint32_t i = around.index[k];
      if (i == last) continue;
      const int64_t value = heights.of(i);
      if (value > best_value) {
        best_value = value;
        next = i;
      }
    }
    if (next == best) break;
    last = best;
    best = next;
  }
  return best;
}

}  // namespace

CorePoint hull_support(const HullView& hull, const Vec32& direction, uint32_t start) {
  const HullHeights heights(hull, direction);
  if (hull.vertex_count > k_climbing_vertices) return hull_vertex(hull, climb(hull, heights, start));
  uint32_t best = 0;
  int64_t best_value = INT64_MIN;
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const int64_t value = heights.of(i);
    if (value > best_value) {
      best_value = value;
      best = i;
    }
  }
  return hull_vertex(hull, best);
}

bool core_vertex(const Convex& convex, uint8_t feature, CorePoint& point) {
  switch (convex.type) {
    case ShapeType::sphere:
      point = {{0, 0, 0}, 0};
      return feature == 0;
    case ShapeType::capsule:
      point = capsule_end(convex, feature == 1);
      return feature < 2;
    case ShapeType::box:
      point = box_vertex(convex, -(feature & 1), -(feature >> 1 & 1), -(feature >> 2 & 1));
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

CorePoint local_support(const Convex& convex, const HullView& hull, const Vec32& direction, uint8_t start) {
  const int32_t* size = convex.size;
  switch (convex.type) {
    case ShapeType::capsule:
      return capsule_end(convex, direction.y < 0);
    case ShapeType::box:
      return box_vertex(convex, direction.x >> 31, direction.y >> 31, direction.z >> 31);
    case ShapeType::cylinder:
      return rim_point(size[0], direction.y < 0 ? -size[1] : size[1], direction);
    case ShapeType::cone: {
      const int64_t across = length_across(direction);
      if (2 * int64_t{size[1]} * direction.y >= int64_t{size[0]} * across) {
        return {{0, size[1] + size[1] / 2, 0}, k_no_feature};
      }
      return rim_point(size[0], -(size[1] / 2), direction);
    }
    case ShapeType::hull:
      return hull_support(hull, direction, start);
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
    case ShapeType::terrain:
    case ShapeType::compound:
      break;
  }
  return {{0, 0, 0}, 0};
}

SupportValue support_value(const Convex& convex, const HullView& hull, const Vec32& direction, const Vec32& rate,
                           uint8_t& start) {
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
      const CorePoint point = local_support(convex, hull, direction, start);
      start = point.feature;
      return {dot(direction, point.local), dot(rate, point.local)};
    }
  }
}

Placed place(const Convex& convex, const Matrix32& rotation, int pair_exponent) {
  Placed placed;
  placed.convex = &convex;
  placed.hull = hull_of(convex);
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

Vec32 Placed::other_point(const Vec32& local) const {
  switch (convex->type) {
    case ShapeType::sphere:
    case ShapeType::half_space:
      return {0, 0, 0};
    case ShapeType::capsule:
      return local.y < 0 ? negate(axis[1]) : axis[1];
    default:
      return turned(local);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
