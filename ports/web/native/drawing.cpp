#include <detent/asset.h>
#include <detent/draw.h>
#include <detent/query.h>
#include <stdlib.h>

#include "fields.h"
#include "session.h"
#include "shape/body.h"
#include "shape/hull.h"
#include "state/view.h"

/// What a program needs to draw a world: the poses of all bodies in one call, the states and islands of the bodies, and
/// the outlines of shapes.
namespace detent_web {
namespace {

/// A hash of the members of a shape that determine how the body looks.
uint32_t look_of(const Shape& shape) {
  uint32_t look = 2166136261u;  // FNV-1a
  const auto mix = [&look](uint64_t value) {
    for (int i = 0; i < 8; ++i) look = (look ^ static_cast<uint32_t>(value >> (8 * i) & 0xff)) * 16777619u;
  };
  mix(static_cast<uint32_t>(shape.type));
  mix(shape.asset);
  const Real sizes[] = {shape.radius,         shape.half_length,    shape.half_extents.x,
                        shape.half_extents.y, shape.half_extents.z, shape.rounding};
  for (const Real& size : sizes) mix(__builtin_bit_cast(uint64_t, real_to_host(size)));
  return look;
}

/// The islands of a world, as the solver forms them: bodies that contacts or joints connect. Fixed and kinematic bodies
/// connect nothing. Computed by union-find over the slots.
class Islands {
 public:
  explicit Islands(const World& world)
      : first_(static_cast<uint32_t*>(malloc((get_info(world).capacity.bodies + 1) * sizeof(uint32_t)))) {
    if (first_ == nullptr) return;
    const StateView<const uint8_t> state = view_of(world);
    const uint32_t bodies = get_info(world).capacity.bodies;
    for (uint32_t slot = 0; slot < bodies; ++slot) first_[slot] = slot;
    const auto join = [&](uint32_t a, uint32_t b) {
      if (!is_dynamic(state.properties[a]) || !is_dynamic(state.properties[b])) return;
      a = of(a);
      b = of(b);
      first_[a < b ? b : a] = a < b ? a : b;
    };
    for (uint32_t i = 0; i < get_info(world).contacts; ++i) join(state.contacts[i].body_a, state.contacts[i].body_b);
    JointDef def;
    for (JointId id = next_joint(world, {}); id.slot != 0; id = next_joint(world, id)) {
      if (get_joint(world, id, def) == Status::ok && def.type != JointType::filter)
        join(def.a.slot - 1, def.b.slot - 1);
    }
  }
  Islands(const Islands&) = delete;
  ~Islands() { free(first_); }

  uint32_t of(uint32_t slot) {
    if (first_ == nullptr) return slot;
    while (first_[slot] != slot) slot = first_[slot] = first_[first_[slot]];
    return slot;
  }

 private:
  uint32_t* first_;
};

/// A part of an outline, rounded by a ball. Kind 1: the points of a convex core. Kind 2: triangles of three points
/// each. On the desk: kind, radius of the ball, number of points, then x, y, z of each point.
class Outline {
 public:
  explicit Outline(uint32_t kind, double radius) {
    // Parts follow each other on the desk: this part begins where the last one ended.
    out_.count = desk_count;
    out_.put(kind);
    out_.put(radius);
    count_at_ = out_.count;
    out_.put(0);
  }
  void point(double x, double y, double z) {
    out_.put(x);
    out_.put(y);
    out_.put(z);
    ++points_;
  }
  ~Outline() {
    if (double* desk = desk_room(out_.count); desk != nullptr) desk[count_at_] = points_;
    desk_count = out_.count;
  }

  static uint32_t desk_count;

