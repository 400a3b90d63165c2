#include <gtest/gtest.h>
#include <stdio.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>

#include "tests/campaigns/zoo/random_list.h"
#include "tests/campaigns/zoo/random_scene.h"
#include "tests/campaigns/zoo/visit.h"
#include "tests/common/support/random.h"

namespace detent_zoo {
namespace {

const std::string k_folder = DETENT_ROOT "/tests/campaigns/zoo/scenes";

/// Records the scene, writes its page, and says where they are.
void leave_page(const std::string& folder, const Entry& entry, const std::string& config) {
  const std::string command = "'" DETENT_ROOT "/tests/common/leave_page' '" DETENT_TOOL "' '" DETENT_FAILED "' '" +
                              folder + "/" + entry.scene + ".json' " + config;
  fflush(stdout);  // it prints to the same stream
  EXPECT_EQ(system(command.c_str()), 0);
}

/// Plays a scene of the list in one configuration: the failed checks must be the gaps of zoo.csv.
class SceneTest : public testing::Test {
 public:
  SceneTest(const Entry& entry, const Engine& engine) : entry_(entry), engine_(engine) {}
  void TestBody() override {
    EXPECT_EQ(surprises(entry_, engine_.config, visit(entry_, engine_, k_folder)), "");
    if (HasFailure()) leave_page(k_folder, entry_, engine_.config);
  }

 private:
  Entry entry_;
  Engine engine_;
};

/// Plays the random scenes in one configuration: the failed checks must be the gaps of random.csv. Leaves the page of
/// the first that is not as listed.
class RandomScenesTest : public testing::Test {
 public:
  explicit RandomScenesTest(const Engine& engine) : engine_(engine) {}
  void TestBody() override {
    const std::string folder = std::string(DETENT_RANDOM_SCENES "/") + engine_.config;
    std::string problem;
    const std::vector<Entry> known = read_list(DETENT_ROOT "/tests/campaigns/zoo/random.csv", problem);
    for (uint64_t seed = 1; seed <= k_seeds_tested; ++seed) {
      const Entry entry = write_random_scene(seed, folder, k_folder, known, problem);
      ASSERT_EQ(problem, "");
      const bool failed_before = HasFailure();
      EXPECT_EQ(surprises(entry, engine_.config, visit(entry, engine_, folder)), "") << entry.scene;
      if (HasFailure() && !failed_before) leave_page(folder, entry, engine_.config);
    }
  }

 private:
  Engine engine_;
};

std::string list_problem;

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = read_list(DETENT_ROOT "/tests/campaigns/zoo/zoo.csv", list_problem);
  return all;
}

}  // namespace

void register_scenes();
void register_scenes() {
  for (const Engine& engine : all_engines()) {
    testing::RegisterTest("zoo_random", engine.config, nullptr, nullptr, __FILE__, __LINE__,
                          [engine]() -> RandomScenesTest* { return new RandomScenesTest(engine); });
  }
  for (const Entry& entry : entries()) {
    for (const Engine& engine : all_engines()) {
      testing::RegisterTest("zoo", (entry.scene + "_" + engine.config).c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [entry, engine]() -> SceneTest* { return new SceneTest(entry, engine); });
    }
  }
}

namespace {

TEST(zoo_random_text, is_the_same_text_on_every_machine) {
  uint64_t digest = 0;
  for (uint64_t seed = 1; seed <= 1000; ++seed) {
    for (const char letter : random_scene(seed).text) {
      digest ^= static_cast<unsigned char>(letter);
      digest = detent_test::split_mix(digest);
    }
  }
  EXPECT_EQ(digest, 16830981122110861535u);
}

TEST(zoo_list, can_be_read_and_every_scene_lies_in_the_folder) {
  EXPECT_EQ(list_problem, "");
  std::set<std::string> names;
  for (const Entry& entry : entries()) {
    EXPECT_TRUE(std::ifstream(k_folder + "/" + entry.scene + ".json").good()) << entry.scene;
    EXPECT_TRUE(names.insert(entry.scene).second) << entry.scene << " is there twice";
    EXPECT_FALSE(entry.source.empty()) << entry.scene;
  }
}

TEST(zoo_list, is_written_as_it_is_read) {
  const std::string path = testing::TempDir() + "zoo_list.csv";
  ASSERT_TRUE(write_list(path, entries()));
  const auto text = [](const std::string& name) {
    std::ifstream file(name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(text(path), text(DETENT_ROOT "/tests/campaigns/zoo/zoo.csv"));
}

TEST(zoo_list, says_the_line_of_what_is_wrong) {
  const std::string path = testing::TempDir() + "zoo_wrong.csv";
  for (const char* row : {"a,b,rest,,", "a,b,gap=,,", "a,b,gap=1x,,", "a,b,stand,,", "a,b,asleep,,", "a,b,,,fx64",
                          "a,b,,,fx64:gip", "a,b,,"}) {
    std::ofstream(path) << "scene,source,wants,why,gaps\ngood,own,rests gap=0.5,\"one, two\",fx64:gap+rest\n"
                        << row << "\n";
    std::string problem;
    EXPECT_TRUE(read_list(path, problem).empty());
    EXPECT_EQ(problem.substr(0, path.size() + 4), path + ":3: ") << row;
  }
}

}  // namespace

}  // namespace detent_zoo

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  detent_zoo::register_scenes();
  return RUN_ALL_TESTS();
}
