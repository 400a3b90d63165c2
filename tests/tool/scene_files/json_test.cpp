#include "scene_json.h"

#include <gtest/gtest.h>

namespace detent_tool {
namespace {

std::string problem_of(const std::string& text) {
  Node root;
  Problem problem;
  if (parse_json(text, root, problem)) return "";
  return std::to_string(problem.line) + ": " + problem.text;
}

Node node_of(const std::string& text) {
  Node root;
  Problem problem;
  EXPECT_TRUE(parse_json(text, root, problem)) << problem.text;
  return root;
}

TEST(scene_json, every_value_knows_its_line) {
  const Node root = node_of("\n{\"a\": 1\n,\n\"b\":\n[2\n,true,\r\n\"x\"\n,null], \"c\":\n{\"d\":\n-3\n}\n}\n");
  EXPECT_EQ(root.line, 2u);
  ASSERT_EQ(root.keys, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(root.items[0].line, 2u);
  EXPECT_EQ(root.items[1].line, 4u);  // that of its name
  const std::vector<Node>& list = root.items[1].items;
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0].line, 5u);
  EXPECT_EQ(list[1].line, 6u);
  EXPECT_EQ(list[2].line, 7u);
  EXPECT_EQ(list[3].line, 8u);
  EXPECT_EQ(root.items[2].line, 8u);
  EXPECT_EQ(root.items[2].items[0].line, 10u);
  EXPECT_EQ(root.items[2].items[0].number, -3.0);
}

TEST(scene_json, numbers_are_the_nearest_doubles) {
  EXPECT_EQ(node_of("0.1").number, 0.1);
  EXPECT_EQ(node_of("9007199254740993").number, 9007199254740992.0);
  EXPECT_EQ(node_of("1e23").number, 1e23);
  EXPECT_EQ(node_of("2.2250738585072011e-308").number, 2.2250738585072011e-308);
  EXPECT_EQ(node_of("1e-400").number, 0.0);
  EXPECT_EQ(node_of("123456789012345678901234567890").number, 123456789012345678901234567890.0);
}

TEST(scene_json, what_is_no_json_is_refused_with_its_line) {
  EXPECT_EQ(problem_of("{\"a\": 1,\n \"b\": }"),
            "2: syntax error while parsing value - unexpected '}'; expected '[', '{', or a literal");
  EXPECT_EQ(problem_of("{\n\"a\": 1e999}"), "2: number overflow parsing '1e999'");
  for (const char* text :
       {"", "{", "[1,", "NaN", "[Infinity]", "{\"a\" 1}", "{} {}", "// 1", "\"\x80\"", "01", "{'a': 1}"}) {
    EXPECT_EQ(problem_of(text).substr(0, 15), "1: syntax error") << text;
  }
}

TEST(scene_json, a_name_that_is_there_twice_is_refused) {
  EXPECT_EQ(problem_of("{\"b\": 1,\n\"a\": 1,\n\"c\": {},\n\"a\": 2}"), "4: \"a\" is here twice, first in line 2");
  EXPECT_EQ(problem_of("[{\"a\": 1}, {\"a\": 1}]"), "");
}

TEST(scene_json, what_is_hostile_is_refused_at_its_limit) {
  const auto nested = [](size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(problem_of(nested(k_json_depth_max)), "");
  EXPECT_EQ(problem_of(nested(k_json_depth_max + 1)), "1: nested deeper than 16");
  EXPECT_EQ(problem_of(std::string(1000000, '[')), "1: nested deeper than 16");
  std::string many = "[0";
  for (uint32_t i = 2; i < k_json_values_max; ++i) many += ",0";  // with the list itself as many as may be
  EXPECT_EQ(problem_of(many + "]"), "");
  EXPECT_EQ(problem_of(many + ",\n0]"), "2: more than 1048576 values");
  EXPECT_EQ(problem_of(std::string(k_json_bytes_max + 1, ' ')), "0: more than 33554432 bytes");
}

TEST(scene_json, a_problem_is_one_line_that_no_terminal_obeys) {
  EXPECT_EQ(problem_text("a.json", {14, "bodies[3].shape.radius", "0 is not above 0"}),
            "a.json:14: bodies[3].shape.radius: 0 is not above 0");
  EXPECT_EQ(problem_text("a.json", {0, "", "cannot be read"}), "a.json: cannot be read");
  EXPECT_EQ(problem_text("a", {1, "\x1b[2J\n", "x"}), "a:1: ?[2J?: x");
  EXPECT_LT(problem_text("a", {1, std::string(5000, 'x'), "x"}).size(), 1100u);
}

}  // namespace
}  // namespace detent_tool
