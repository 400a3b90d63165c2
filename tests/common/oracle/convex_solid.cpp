#include "tests/common/oracle/convex_solid.h"

#include <algorithm>

namespace detent_oracle {

using detent_queries::Kind;

namespace {

Arrow arrow_of(const detent_queries::Triple& v) { return {v[0], v[1], v[2]}; }
/// Exact for the neighbouring numbers that matter; else to 2^-64 of the result.
Arrow difference(const detent_queries::Triple& b, const detent_queries::Triple& a) { return arrow_of(b) - arrow_of(a); }

}  // namespace

Arrow turned(const Arrow& v, const Arrow& rotation_vector) {
  const Number angle = length(rotation_vector);
  if (angle == 0) return v;
  const Arrow axis = rotation_vector * (1 / angle);
  const Number half_sine = sinl(angle / 2);
  const Arrow across = cross(axis, v);
  return v + across * sinl(angle) + cross(axis, across) * (2 * half_sine * half_sine);
}

Frame frame_of(const std::array<double, 4>& rotation) {
  const Number x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
  const Number s = 2 / (x * x + y * y + z * z + w * w);
  return {{{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
           {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
           {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}}};
}

ConvexSolid solid_of(const detent_queries::Solid& solid) {
  ConvexSolid result;
  const Number half = solid.half_length;
  result.rounding = solid.rounding;
  switch (solid.kind) {
    case Kind::sphere:
      result.points = {{0, 0, 0}};
      result.rounding = solid.radius;
      break;
    case Kind::capsule:
      result.points = {{0, half, 0}, {0, -half, 0}};
      result.rounding = solid.radius;
      break;
    case Kind::box:
      for (int i = 0; i < 8; ++i) {
        const Arrow h = arrow_of(solid.half_extents);
        result.points.push_back({(i & 1) != 0 ? h.x : -h.x, (i & 2) != 0 ? h.y : -h.y, (i & 4) != 0 ? h.z : -h.z});
      }
      break;
    case Kind::hull:
    case Kind::triangle:
      for (const auto& point : solid.points) result.points.push_back(arrow_of(point));
      break;
    case Kind::cylinder:
    case Kind::cone:
      result.core = solid.kind == Kind::cone ? CoreKind::cone : CoreKind::cylinder;
      result.radius = solid.radius;
      result.half_length = half;
      break;
    case Kind::half_space:
      result.core = CoreKind::half_space;
      break;
  }
  for (const Arrow& point : result.points) result.distance_max = std::max(result.distance_max, length(point));
  if (result.core == CoreKind::cylinder) result.distance_max = hypotl(result.radius, half);
  if (result.core == CoreKind::cone) result.distance_max = std::max(hypotl(result.radius, half / 2), 3 * half / 2);
  return result;
}

Number support_value(const ConvexSolid& solid, const Arrow& direction) {
  const Number across = sqrtl(direction.x * direction.x + direction.z * direction.z);
  switch (solid.core) {
    case CoreKind::cylinder:
      return solid.half_length * fabsl(direction.y) + solid.radius * across;
    case CoreKind::cone:
      return std::max(1.5L * solid.half_length * direction.y,
                      solid.radius * across - solid.half_length * direction.y / 2);
    case CoreKind::half_space:
      return 0;
    case CoreKind::points:
      break;
  }
  Number best = dot(solid.points[0], direction);
  for (const Arrow& point : solid.points) best = std::max(best, dot(point, direction));
  return best;
}

Number reach_from_line(const ConvexSolid& solid, const Arrow& line) {
  Number best = solid.core == CoreKind::points ? 0 : solid.distance_max;
  for (const Arrow& point : solid.points) best = std::max(best, length(cross(line, point)));
  return best;
}

Number size_of(const ConvexSolid& a, const ConvexSolid& b) {
  const Number core = 2 * std::max(a.distance_max, b.distance_max);
  return core > 0 ? core : 2 * std::max(a.rounding, b.rounding);
}

Encounter encounter_of(const detent_queries::Query& query) {
  Encounter result{solid_of(query.a),
                   solid_of(query.b),
                   frame_of(query.path_a.rotation),
                   frame_of(query.path_b.rotation),
                   difference(query.path_b.position, query.path_a.position),
                   difference(query.path_b.displacement, query.path_a.displacement),
                   arrow_of(query.path_a.rotation_vector),
                   arrow_of(query.path_b.rotation_vector),
                   0};
  result.size = size_of(result.a, result.b);
  return result;
}

Placement placement_at(const Encounter& encounter, Number time) {
  Placement result{encounter.frame_a, encounter.frame_b, encounter.offset + encounter.displacement * time};
  for (Arrow& axis : result.a.axis) axis = turned(axis, encounter.turn_a * time);
  for (Arrow& axis : result.b.axis) axis = turned(axis, encounter.turn_b * time);
  return result;
}

}  // namespace detent_oracle
