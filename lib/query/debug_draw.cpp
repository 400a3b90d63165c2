#include <detent/body.h>
#include <detent/contact.h>
#include <detent/draw.h>
#include <detent/query.h>
#include <detent/world.h>

#include "base/cycle.h"
#include "base/float_environment.h"
#include "motion/angular_velocity.h"
#include "shape/bounds.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using State = StateView<const uint8_t>;

DrawKind kind_of(const State& state, uint32_t slot) {
  switch (type_of(state.properties[slot])) {
    case BodyType::fixed:
      return DrawKind::fixed;
    case BodyType::kinematic:
      return DrawKind::kinematic;
    default:
      return state.activities[slot].asleep == 0 ? DrawKind::awake : DrawKind::asleep;
  }
}

/// Draws the edges of the body's axis-aligned bounds.
void draw_bounds(const State& state, uint32_t slot, const DebugDraw& to) {
  const BodyProperties& properties = state.properties[slot];
  if (is_half_space(properties)) return;
  const BodyPose& pose = state.poses[slot];
  const Vec3<Real> half = half_bounds(properties, matrix_from(pose.rotation));
  const auto corner = [&](int index) {
    return moved(pose.position, {(index & 1) != 0 ? half.x : -half.x, (index & 2) != 0 ? half.y : -half.y,
                                 (index & 4) != 0 ? half.z : -half.z});
  };
  for (int from = 0; from < 8; ++from) {
    for (int axis = 1; axis < 8; axis *= 2) {
      if ((from & axis) == 0) to.line(to.user, corner(from), corner(from | axis), DrawKind::bounds);
    }
  }
}

void draw_velocity(const State& state, uint32_t slot, const DebugDraw& to) {
  const Vec3<Real> velocity = state.motions[slot].linear_velocity;
  const Real zero = 0.0, time = 0.1;
  if (velocity == Vec3<Real>{zero, zero, zero}) return;
  const Position& from = state.poses[slot].position;
  to.line(to.user, from, moved(from, velocity * time), DrawKind::linear_velocity);
}

void draw_contact(const State& state, const Contact& contact, const DebugDraw& to) {
  const Real length = scale_by_power(
      min(shape_extent(state.properties[contact.a.slot - 1]), shape_extent(state.properties[contact.b.slot - 1])), -2);
  for (uint32_t i = 0; i < contact.point_count; ++i) {
    const Position& at = contact.point[i].position;
    const Vec3<Real> offset = {length * contact.normal.x, length * contact.normal.y, length * contact.normal.z};
    if (to.point != nullptr) to.point(to.user, at, DrawKind::contact);
    if (to.line != nullptr) to.line(to.user, at, moved(at, offset), DrawKind::normal);
  }
}

/// Draws the edges of a terrain's triangles. An edge that two triangles share is drawn twice.
void draw_terrain(const World& world, const State& state, BodyId id, const DebugDraw& to) {
  struct Lines {
    const DebugDraw& to;
    DrawKind kind;
  };
  Lines lines = {to, kind_of(state, id.slot - 1)};
  // If the asset bytes of the terrain are missing, no triangles are drawn; draw_bounds() still works.
  static_cast<void>(visit_triangles(world, id, &lines, [](void* user, const BodyTriangle& triangle) {
    const Lines& drawn = *static_cast<const Lines*>(user);
    for (int k = 0; k < 3; ++k)
      drawn.to.line(drawn.to.user, triangle.corner[k], triangle.corner[next_of_three(k)], drawn.kind);
  }));
}

void draw_body(const World& world, const State& state, BodyId id, const DebugDraw& to, DrawFlags flags) {
  const uint32_t slot = id.slot - 1;
  Shape shape;
  if (to.solid != nullptr && contains(flags, DrawFlags::bodies) && get_shape(world, id, shape) == Status::ok) {
    const BodyPose& pose = state.poses[slot];
    to.solid(to.user, id, shape, {pose.position, pose.rotation}, kind_of(state, slot));
  }
  if (to.line == nullptr) return;
  if (to.solid == nullptr && contains(flags, DrawFlags::bodies) && is_terrain(state.properties[slot]))
    draw_terrain(world, state, id, to);
  if (contains(flags, DrawFlags::bounds)) draw_bounds(state, slot, to);
  if (contains(flags, DrawFlags::velocities)) draw_velocity(state, slot, to);
}

}  // namespace

void draw(const World& world, const DebugDraw& to, DrawFlags flags) {
  const FloatEnvironment environment;
  const State state = view_of(world);
  BodyId id = next_body(world, {});
  for (; !(id == BodyId{}); id = next_body(world, id)) draw_body(world, state, id, to, flags);
  if (!contains(flags, DrawFlags::contacts) || (to.point == nullptr && to.line == nullptr)) return;
  for (uint32_t i = 0; i < state.world.contact_count; ++i) {
    Contact contact;
    if (get_contact(world, i, contact) == Status::ok) draw_contact(state, contact, to);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
