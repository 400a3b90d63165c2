#pragma once
#include <gtest/gtest.h>

#include "ports/host/cook/read_mesh.h"
#include "tests/common/support/data_file.h"
#include "tests/unit/shape/terrains.h"

/// Levels of games, from public data sets under $DETENT_DATA.
namespace detent_terrains {

inline constexpr const char* k_levels[] = {"building.obj", "stairs.obj", "conveyor.obj", "test_map01.obj",
                                           "voxel_mesh_01.obj"};

/// Returns false if the level is not available.
inline bool read_level(const char* name, Source& source) {
  const std::string text = detent_test::data_file(std::string("meshes/") + name);
  if (text.empty()) return false;
  const detent_cook::MeshRead read = detent_cook::read_obj_mesh(text);
  EXPECT_EQ(read.problem, "") << name;
  source = read.mesh;
  return true;
}

}  // namespace detent_terrains
