#include <detent/asset.h>
#include <detent/body.h>
#include <detent/query.h>
#include <detent/world.h>

#include <algorithm>
#include <map>

#include "shape/hull.h"
#include "tests/bench/zoo/script.h"
#include "tests/campaigns/zoo/opened_scene.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using detent_zoo::BodyFrame;
using detent_zoo::Frame;
using detent_zoo::Id;
using detent_zoo::Part;
using detent_zoo::Properties;
using detent_zoo::Rotation;
using detent_zoo::Solid;
using detent_zoo::Ties;
using detent_zoo::Vector;

constexpr double k_endless = 1e6;  // m: the width of a ground

template <class HandleId>
Id number_of(HandleId id) {
  return Id{id.generation} << 32 | id.slot;
}
template <class HandleId>
HandleId handle_of(Id id) {
  HandleId handle;
  handle.slot = static_cast<decltype(handle.slot)>(id & 0xffffffffu);
  handle.generation = static_cast<decltype(handle.generation)>(id >> 32);
  return handle;
}

/// False if one is out of the library's range.
bool vector_from(const Vector& v, Vec3<Real>& result) {
  return real_from_host(v.x, result.x) == Status::ok && real_from_host(v.y, result.y) == Status::ok &&
         real_from_host(v.z, result.z) == Status::ok;
}
bool pose_from(const BodyFrame& body, Position& position, Quat& rotation) {
  const Vector& p = body.position;
  const Rotation& q = body.rotation;
  return coord_from_host(p.x, position.x) == Status::ok && coord_from_host(p.y, position.y) == Status::ok &&
         coord_from_host(p.z, position.z) == Status::ok && unit_from_host(q.x, rotation.x) == Status::ok &&
         unit_from_host(q.y, rotation.y) == Status::ok && unit_from_host(q.z, rotation.z) == Status::ok &&
         unit_from_host(q.w, rotation.w) == Status::ok;
}

/// The turn that takes y to that direction.
Rotation from_y_to(const Vector& displacement) {
  const double along = length(displacement);
  if (along == 0) return {};
  const Vector unit = (1 / along) * displacement;
  if (unit.y < -0.999999) return {1, 0, 0, 0};
  const Vector axis = detent_zoo::cross({0, 1, 0}, unit);
  const double w = 1 + unit.y, norm = sqrt(dot(axis, axis) + w * w);
  return {axis.x / norm, axis.y / norm, axis.z / norm, w / norm};
}

void measure_bounds(Part& part) {
  for (const Vector& p : part.points) {
    part.half_extents = {std::max(part.half_extents.x, fabs(p.x)), std::max(part.half_extents.y, fabs(p.y)),
                         std::max(part.half_extents.z, fabs(p.z))};
  }
}

Part hull_part(const Asset& asset, double rounding) {
  Part part;
  part.solid = Solid::hull;
  part.rounding = rounding;
  const HullView hull = hull_view(asset.bytes);
  const double step = ldexp(1.0, hull.exponent() - 30);
  for (uint32_t i = 0; i < hull.vertex_count; ++i)
    part.points.push_back({step * hull.x(i), step * hull.y(i), step * hull.z(i)});
  for (uint32_t i = 0; i < hull.face_count; ++i) {
    const HullIndices loop = hull.face(i);
    part.faces.emplace_back(loop.index, loop.index + loop.count);
  }
  measure_bounds(part);
  return part;
}

std::vector<Part> compound_parts(const Asset& asset) {
  std::vector<Part> parts;
  CompoundPart piece;
  for (uint32_t i = 0; compound_part(asset, i, piece) == Status::ok; ++i) {
    if (piece.type == ShapeType::hull) {
      parts.push_back(hull_part(piece.hull, piece.radius));
      continue;
    }
    const Vector from = {piece.from[0], piece.from[1], piece.from[2]}, to = {piece.to[0], piece.to[1], piece.to[2]};
    Part part;
    part.solid = piece.type == ShapeType::sphere ? Solid::sphere : Solid::capsule;
    part.radius = piece.radius;
    part.half_length = 0.5 * length(to - from);
    part.position = 0.5 * (from + to);
    part.rotation = from_y_to(to - from);
    parts.push_back(part);
  }
  return parts;
}

