#include <gtest/gtest.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <iterator>

#include "ports/host/cook/cook_compound.h"
#include "tests/unit/shape/terrains.h"

/// The surfaces of the scenes (examples/scenes/assets) are what is cooked here. Run with DETENT_WRITE_ASSETS=1 to write
/// them anew.

namespace {

using Cooked = std::vector<uint8_t>;

std::string path_of(const char* name) { return std::string(DETENT_SCENE_ASSETS) + "/" + name; }

Cooked read(const std::string& path) {
  Cooked bytes;
  if (FILE* file = fopen(path.c_str(), "rb")) {
    for (int c = fgetc(file); c != EOF; c = fgetc(file)) bytes.push_back(static_cast<uint8_t>(c));
    fclose(file);
  }
  return bytes;
}

void expect_committed(const char* name, const Cooked& bytes) {
  ASSERT_FALSE(bytes.empty());
  const std::string path = path_of(name);
  if (getenv("DETENT_WRITE_ASSETS") != nullptr) {
    FILE* file = fopen(path.c_str(), "wb");
    ASSERT_NE(file, nullptr);
    EXPECT_EQ(fwrite(bytes.data(), 1, bytes.size(), file), bytes.size());
    EXPECT_EQ(fclose(file), 0);
  }
  EXPECT_TRUE(read(path) == bytes) << path;
}

/// A valley along z with a wall across it, 8 m by 8 m.
TEST(scene_assets, have_the_valley) {
  const auto height = [](double x, double z) { return 0.5 * fabs(x) + (fabs(z) > 3.5 ? 1.0 : 0.0); };
  expect_committed("valley.mesh", detent_cook::cook_mesh(detent_terrains::ground(8, 1, height), {}).bytes);
}

/// Hills of 12 m by 12 m.
TEST(scene_assets, have_the_hills) {
  detent_cook::HeightFieldSource source;
  source.columns = source.rows = 8;
  source.origin = {-6, 0, -6};
  source.spacing_x = source.spacing_z = 1.5;
  for (uint32_t j = 0; j <= 8; ++j) {
    for (uint32_t i = 0; i <= 8; ++i) source.heights.push_back(((i * i + 3 * j) % 5) * 0.1875 - 0.125 * (j % 3));
  }
  expect_committed("hills.field", detent_cook::cook_height_field(source).bytes);
}

/// Two balls of different weights on a bar, with a box across it.
TEST(scene_assets, have_the_dumbbell) {
  using Part = detent_cook::CompoundPart;
  const Part ball = {Part::Kind::ball, {{-0.5, 0, 0}}, 0.25, 1}, heavy = {Part::Kind::ball, {{0.5, 0, 0}}, 0.1875, 4};
  const Part bar = {Part::Kind::capsule, {{-0.5, 0, 0}, {0.5, 0, 0}}, 0.0625, 1};
  const Part box = {Part::Kind::hull, detent_cook::box_points({0, 0, 0}, {0.0625, 0.125, 0.375}, {0, 0, 0, 1}), 0, 1};
  expect_committed("dumbbell.compound", detent_cook::cook_compound({ball, heavy, bar, box}).bytes);
}

}  // namespace
