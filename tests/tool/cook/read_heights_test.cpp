#include "read_heights.h"

#include <gtest/gtest.h>

namespace {

using namespace detent_cook;

TEST(read_heights, takes_text_and_binary_pictures_alike) {
  const std::string text = "P2\n# made by hand\n3 2 # samples\n500\n0 100 200\n300 400 500\n";
  const std::string binary = std::string("P5 3 2 500\n") + std::string("\0\0\0\x64\0\xc8\x01\x2c\x01\x90\x01\xf4", 12);
  for (const std::string& bytes : {text, binary}) {
    const HeightsRead read = read_pgm(bytes, 2, 10);
    EXPECT_EQ(read.problem, "");
    EXPECT_EQ(read.field.columns, 2u);
    EXPECT_EQ(read.field.rows, 1u);
    EXPECT_EQ(read.field.heights, (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(read.field.origin, (Point{-2, 0, -1}));
    EXPECT_FALSE(cook_height_field(read.field).bytes.empty());
  }
  EXPECT_EQ(read_pgm(std::string("P5\n2 2\n255\n\n\x0a\xff\x20", 15), 1, 255).field.heights,
            (std::vector<double>{10, 10, 255, 32}));  // bytes that look like spaces
}

TEST(read_heights, names_what_is_wrong) {
  EXPECT_EQ(read_pgm("P6 2 2 255 ", 1, 1).problem, "is no PGM: it starts with neither P2 nor P5");
  EXPECT_EQ(read_pgm("", 1, 1).problem, "is no PGM: it starts with neither P2 nor P5");
  for (const char* sizes : {"P2", "P2 1 2 9", "P2 2 1 9", "P2 4098 2 9", "P2 2 99999999999 9", "P2 -2 2 9"})
    EXPECT_EQ(read_pgm(sizes, 1, 1).problem, "a height field has 2 to 4097 samples along each side") << sizes;
  for (const char* most : {"P2 2 2", "P2 2 2 0", "P2 2 2 65536"})
    EXPECT_EQ(read_pgm(most, 1, 1).problem, "the brightest value is 1 to 65535") << most;
  EXPECT_EQ(read_pgm("P5 2 2 9", 1, 1).problem, "the header does not end");
  EXPECT_EQ(read_pgm("P2 2 2 9 1 2 3", 1, 1).problem, "pixel 3 is missing, or brighter than the brightest");
  EXPECT_EQ(read_pgm("P2 2 2 9 1 2 10 3", 1, 1).problem, "pixel 2 is missing, or brighter than the brightest");
  EXPECT_EQ(read_pgm("P5 2 2 9\n\1\2\3", 1, 1).problem, "pixel 3 is missing, or brighter than the brightest");
}

}  // namespace
