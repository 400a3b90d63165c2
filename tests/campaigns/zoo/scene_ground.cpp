#include "tests/campaigns/zoo/scene_ground.h"

#include <detent/numbers.h>

#include <algorithm>

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using detent_test::Ground;

bool is_ground(const SceneBody& body) {
  const BodyDef& def = body.def;
  const Quat& q = def.rotation;
  const Vec3<Real>& half = def.shape.half_extents;
  const bool level = unit_to_host(q.x) == 0 && unit_to_host(q.y) == 0 && unit_to_host(q.z) == 0;
  return def.type == BodyType::fixed && !def.sensor && level &&
         (def.shape.type == ShapeType::half_space ||
          (def.shape.type == ShapeType::box &&
           detent_test::is_wide_as_ground(real_to_host(half.x), real_to_host(half.y), real_to_host(half.z))));
}

/// What scenes and grounds have is in range.
Real real_of(double value) {
  Real result = 0.0;
  if (real_from_host(value, result) != Status::ok) __builtin_trap();
  return result;
}
Coord coord_of(double value) {
  Coord result = 0.0;
  if (coord_from_host(value, result) != Status::ok) __builtin_trap();
  return result;
}

}  // namespace

SceneBody* ground_of(SceneText& scene) {
  std::vector<SceneBody>& bodies = scene.bodies;
  const auto found = std::find_if(bodies.begin(), bodies.end(), is_ground);
  if (found == bodies.end() || std::find_if(found + 1, bodies.end(), is_ground) != bodies.end()) return nullptr;
  return &*found;
}

void replace_ground(SceneBody& ground, Ground shape) {
  if (shape == Ground::own) return;
  BodyDef& def = ground.def;
  const bool was_box = def.shape.type == ShapeType::box;
  const Vec3<Real> half = def.shape.half_extents;
  const double top = coord_to_host(def.position.y) + (was_box ? real_to_host(half.y) : 0);
  if (shape == Ground::half_space) {
    def.shape = half_space();
    def.position.y = coord_of(top);
    return;
  }
  const auto width = [was_box](Real own) {
    return real_of(std::max(was_box ? real_to_host(own) : 0, detent_test::k_ground_half_width));
  };
  def.shape = box({width(half.x), real_of(detent_test::k_ground_half_height), width(half.z)});
  def.position.y = coord_of(top - detent_test::k_ground_half_height);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
