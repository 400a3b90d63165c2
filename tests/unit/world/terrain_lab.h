#pragma once
#include "tests/unit/shape/terrains.h"
#include "tests/unit/world/lab.h"

/// A world with a mesh or a height field.
namespace detent {
inline namespace DETENT_NAMESPACE {

using detent_terrains::Bytes;
using detent_terrains::field_of;

inline Asset asset_of(const Bytes& bytes) { return {bytes.data(), bytes.count()}; }

/// A world whose asset 0 is a surface.
class TerrainLab : public Lab {
 public:
  explicit TerrainLab(const Bytes& bytes, WorldDef def = {}, bool sleeping = false)
      : Lab({32, 256, 1}, def, sleeping), bytes_(bytes), asset_(asset_of(bytes_)) {
    world.hooks.assets = {&asset_, 1};
    EXPECT_OK(bind_asset(world, 0));
  }
  BodyDef ground_def(double friction = 0.6) const {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = terrain(0);
    def.material.friction = real(friction);
    return def;
  }
  BodyId add_terrain(double friction = 0.6) { return add(ground_def(friction)); }
  BodyId add_shape(const Shape& shape, double x, double y, double z, double friction = 0.6) {
    BodyDef def;
    def.shape = shape;
    def.position = position(x, y, z);
    def.material.friction = real(friction);
    return add(def);
  }

 private:
  Bytes bytes_;
  Asset asset_;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