/// The triangles, in the body's frame. Corners at one place are one.
struct MeshReading {
  BodyFrame body;
  Part part;
  std::map<std::array<double, 3>, uint32_t> places;

  static void take(void* user, const BodyTriangle& triangle) {
    MeshReading& self = *static_cast<MeshReading*>(user);
    std::vector<uint32_t> corners;
    for (const Position& corner : triangle.corner) {
      const Vector world = {coord_to_host(corner.x), coord_to_host(corner.y), coord_to_host(corner.z)};
      const auto [place, is_new] = self.places.emplace(std::array<double, 3>{world.x, world.y, world.z},
                                                       static_cast<uint32_t>(self.part.points.size()));
      if (is_new) self.part.points.push_back(rotate(inverse(self.body.rotation), world - self.body.position));
      corners.push_back(place->second);
    }
    self.part.faces.push_back(corners);
  }
};

double half_width_of(const Part& part) {
  switch (part.solid) {
    case Solid::sphere:
    case Solid::capsule:
      return part.radius;
    case Solid::cylinder:
    case Solid::cone:
      return std::min(part.radius, part.half_length) + part.rounding;
    case Solid::box:
    case Solid::hull:
      return std::min({part.half_extents.x, part.half_extents.y, part.half_extents.z}) + part.rounding;
    default:
      return k_endless;
  }
}

class DetentScript : public detent_zoo::Script {
 public:
  explicit DetentScript(std::unique_ptr<OpenedScene> scene) : scene_(std::move(scene)) {}

  uint32_t ticks() const override { return scene_->text().ticks; }
  Frame frame() const override { return scene_->frame(); }

  std::vector<Id> bodies() const override {
    std::vector<Id> ids;
    for (const BodyId id : scene_->bodies()) ids.push_back(number_of(id));
    return ids;
  }
  std::vector<Id> joints() const override {
    std::vector<Id> ids;
    for (const JointId id : scene_->joints()) ids.push_back(number_of(id));
    return ids;
  }

  Properties properties(Id body) const override {
    BodyDef def;
    Properties properties;
    const BodyId id = handle_of<BodyId>(body);
    if (get_body_def(scene_->world(), id, def) != Status::ok) return properties;
    properties.parts = parts_of(id, def.shape);
    properties.friction = real_to_host(def.material.friction);
    properties.restitution = real_to_host(def.material.restitution);
    properties.rolling_resistance = real_to_host(def.material.rolling_resistance);
    properties.damps = def.material.restitution_rule == RestitutionRule::smaller;
    properties.half_width = k_endless;
    for (const Part& part : properties.parts)
      properties.half_width = std::min(properties.half_width, half_width_of(part));
    properties.linear_damping = real_to_host(def.linear_damping);
    properties.angular_damping = real_to_host(def.angular_damping);
    properties.category = def.filter.category;
    properties.mask = def.filter.mask;
    properties.group = def.filter.group;
    properties.sensor = def.sensor;
    return properties;
  }

  Ties ties(Id joint) const override {
    JointDef def;
    if (get_joint(scene_->world(), handle_of<JointId>(joint), def) != Status::ok) return {};
    return {scaled_to_host(def.friction_force), scaled_to_host(def.friction_torque), scaled_to_host(def.break_force),
            scaled_to_host(def.break_torque), def.collide};
  }

  std::string body_name(Id body) const override { return scene_->name_of(handle_of<BodyId>(body)); }

