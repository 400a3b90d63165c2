#include "tests/common/queries/aim.h"

#include <utility>

#include "tests/common/oracle/convex_solid.h"
#include "tests/common/queries/solids.h"

namespace detent_queries {

namespace {

constexpr double k_flat = 1e-9;  ///< of a way's length: what rises by less lies in the plane

detent_oracle::Arrow arrow_of(const Triple& v) { return {v[0], v[1], v[2]}; }
Triple triple_of(const detent_oracle::Arrow& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The plane with this normal that lies on the hull at `corner` tilts towards `tilt`: the vertex that it comes to, and
/// its normal there (gift wrapping). False if it comes to none.
bool wrap(const std::vector<Triple>& vertices, const Triple& corner, const Triple& tilt, Triple& normal,
          Triple& found) {
  double least = INFINITY;
  for (const Triple& vertex : vertices) {
    const Triple displacement = vertex - corner;
    const double rise = dot(tilt, displacement);
    if (rise <= k_flat * length(tilt) * length(displacement)) continue;
    const double rotation_vector = -dot(normal, displacement) / rise;
    if (rotation_vector >= least) continue;
    least = rotation_vector;
    found = vertex;
  }
  if (least == INFINITY) return false;
  normal = normal + tilt * least;
  return true;
}

}  // namespace

Triple point_facing(Random& random, const Solid& solid, const Triple& direction, uint32_t corners) {
  const std::vector<Triple> vertices = vertices_of(solid);
  Triple corner[3] = {vertices[0]};
  for (const Triple& vertex : vertices) {
    if (dot(direction, vertex) > dot(direction, corner[0])) corner[0] = vertex;
  }
  Triple normal = direction;
  for (uint32_t i = 1; i < corners; ++i) {
    const Triple tilt = i == 1 ? random.perpendicular(normal) : cross(corner[1] - corner[0], normal);
    if (!wrap(vertices, corner[0], tilt, normal, corner[i])) wrap(vertices, corner[0], tilt * -1, normal, corner[i]);
  }
  Triple point = corner[0];
  for (uint32_t i = 1; i < corners; ++i) point = point + (corner[i] - point) * random.uniform(0, 1);
  return point;
}

Meeting aim_at_feature(Random& random, Query& query, bool edges, const Aim& aim) {
  const double bounds = bound_of(query.a) + bound_of(query.b);
  const Triple direction = random.direction();
  const double distance = bounds + aim.scale * random.uniform(aim.gap_min, aim.gap_max);
  query.path_b.position = to_float(query.path_a.position + direction * distance);
  const Triple apart = query.path_b.position - query.path_a.position;

  Meeting meeting;
  meeting.time = random.uniform(0.4, 1.3);
  const detent_oracle::Placement placement = placement_at(detent_oracle::encounter_of(query), meeting.time);
  uint32_t corners_a = 2;
  if (!edges) corners_a = random.chance(0.5) ? 1 : 3;
  const Triple towards_b = triple_of(to_local(placement.a, arrow_of(direction)));
  const Triple towards_a = triple_of(to_local(placement.b, arrow_of(direction * -1)));
  meeting.point_a = point_facing(random, query.a, towards_b, corners_a);
  meeting.point_b = point_facing(random, query.b, towards_a, 4 - corners_a);
  const Triple sideways = random.perpendicular(apart);
  if (random.chance(0.5)) meeting.beside = bounds * random.log_uniform(1e-3, 1);

  const Triple from_a = triple_of(to_world(placement.a, arrow_of(meeting.point_a)));
  const Triple from_b = triple_of(to_world(placement.b, arrow_of(meeting.point_b)));
  meeting.displacement = (from_a - from_b + sideways * meeting.beside - apart) * (1 / meeting.time);
  return meeting;
}

}  // namespace detent_queries
