#include "play.h"

namespace detent_tool {
namespace {

/// Whether these are all problems of a scene that is `format` and, from line 2 on, this.
void expect_refused(const std::string& text, const std::string& problems) {
  EXPECT_EQ(play("{\"format\": 1,\n" + text + "}").problems, problems) << text;
}
/// The same of a body's keys beside its shape.
void expect_body_refused(const std::string& text, const std::string& problems) {
  expect_refused("\"bodies\": [{\"shape\": {\"type\": \"sphere\", \"radius\": 1},\n" + text + "}]", problems);
}
void expect_shape_refused(const std::string& text, const std::string& problems) {
  expect_refused("\"bodies\": [{\"shape\": {\n" + text + "}}]", problems);
}
/// Of an action beside a body `ball`.
void expect_action_refused(const std::string& text, const std::string& problems) {
  expect_refused(
      "\"bodies\": [{\"name\": \"ball\", \"shape\": {\"type\": \"sphere\", \"radius\": 1}}], \"actions\": [\n{" + text +
          "}]",
      problems);
}

TEST(scene_refuses, what_is_no_scene) {
  EXPECT_EQ(play("[]").problems, "1: is not an object\n");
  EXPECT_EQ(play("{}").problems, "1: format: is missing\n");
  EXPECT_EQ(play("{\n\"format\": 2}").problems, "2: format: 2 is not in [1, 1]\n");
  EXPECT_EQ(play("{\"format\": 1").problems.substr(0, 15), "1: syntax error");
}

TEST(scene_refuses, values_of_another_kind) {
  expect_refused("\"ticks\": \"many\"", "2: ticks: is not a number\n");
  expect_refused("\"ticks\": 1.5", "2: ticks: 1.5 is not a whole number\n");
  expect_refused("\"ticks\": -1", "2: ticks: -1 is not in [0, 1e+09]\n");
  expect_refused("\"description\": 1", "2: description: is not a text\n");
  expect_refused("\"world\": []", "2: world: is not an object\n");
  expect_refused("\"world\": {\n\"sleeping\": 0}", "3: world.sleeping: is not true or false\n");
  expect_refused("\"bodies\": {}", "2: bodies: is not a list\n");
  expect_refused("\"bodies\": [null]", "2: bodies[0]: is not an object\n");
  expect_refused("\"materials\": []", "2: materials: is not an object\n");
  expect_refused("\"world\": {\"gravity\": [0, 1]}", "2: world.gravity: is not a list of 3 numbers\n");
  expect_refused("\"world\": {\"gravity\": [0,\n\"1\", 0]}", "3: world.gravity[1]: is not a number\n");
  expect_refused("\"world\": {\"reduction\": 1}", "2: world.reduction: is not a text\n");
  expect_body_refused("\"rotation_locks\": \"x\"", "3: bodies[0].rotation_locks: is not a list\n");
}

TEST(scene_refuses, values_out_of_range) {
  expect_refused("\"world\": {\"tick\": 1}", "2: world.tick: 1 is not in [6.103515625e-05, 0.25]\n");
  expect_refused("\"world\": {\"gravity\": [0, -1025, 0]}", "2: world.gravity[1]: -1025 is not in [-1024, 1024]\n");
  expect_refused("\"materials\": {\"ice\": {\n\"friction\": -1}}", "3: materials.ice.friction: -1 is not in [0, 16]\n");
  expect_body_refused("\"density\": 0", "3: bodies[0].density: 0 is not above 0\n");
  expect_body_refused("\"mass\": -1", "3: bodies[0].mass: -1 is below 0\n");
  expect_body_refused("\"user_data\": 4294967296", "3: bodies[0].user_data: 4294967296 is not in [0, 4294967295]\n");
  expect_body_refused("\"position\": [0, 1e300, 0]", "3: bodies[0].position[1]: 1e+300 is out of range\n");
  expect_body_refused("\"density\": 1e200", "3: bodies[0].density: 1e+200 is out of range\n");
  expect_body_refused("\"angular_velocity\": [1e6, 0, 0]", "3: bodies[0].angular_velocity[0]: 1e+06 is out of range\n");
  expect_shape_refused("\"type\": \"sphere\",\n\"radius\": 0",
                       "4: bodies[0].shape.radius: 0 is not in [6.103515625e-05, 16384]\n");
}

TEST(scene_refuses, rotations_that_are_none) {
  expect_body_refused("\"rotation\": [0, 0, 0, 0.9]", "3: bodies[0].rotation: the quaternion's length is not 1\n");
  expect_body_refused("\"rotation\": [0, 0, 1]", "3: bodies[0].rotation: is not a list of 4 numbers\n");
  expect_body_refused("\"rotation\": {\"axis\": [0, 0, 0], \"degrees\": 1}",
                      "3: bodies[0].rotation.axis: has no direction\n");
  expect_body_refused("\"rotation\": {\"axis\": [0, 0, 1]}", "3: bodies[0].rotation.degrees: is missing\n");
  expect_body_refused("\"rotation\": {\"euler_degrees\": [0, 0, 1], \"axis\": 1}",
                      "3: bodies[0].rotation.axis: is unknown here; there are: euler_degrees\n");
  expect_body_refused("\"rotation\": {\"euler_degrees\": [0, 0, 36001]}",
                      "3: bodies[0].rotation.euler_degrees[2]: 36001 is not in [-36000, 36000]\n");
}

TEST(scene_refuses, unknown_keys_and_names_with_the_nearest) {
  expect_refused("\"bodys\": []", "2: bodys: is unknown here, did you mean \"bodies\"?\n");
  expect_shape_refused("\"type\": \"sphere\", \"radius\": 1,\n\"half_extents\": [1, 1, 1]",
                       "4: bodies[0].shape.half_extents: is unknown here; there are: type, radius\n");
  expect_shape_refused("\"type\": \"shpere\", \"radius\": 1",
                       "3: bodies[0].shape.type: \"shpere\" is unknown, did you mean \"sphere\"?\n");
  expect_shape_refused("\"radius\": 1", "2: bodies[0].shape.type: is missing\n");
  expect_shape_refused("\"type\": \"box\"", "2: bodies[0].shape.half_extents: is missing\n");
  expect_body_refused("\"type\": \"dynmic\"", "3: bodies[0].type: \"dynmic\" is unknown, did you mean \"dynamic\"?\n");
  expect_body_refused("\"rotation_locks\": [\"x\", \"w\"]",
                      "3: bodies[0].rotation_locks[1]: \"w\" is unknown, did you mean \"x\"?\n");
  expect_body_refused("\"material\": \"ice\"", "3: bodies[0].material: no material has the name \"ice\"\n");
  expect_action_refused("\"tick\": 0, \"call\": \"aply_impulse\"",
                        "3: actions[0].call: \"aply_impulse\" is unknown, did you mean \"apply_impulse\"?\n");
  expect_action_refused("\"tick\": 0, \"call\": \"wake_body\", \"body\": \"bal\"",
                        "3: actions[0].body: no body has the name \"bal\", did you mean \"ball\"?\n");
  expect_action_refused("\"tick\": 0, \"call\": \"destroy_joint\", \"joint\": \"ball\"",
                        "3: actions[0].joint: no joint has the name \"ball\"\n");
}

TEST(scene_refuses, names_that_are_taken) {
  expect_refused(
      "\"bodies\": [{\"name\": \"a\", \"shape\": {\"type\": \"half_space\"}, \"type\": \"fixed\"},\n"
      "{\"name\": \"a\", \"shape\": {\"type\": \"half_space\"}, \"type\": \"fixed\"}]",
      "3: bodies[1].name: \"a\" is taken\n");
  expect_action_refused(
      "\"tick\": 1, \"call\": \"create_body\", \"body\": {\"name\": \"ball\", \"shape\": {\"type\": \"sphere\", "
      "\"radius\": 1}}",
      "3: actions[0].body: a body of the name \"ball\" is there\n");
}

TEST(scene_refuses, keys_that_do_not_go_together) {
  const std::string ball = "\"shape\": {\"type\": \"sphere\", \"radius\": 1}}";
  const std::string ends = "\"bodies\": [{\"name\": \"a\", " + ball + ", {\"name\": \"b\", " + ball + "], ";
  expect_refused(ends + "\"joints\": [{\"a\": \"a\", \"b\": \"b\",\n\"frame\": [0, 0, 0, 1]}]",
                 "3: joints[0].frame: goes with `point`\n");
  expect_refused(ends + "\"joints\": [{\"a\": \"a\", \"b\": \"b\", \"point\": [0, 0, 0],\n\"anchor_a\": [0, 0, 0]}]",
                 "3: joints[0].anchor_a: does not go with `point`\n");
  expect_action_refused(
      "\"tick\": 0, \"call\": \"apply_impulse\", \"body\": \"ball\", \"impulse\": [1, 0, 0], \"arm\": [0, 0, 0],\n"
      "\"point\": [0, 0, 0]",
      "4: actions[0].point: does not go with `arm`\n");
  expect_action_refused("\"tick\": 3, \"until\": 2, \"call\": \"wake_body\", \"body\": \"ball\"",
                        "3: actions[0].until: is below `tick`\n");
}

TEST(scene_refuses, what_the_library_refuses) {
  expect_refused("\"bodies\": [{\"shape\": {\"type\": \"half_space\"}}]",
                 "2: bodies[0].type: is dynamic, which a half-space or terrain cannot be\n");
  const std::string ball = "{\"name\": \"a\", \"shape\": {\"type\": \"sphere\", \"radius\": 1}}";
  expect_refused("\"world\": {\"capacity\": {\"bodies\": 1}}, \"bodies\": [" + ball +
                     ",\n{\"shape\": {\"type\": \"sphere\", \"radius\": 1}}]",
                 "3: bodies[1]: cannot be made: the capacity is used up\n");
  expect_refused("\"bodies\": [" + ball + "],\n\"joints\": [{\"a\": \"a\", \"b\": \"a\"}]",
                 "3: joints[0].b: is `a`, too\n");
  const std::string still = "\"type\": \"fixed\", \"shape\": {\"type\": \"half_space\"}}";
  expect_refused("\"bodies\": [{\"name\": \"a\", " + still + ", {\"name\": \"b\", " + still +
                     "],\n\"joints\": [{\"a\": \"a\", \"b\": \"b\"}]",
                 "3: joints[0]: cannot be made: neither body is dynamic\n");
  expect_body_refused("\"mass\": 1e-25", "2: bodies[0]: cannot be made: out of range\n");
  expect_action_refused("\"tick\": 7, \"until\": 9, \"call\": \"destroy_body\", \"body\": \"ball\"",
                        "3: actions[0]: destroy_body before tick 8: what it names is not there\n");
  expect_refused("\"world\": {\"capacity\": {\"bodies\": 1048576, \"contacts\": 1048576}}",
                 "0: its world would take more than 1024 MB: less capacity will do\n");
}

TEST(scene_refuses, cooked_files_that_are_none) {
  expect_shape_refused("\"type\": \"hull\",\n\"file\": \"gone.hull\"",
                       "4: bodies[0].shape.file: gone.hull cannot be read: No such file or directory\n");
  expect_shape_refused("\"type\": \"hull\",\n\"file\": \"every.json\"",
                       "4: bodies[0].shape.file: every.json is not a cooked file\n");
  const std::string hull = "../../../examples/scenes/assets/round.hull";
  expect_shape_refused("\"type\": \"compound\",\n\"file\": \"" + hull + "\"",
                       "4: bodies[0].shape.file: " + hull + " is a cooked hull, not a cooked compound\n");
  expect_shape_refused("\"type\": \"hull\", \"file\": \"" + hull + "\",\n\"digest\": \"12\"",
                       "4: bodies[0].shape.digest: has not 16 digits\n");
  const std::string wrong = play("{\"format\": 1, \"bodies\": [{\"shape\": {\"type\": \"hull\", \"file\": \"" + hull +
                                 "\",\n\"digest\": \"0000000000000000\"}}]}")
                                .problems;
  const std::string said = "2: bodies[0].shape.digest: that of " + hull + " is 4f0f52c6";
  EXPECT_EQ(wrong.substr(0, said.size()), said) << wrong;
}

TEST(scene_refuses, with_every_problem_up_to_a_screenful) {
  std::string bodies;
  for (int i = 0; i < 100; ++i) bodies += std::string(i == 0 ? "" : ",") + "\n{}";
  const std::string problems = play("{\"format\": 1, \"bodies\": [" + bodies + "]}").problems;
  EXPECT_EQ(problems.substr(0, 34), "2: bodies[0].shape: is missing\n3: ");
  EXPECT_EQ(std::count(problems.begin(), problems.end(), '\n'), 20);
}

/// What is let in can be played: in a build with sanitizers any fault ends the program.
TEST(scene_refuses, or_plays_whatever_is_damaged) {
  const std::string whole = file_text(DETENT_ROOT "/tests/tool/scene_files/every.json");
  const std::string letters = "{}[]:,\"0123456789.-+eE \ntrufalsn\\\x80";
  uint32_t random = 1, refused = 0, played = 0;
  const auto below = [&random](size_t limit) {
    random = random * 1664525u + 1013904223u;
    return static_cast<size_t>(random >> 8) % limit;
  };
  for (int round = 0; round < 400; ++round) {
    std::string text = whole;
    const size_t place = below(text.size() - 60), length = below(40), to = below(text.size());
    const size_t letter = below(letters.size()), displacement = below(4);
    if (displacement == 0) text.erase(place, length);
    if (displacement == 1) text.insert(to, text.substr(place, length));
    if (displacement == 2) text[place] = letters[letter];
    if (displacement == 3) text[text.find_first_of("0123456789", place)] = static_cast<char>('0' + letter % 10);
    const Played result = play(text, engines().front(), 4);
    (result.problems.empty() ? played : refused) += 1;
  }
  EXPECT_GT(refused, 100u);
  EXPECT_GT(played, 30u);
}

}  // namespace
}  // namespace detent_tool