  bool calls_at(uint32_t tick) const override {
    const std::vector<SceneAction>& actions = scene_->text().actions;
    return std::any_of(actions.begin(), actions.end(),
                       [tick](const SceneAction& action) { return action.tick <= tick && tick <= action.until; });
  }

  void place(const std::vector<BodyFrame>& bodies) override {
    Recorder& recorder = scene_->recorder();
    const std::vector<BodyId> ids = scene_->bodies();
    for (size_t i = 0; i < ids.size() && i < bodies.size(); ++i) {
      if (bodies[i].kind == detent_zoo::Kind::fixed) continue;
      Position position;
      Quat rotation;
      Vec3<Real> linear_velocity, angular_velocity;
      // What is too fast or too far for the library stays where it was: its scene has failed by then.
      if (!pose_from(bodies[i], position, rotation) || !vector_from(bodies[i].linear_velocity, linear_velocity) ||
          !vector_from(bodies[i].angular_velocity, angular_velocity)) {
        continue;
      }
      static_cast<void>(recorder.set_pose(ids[i], position, rotation));
      static_cast<void>(recorder.set_velocity(ids[i], linear_velocity, angular_velocity));
    }
  }

  void call(uint32_t tick, std::string& problem) override { scene_->call(tick, problem); }

  void remove_joint(Id joint) override {
    static_cast<void>(scene_->recorder().destroy_joint(handle_of<JointId>(joint)));
  }

 private:
  std::vector<Part> parts_of(BodyId id, const Shape& shape) const {
    const World& world = scene_->world();
    Part part;
    part.radius = real_to_host(shape.radius);
    part.half_length = real_to_host(shape.half_length);
    part.rounding = real_to_host(shape.rounding);
    switch (shape.type) {
      case ShapeType::compound:
        return compound_parts(world.hooks.assets.assets[shape.asset]);
      case ShapeType::hull:
        return {hull_part(world.hooks.assets.assets[shape.asset], part.rounding)};
      case ShapeType::terrain: {
        MeshReading reading;
        const std::vector<BodyId> ids = scene_->bodies();
        const auto found = std::find(ids.begin(), ids.end(), id);
        reading.body = scene_->frame().bodies[static_cast<size_t>(found - ids.begin())];
        reading.part.solid = Solid::mesh;
        static_cast<void>(visit_triangles(world, id, &reading, MeshReading::take));
        measure_bounds(reading.part);
        return {reading.part};
      }
      case ShapeType::sphere:
        part.solid = Solid::sphere;
        break;
      case ShapeType::capsule:
        part.solid = Solid::capsule;
        break;
      case ShapeType::cylinder:
        part.solid = Solid::cylinder;
        break;
      case ShapeType::cone:
        part.solid = Solid::cone;
        break;
      case ShapeType::half_space:
        part.solid = Solid::half_space;
        break;
      default:
        part.solid = Solid::box;
        part.half_extents = {real_to_host(shape.half_extents.x), real_to_host(shape.half_extents.y),
                             real_to_host(shape.half_extents.z)};
        break;
    }
    if (part.solid == Solid::sphere || part.solid == Solid::capsule || part.solid == Solid::half_space)
      part.rounding = 0;
    return {part};
  }

  std::unique_ptr<OpenedScene> scene_;
};

}  // namespace

}  // namespace DETENT_NAMESPACE
}  // namespace detent

namespace detent_zoo {

std::unique_ptr<Script> open_script(const std::string& path, detent_test::Ground ground, std::string& problem) {
  std::unique_ptr<detent::OpenedScene> scene = detent::OpenedScene::open(path, ground, problem);
  if (scene == nullptr) return nullptr;
  return std::make_unique<detent::DetentScript>(std::move(scene));
}

bool has_ground(const std::string& path) {
  std::string problem;
  const auto scene = detent::OpenedScene::open(path, detent_test::Ground::own, problem);
  return scene != nullptr && scene->has_ground();
}

}  // namespace detent_zoo
