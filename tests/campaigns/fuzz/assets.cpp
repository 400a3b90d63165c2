#include <detent/asset.h>
#include <detent/distance.h>
#include <detent/query.h>

#include "base/crc.h"
#include "shape/cooked.h"
#include "tests/campaigns/fuzz/targets.h"
#include "tests/unit/replay/match.h"
#include "tests/unit/shape/hull_bytes.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_fuzz::Bytes;

constexpr uint8_t k_mend = 1;  ///< of the first byte

void mend(uint8_t* bytes, uint32_t count) {
  constexpr uint32_t k_at = k_cooked_checksum_at;
  if (count < k_at + 4) return;
  const uint32_t words[] = {count, crc32(bytes + k_at + 4, count - k_at - 4)};
  for (uint32_t k = 0; k < 4; ++k) bytes[k_cooked_byte_count_at + k] = static_cast<uint8_t>(words[0] >> (8 * k));
  const uint32_t checksum = crc32(bytes + k_at + 4, count - k_at - 4, crc32(bytes, k_at));
  for (uint32_t k = 0; k < 4; ++k) bytes[k_at + k] = static_cast<uint8_t>(checksum >> (8 * k));
}

/// What the bytes say of themselves. The type of shape that they are of, or sphere for none.
ShapeType describe(const Asset& asset) {
  HullInfo of_hull;
  MeshInfo of_mesh;
  HeightFieldInfo of_field;
  CompoundInfo of_compound;
  if (hull_info(asset, of_hull) == Status::ok) {
    Convex convex;
    EXPECT_OK(make_hull(asset, Real(0.125), convex));
    return ShapeType::hull;
  }
  if (compound_info(asset, of_compound) == Status::ok) {
    for (uint32_t i = 0; i < of_compound.child_count; ++i) {
      CompoundPart part;
      EXPECT_OK(compound_part(asset, i, part));
      if (part.type == ShapeType::hull) {
        EXPECT_OK(hull_info(part.hull, of_hull));
      }
    }
    return ShapeType::compound;
  }
  if (mesh_info(asset, of_mesh) == Status::ok) return ShapeType::terrain;
  return height_field_info(asset, of_field) == Status::ok ? ShapeType::terrain : ShapeType::sphere;
}

void ask(const World& world) {
  QueryHit hit[4];
  QueryReport report;
  EXPECT_OK(query_ray(world, {position(0.125, 4, 0.25), reals(0.5, -8, 0.25), {}, true}, {hit, 4}, report));
  CastQuery cast;
  cast.shape = box(reals(0.25, 0.125, 0.5));
  cast.position = position(0.5, 3, 0);
  cast.displacement = reals(-1, -6, 0.5);
  cast.rotation_vector = reals(1, 2, 3);
  EXPECT_OK(query_cast(world, cast, {hit, 4}, report));
  ClosestQuery closest;
  closest.position = position(-1, 1, 1);
  closest.all = true;
  EXPECT_OK(query_closest(world, closest, {hit, 4}, report));
}

/// Bodies meet it, and questions are asked of it.
void use(World& world, ShapeType type) {
  BodyDef def;
  def.type = type == ShapeType::terrain ? BodyType::kinematic : BodyType::dynamic;
  def.shape.type = type;
  BodyId id, other;
  if (create_body(world, def, id) != Status::ok) return;  // of a size that no body has, or in its source frame
  def = {};
  for (uint32_t i = 0; i < 2; ++i) {
    def.shape = i == 0 ? box(reals(0.5, 0.25, 0.5)) : capsule(real(0.25), real(0.5));
    def.position = position(0.25 * i, 1.5 + i, 0.125);
    def.linear_velocity = reals(0, -20, 0);
    def.angular_velocity = reals(3, 1, 2);
    EXPECT_OK(create_body(world, def, other));
  }
  EXPECT_OK(set_velocity(world, id, reals(0, 1, 0), reals(0, 0.5, 0)));
  for (uint32_t tick = 0; tick < 6; ++tick) step(world);
  ask(world);
  if (type != ShapeType::terrain) return;
  uint32_t triangles = 0;
  const auto count = [](void* user, const BodyTriangle&) { ++*static_cast<uint32_t*>(user); };
  const Status status = visit_triangles(world, id, &triangles, count);
  EXPECT_TRUE(status == Status::ok || triangles == 0);
}

bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  const uint32_t count = static_cast<uint32_t>(bytes.size() - 1);
  const std::unique_ptr<uint64_t[]> words(new uint64_t[(count + 7) / 8]());
  uint8_t* const data = reinterpret_cast<uint8_t*>(words.get());
  if (count != 0) memcpy(data, bytes.data() + 1, count);
  if ((bytes[0] & k_mend) != 0) mend(data, count);
  const Asset asset = {data, count};
  const ShapeType type = describe(asset);
  OwnedWorld owned(OwnedWorld::def_of({4, 12, 1}), {&asset, 1});
  if (bind_asset(owned.world, 0) != Status::ok) return false;
  if (type == ShapeType::sphere) return false;
  use(owned.world, type);
  return true;
}

std::vector<Bytes> seeds() {
  const AssetTable scenes = scene_assets();
  const Asset assets[] = {scenes.assets[k_asset_valley],
                          scenes.assets[k_asset_hills],
                          scenes.assets[k_asset_dumbbell],
                          {detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                          {detent_hulls::k_prism, sizeof detent_hulls::k_prism}};
  std::vector<Bytes> made;
  for (const Asset& asset : assets) {
    made.push_back({k_mend});
    made.back().insert(made.back().end(), asset.bytes, asset.bytes + asset.byte_count);
  }
  return made;
}

}  // namespace

const detent_fuzz::Target k_assets_target = {take, seeds};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
