#pragma once
#include <gtest/gtest.h>
#include <stdio.h>
#include <stdlib.h>

#include <string>

#include "ports/host/cook/read_mesh.h"
#include "tests/geometry/surfaces.h"

/// Real levels, of the public data sets under $DETENT_DATA.
namespace detent_surfaces {

inline constexpr const char* k_levels[] = {"building.obj", "stairs.obj", "conveyor.obj", "test_map01.obj",
                                           "voxel_mesh_01.obj"};

/// False if it is not at hand.
inline bool read_level(const char* name, Source& source) {
  const char* folder = getenv("DETENT_DATA");
  std::string text;
  if (FILE* file = fopen((std::string(folder != nullptr ? folder : "") + "/meshes/" + name).c_str(), "rb")) {
    char piece[4096];
    for (size_t count = 1; (count = fread(piece, 1, sizeof piece, file)) > 0;) text.append(piece, count);
    fclose(file);
  }
  if (text.empty()) return false;
  const detent_cook::MeshRead read = detent_cook::read_obj_mesh(text);
  EXPECT_EQ(read.problem, "") << name;
  source = read.mesh;
  return true;
}

}  // namespace detent_surfaces
