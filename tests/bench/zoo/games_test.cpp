#include "tests/bench/zoo/games.h"

#include <gtest/gtest.h>

#include <fstream>

namespace detent_zoo {
namespace {

const std::string k_root = DETENT_ROOT;

std::vector<Entry> zoo() {
  std::string problem;
  return read_list(k_root + "/tests/campaigns/zoo/zoo.csv", problem);
}

std::string problem_of(const std::string& rows) {
  const std::string path = testing::TempDir() + "games.csv";
  std::ofstream(path) << rows;
  std::string problem;
  const bool empty = read_games(path, zoo(), problem).empty();
  EXPECT_EQ(empty, !problem.empty());
  return problem.empty() ? "" : problem.substr(path.size());
}

TEST(games, name_only_scenes_of_the_zoo) {
  std::string problem;
  EXPECT_FALSE(read_games(k_root + "/tests/bench/zoo/games.csv", zoo(), problem).empty());
  EXPECT_EQ(problem, "");
}

TEST(games, say_the_line_of_what_is_wrong) {
  EXPECT_EQ(problem_of("kind,scene\ncars,car_on_mesh\nbows,pyramid_20\n"), "");
  EXPECT_EQ(problem_of("scene,kind\n"), ":1: is not \"kind,scene\"");
  EXPECT_EQ(problem_of("kind,scene\ncars,car_on_mash\n"), ":2: \"car_on_mash\" is no scene of the zoo");
  EXPECT_EQ(problem_of("kind,scene\na,car_on_mesh\nb,car_on_mesh\n"), ":3: \"car_on_mesh\" is there twice");
  EXPECT_EQ(problem_of("kind,scene\n,car_on_mesh\n"), ":2: has no kind");
}

}  // namespace
}  // namespace detent_zoo
