#include <detent/query.h>

#include "base/float_environment.h"
#include "distance/pair.h"
#include "query/query_terrain.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Status visit_triangles(const World& world, BodyId id, void* user,
                       void (*visit)(void* user, const BodyTriangle& triangle)) {
  const FloatEnvironment environment;
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  const BodyProperties& properties = state.properties[slot];
  if (visit == nullptr || !is_terrain(properties)) return Status::bad_argument;
  if (!has_terrain_bytes(world, properties)) return Status::asset_missing;

  struct Walk {
    AskedSurface terrain;
    TerrainPlace place;
    void* user;
    void (*visit)(void* user, const BodyTriangle& triangle);

    void show(uint32_t index) const {
      const TerrainTriangle t = terrain.code.triangle(terrain.terrain, index);
      const int64_t step = int64_t{1} << grid_shift(terrain.terrain);
      BodyTriangle shown;
      shown.index = index;
      shown.material = t.material;
      for (int k = 0; k < 3; ++k) {
        const Vec32& at = t.corner[k];
        const Vec64 displacement = rotate(place.terrain, Vec64{at.x * step, at.y * step, at.z * step});
        shown.corner[k] = moved(terrain.pose.position, {real_from_raw(displacement.x), real_from_raw(displacement.y),
                                                        real_from_raw(displacement.z)});
      }
      visit(user, shown);
    }
  };
  Walk walk = {asked_terrain(world, properties, state.poses[slot]), {}, user, visit};
  const TerrainOps& code = walk.terrain.code;
  if (const Status status = code.place(walk.terrain.pose, walk.terrain.pose, walk.place); status != Status::ok)
    return status;
  constexpr int64_t k_all = int64_t{1} << 61;  // every coordinate of a terrain is at most half of this
  code.visit(
      walk.terrain.terrain, {-k_all, -k_all, -k_all}, {k_all, k_all, k_all},
      [](void* context, uint32_t index) { static_cast<const Walk*>(context)->show(index); }, &walk);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
