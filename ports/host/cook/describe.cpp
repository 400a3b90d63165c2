#include "describe.h"

#include <math.h>
#include <string.h>

#include "shape/compound.h"
#include "shape/terrain.h"

namespace detent_cook {

HullDescription describe_hull(const std::vector<uint8_t>& bytes) {
  HullDescription description;
  std::vector<uint64_t> aligned(bytes.size() / 8 + 1);
  if (!bytes.empty()) memcpy(aligned.data(), bytes.data(), bytes.size());
  detent::HullInfo info;
  const detent::Status status =
      detent::hull_info({reinterpret_cast<const uint8_t*>(aligned.data()), static_cast<uint32_t>(bytes.size())}, info);
  if (status != detent::Status::ok) {
    description.problem = detent::status_text(status);
    return description;
  }
  description.vertex_count = info.vertex_count;
  description.face_count = info.face_count;
  description.edge_count = info.edge_count;
  description.principal = info.frame == detent::HullFrame::principal;
  description.exponent = info.exponent;
  description.radius = ldexp(info.core_radius, info.exponent - 30);
  description.volume = ldexp(info.volume_mantissa, info.volume_exponent);
  for (size_t k = 0; k < 3; ++k) description.origin[k] = info.origin[k];
  for (size_t k = 0; k < 4; ++k) description.rotation[k] = ldexp(info.rotation[k], -30);
  return description;
}

CompoundDescription describe_compound(const std::vector<uint8_t>& bytes) {
  CompoundDescription description;
  std::vector<uint64_t> aligned(bytes.size() / 8 + 1);
  if (!bytes.empty()) memcpy(aligned.data(), bytes.data(), bytes.size());
  detent::CompoundInfo info;
  const detent::Status status = detent::compound_info(
      {reinterpret_cast<const uint8_t*>(aligned.data()), static_cast<uint32_t>(bytes.size())}, info);
  if (status != detent::Status::ok) {
    description.problem = detent::status_text(status);
    return description;
  }
  description.child_count = info.child_count;
  description.hull_count = info.hull_count;
  description.radius = ldexp(info.radius, info.exponent - 30);
  description.thickness = ldexp(info.half_thickness, info.exponent - 29);
  description.volume = ldexp(info.volume_mantissa, info.volume_exponent);
  for (size_t k = 0; k < 3; ++k) description.origin[k] = info.origin[k];
  for (size_t k = 0; k < 4; ++k) description.rotation[k] = ldexp(info.rotation[k], -30);
  return description;
}

TerrainDescription describe_terrain(const std::vector<uint8_t>& bytes) {
  TerrainDescription description;
  std::vector<uint64_t> aligned(bytes.size() / 8 + 1);
  if (!bytes.empty()) memcpy(aligned.data(), bytes.data(), bytes.size());
  const detent::Asset asset = {reinterpret_cast<const uint8_t*>(aligned.data()), static_cast<uint32_t>(bytes.size())};
  detent::Terrain terrain;
  const detent::Status status = detent::read_terrain(asset, terrain);
  if (status != detent::Status::ok) {
    description.problem = detent::status_text(status);
    return description;
  }
  description.is_mesh = terrain.is_mesh;
  description.one_sided = terrain.one_sided();
  description.step = ldexp(1.0, terrain.exponent() - 30);
  detent::GridBox box = terrain.bounds();
  if (terrain.is_mesh) {
    const detent::MeshView& mesh = terrain.mesh;
    description.vertex_count = mesh.vertex_count;
    description.triangle_count = mesh.triangle_count;
    description.node_count = mesh.level_start[mesh.level_count];
    box = {mesh.low, mesh.low};
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) include(mesh.vertex(i), box);
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
      for (uint32_t k = 0; k < 3; ++k) ++description.edges[static_cast<size_t>(mesh.kind(i, k))];
    }
  } else {
    const detent::HeightFieldView& field = terrain.field;
    description.columns = field.columns;
    description.rows = field.rows;
    description.vertex_count = (field.columns + 1) * (field.rows + 1);
    for (uint32_t j = 0; j < field.rows; ++j) {
      for (uint32_t i = 0; i < field.columns; ++i) {
        description.triangle_count += (field.cell(i, j) & detent::k_cell_hole) == 0 ? 2u : 0u;
      }
    }
  }
  const auto metres = [&](const detent::Vec32& v) {
    return std::array<double, 3>{v.x * description.step, v.y * description.step, v.z * description.step};
  };
  description.low = metres(box.low);
  description.high = metres(box.high);
  return description;
}

}  // namespace detent_cook