 private:
  Giver out_;
  uint32_t count_at_ = 0;
  uint32_t points_ = 0;
};
uint32_t Outline::desk_count = 0;

void outline_hull(const Asset& asset, double rounding) {
  HullView hull;
  if (read_hull(asset, hull) != Status::ok) return;
  const double unit = __builtin_ldexp(1.0, hull.exponent() - 30);
  Outline part(1, rounding);
  for (uint32_t i = 0; i < hull.vertex_count; ++i) part.point(hull.x(i) * unit, hull.y(i) * unit, hull.z(i) * unit);
}

void outline_compound(const Asset& asset) {
  CompoundInfo info;
  if (compound_info(asset, info) != Status::ok) return;
  for (uint32_t i = 0; i < info.child_count; ++i) {
    CompoundPart part;
    if (compound_part(asset, i, part) != Status::ok) continue;
    if (part.type == ShapeType::hull) {
      outline_hull(part.hull, part.radius);
      continue;
    }
    Outline round(1, part.radius);
    round.point(part.from[0], part.from[1], part.from[2]);
    if (part.type == ShapeType::capsule) round.point(part.to[0], part.to[1], part.to[2]);
  }
}

/// Gives the triangles in the body's axes, so that a program can draw them at the body's pose.
void outline_terrain(const World& world, BodyId id, const Pose& pose) {
  struct Context {
    Outline part;
    Pose pose;
  } context = {Outline(2, 0), pose};
  (void)visit_triangles(world, id, &context, [](void* user, const BodyTriangle& triangle) {
    Context& to = *static_cast<Context*>(user);
    for (const Position& corner : triangle.corner) {
      const Vec3<Real> local = to_local(to.pose, corner);
      to.part.point(real_to_host(local.x), real_to_host(local.y), real_to_host(local.z));
    }
  });
}

}  // namespace

/// Writes the pose of each body, in the order of slots, relative to a camera at (x, y, z). A pose is seven floats:
/// position and rotation. The poses begin every `stride` floats. `to` has room for `bodies_max` poses. Returns the
/// number of poses written.
DETENT_WEB(world_poses)
uint32_t world_poses(const Session* session, float* to, uint32_t stride, uint32_t bodies_max, double x, double y,
                     double z) {
  Position camera = {};
  if (coord_from_host(x, camera.x) != Status::ok || coord_from_host(y, camera.y) != Status::ok ||
      coord_from_host(z, camera.z) != Status::ok)
    return 0;
  uint32_t count = 0;
  for (BodyId id = next_body(session->world, {}); id.slot != 0 && count < bodies_max;
       id = next_body(session->world, id), ++count, to += stride) {
    Pose pose;
    if (get_pose(session->world, id, pose) != Status::ok) break;
    const CameraRelative relative = relative_to_camera(pose, camera);
    for (int i = 0; i < 3; ++i) to[i] = relative.position[i];
    for (int i = 0; i < 4; ++i) to[3 + i] = relative.rotation[i];
  }
  return count;
}

/// Gives for each body, in the order of slots: id, type, whether it is awake, whether it is a sensor, the lowest slot
/// of its island, its speed, its angular speed, and look_of() its shape. Returns the number of bodies.
DETENT_WEB(world_bodies) uint32_t world_bodies(const Session* session) {
  const World& world = session->world;
  Islands islands(world);
  Giver out;
  uint32_t count = 0;
  for (BodyId id = next_body(world, {}); id.slot != 0; id = next_body(world, id), ++count) {
    BodyType type = BodyType::fixed;
    bool awake = false, sensor = false;
    Vec3<Real> velocity = {}, angular_velocity = {};
    Shape shape;
    if (get_type(world, id, type) != Status::ok || is_awake(world, id, awake) != Status::ok ||
        get_sensor(world, id, sensor) != Status::ok || get_shape(world, id, shape) != Status::ok ||
        get_velocity(world, id, velocity, angular_velocity) != Status::ok)
      continue;  // impossible: the world gave the id
    const auto length = [](const Vec3<Real>& v) {
      const double a = real_to_host(v.x), b = real_to_host(v.y), c = real_to_host(v.z);
      return __builtin_sqrt(a * a + b * b + c * c);
    };
    visit(out, id);
    out.choice(type);
    out.flag(awake);
    out.flag(sensor);
    out.word(islands.of(id.slot - 1) + 1);
    out.put(length(velocity));
    out.put(length(angular_velocity));
    out.word(look_of(shape));
  }
  return count;
}

/// Gives the outline of the body's shape as parts, if the shape has an asset. Returns the number of doubles on the
/// desk.
DETENT_WEB(world_outline) uint32_t world_outline(const Session* session, uint32_t slot, uint32_t generation) {
  const BodyId id = {slot, generation};
  Outline::desk_count = 0;
  Shape shape;
  Pose pose;
  if (get_shape(session->world, id, shape) != Status::ok || get_pose(session->world, id, pose) != Status::ok) return 0;
  const AssetTable& assets = session->world.hooks.assets;
  if (shape.type == ShapeType::terrain) outline_terrain(session->world, id, pose);
  if (shape.asset >= assets.count) return Outline::desk_count;
  if (shape.type == ShapeType::hull) outline_hull(assets.assets[shape.asset], real_to_host(shape.rounding));
  if (shape.type == ShapeType::compound) outline_compound(assets.assets[shape.asset]);
  return Outline::desk_count;
}

/// Gives the edges of the bodies' bounds: two points each, m, world. Returns the number of edges.
DETENT_WEB(world_bounds) uint32_t world_bounds(const Session* session) {
  Giver out;
  DebugDraw to;
  to.user = &out;
  to.line = [](void* user, const Position& from, const Position& until, DrawKind) {
    Position a = from, b = until;
    visit_position(*static_cast<Giver*>(user), a);
    visit_position(*static_cast<Giver*>(user), b);
  };
  draw(session->world, to, DrawFlags::bounds);
  return out.count / 6;
}

/// Gives for each joint: id, type, both bodies' ids, the anchors of A and B, m, world, and the x axis of A's frame,
/// world. Returns the number of joints.
DETENT_WEB(world_joint_lines) uint32_t world_joint_lines(const Session* session) {
  const World& world = session->world;
  Giver out;
  uint32_t count = 0;
  for (JointId id = next_joint(world, {}); id.slot != 0; id = next_joint(world, id)) {
    JointDef def;
    Pose a, b;
    if (get_joint(world, id, def) != Status::ok || get_pose(world, def.a, a) != Status::ok ||
        get_pose(world, def.b, b) != Status::ok)
      continue;
    Position anchor_a = to_world(a, def.anchor_a), anchor_b = to_world(b, def.anchor_b);
    const Real zero = 0.0, one = 1.0;
    Vec3<Real> axis = vector_to_world(a.rotation, vector_to_world(def.frame_a, {one, zero, zero}));
    visit(out, id);
    out.choice(def.type);
    visit(out, def.a);
    visit(out, def.b);
    visit_position(out, anchor_a);
    visit_position(out, anchor_b);
    visit_reals(out, axis);
    ++count;
  }
  return count;
}

}  // namespace detent_web
