#include "world/query_bodies.h"

#include "contact/body_convex.h"
#include "contact/collide_half_space.h"
#include "distance/pair.h"
#include "shape/bounds.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"
#include "state/asset_binding.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

QueryShape query_point() {
  QueryShape point{};
  point.properties.shape = static_cast<uint32_t>(ShapeType::sphere);
  point.convex.type = ShapeType::sphere;
  return point;
}

Status make_query_shape(const World& world, const Shape& shape, QueryShape& made) {
  if (shape.type == ShapeType::sphere && shape.radius == Real(0.0) && shape.rounding == Real(0.0)) {
    made = query_point();
    return Status::ok;
  }
  if (shape.type == ShapeType::half_space || shape.type == ShapeType::terrain || shape.type == ShapeType::compound)
    return Status::bad_argument;
  if (shape.type == ShapeType::hull) {
    if (const Status status = find_shape(world, shape.type, shape.asset, BodyType::fixed); status != Status::ok)
      return status;
  }
  QueryShape shaped{};
  if (const Status status = set_shape_properties(shape, shaped.properties, world.hooks.assets, *world.features);
      status != Status::ok)
    return status;
  if (!body_convex(shaped.properties, world.hooks.assets, shaped.convex)) return Status::asset_missing;
  made = shaped;
  return Status::ok;
}

Vec64 query_half(const QueryShape& shape, const Quat& rotation) {
  Vec64 raw;
  if (!raw_from_real(half_bounds(shape.properties, matrix_from(rotation)), raw))
    return {0, 0, 0};  // does not occur: the value is finite
  return raw;
}

Pose pose_near(const BodyProperties& properties, const BodyPose& pose, const Position& place) {
  const Pose whole = {pose.position, pose.rotation};
  constexpr Real k_near = 32768.0;
  if (!is_half_space(properties)) return whole;
  if (abs(real_difference(place.x, pose.position.x)) < k_near &&
      abs(real_difference(place.y, pose.position.y)) < k_near &&
      abs(real_difference(place.z, pose.position.z)) < k_near)
    return whole;
  // A height above the plane that is beyond the reach of a query may be clamped, because the query finds nothing at
  // either height. A displacement is shorter than 2^14 sqrt(3) m, and a bounding radius is below 2^15 m: together they
  // are shorter than 2^16 m.
  constexpr Real k_height_max = 65535.0;
  const Vec3<Unit> up = matrix_from(pose.rotation).column[1];
  const Real height = clamp(distance_along(pose.position, place, up), -k_height_max, k_height_max);
  return {moved(place, up * -height), pose.rotation};
}

Bounds QueryBodies::ball_bounds_of(uint32_t slot) const {
  const BodyProperties& properties = state.properties[slot];
  if (is_half_space(properties)) return k_everywhere;
  const Real ball = real_from_unit(properties.bounding_radius, properties.size_exponent);
  const Real room = ball + scale_by_power(ball, -20);  // with a margin for the rounding of bounds
  const Vec3<Real> half = {room, room, room};
  return {moved(state.poses[slot].position, -half), moved(state.poses[slot].position, half)};
}

Bounds QueryBodies::bounds_of(uint32_t slot) const {
  const BodyProperties& properties = state.properties[slot];
  if (is_half_space(properties)) return k_everywhere;
  const BodyPose& pose = state.poses[slot];
  const Vec3<Real> half = half_bounds(properties, matrix_from(pose.rotation));
  return {moved(pose.position, -half), moved(pose.position, half)};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
