#include <regex>

#include "play.h"
#include "scene_repeat.h"
#include "scene_revolve.h"

namespace detent_tool {
namespace {

const std::string k_head =
    "{\"format\": 1, \"ticks\": 30, \"shapes\": {\"plank\": {\"type\": \"box\", "
    "\"half_extents\": [0.5, 0.125, 0.5]}},\n";

std::string bodies(const std::string& text) { return k_head + "\"bodies\": [" + text + "]}"; }

/// Whether all problems of bodies of the shape `plank` with these keys are those.
void expect_refused(const std::string& keys, const std::string& problems) {
  EXPECT_EQ(play(bodies("{\"shape\": \"plank\", " + keys + "}")).problems, problems) << keys;
}

/// That the same comes of both in every configuration, to the last bit of the recording.
void expect_alike(const std::string& repeated, const std::string& written_out) {
  for (const Engine& engine : engines()) {
    const Played a = play(repeated, engine), b = play(written_out, engine);
    EXPECT_EQ(a.problems, "");
    EXPECT_EQ(b.problems, "");
    EXPECT_EQ(a.lines, b.lines) << engine.config;
    EXPECT_EQ(a.recording, b.recording) << engine.config;
  }
}

TEST(scene_repeat, is_the_same_as_written_out) {
  const std::string post = "{\"name\": \"post\", \"type\": \"fixed\", \"position\": [-1, 4, 0], \"shape\": \"plank\"}";
  expect_alike(
      bodies(post + R"(, {"name": "plank {i} {j}", "repeat": {"i": 2, "j": 2}, "step": {"i": [1, 0, 0], "j": [0, 0, 2]},
             "position": [0, 4, 0], "shape": "plank"}], "joints": [
             {"type": "hinge", "a": "post", "b": "plank 0 0", "point": [-0.5, 4, 0]},
             {"name": "pin {j}", "repeat": {"i": 1, "j": 2}, "step": {"j": [0, 0, 2]}, "type": "hinge",
              "a": "plank {i} {j}", "b": "plank {i+1} {j}", "point": [0.5, 4, 0]}], "actions": [
             {"repeat": {"i": 2}, "step": {"i": [0, 0, 1]}, "tick": 5, "call": "create_body",
              "body": {"name": "load {i}", "position": [0, 6, 0], "shape": "plank"}},
             {"repeat": {"k": 2}, "tick": 20, "call": "destroy_body", "body": "load {k}"})"),
      bodies(post + R"(, {"name": "plank 0 0", "position": [0, 4, 0], "shape": "plank"},
             {"name": "plank 0 1", "position": [0, 4, 2], "shape": "plank"},
             {"name": "plank 1 0", "position": [1, 4, 0], "shape": "plank"},
             {"name": "plank 1 1", "position": [1, 4, 2], "shape": "plank"}], "joints": [
             {"type": "hinge", "a": "post", "b": "plank 0 0", "point": [-0.5, 4, 0]},
             {"name": "pin 0", "type": "hinge", "a": "plank 0 0", "b": "plank 1 0", "point": [0.5, 4, 0]},
             {"name": "pin 1", "type": "hinge", "a": "plank 0 1", "b": "plank 1 1", "point": [0.5, 4, 2]}], "actions": [
             {"tick": 5, "call": "create_body", "body": {"name": "load 0", "position": [0, 6, 0], "shape": "plank"}},
             {"tick": 5, "call": "create_body", "body": {"name": "load 1", "position": [0, 6, 1], "shape": "plank"}},
             {"tick": 20, "call": "destroy_body", "body": "load 0"},
             {"tick": 20, "call": "destroy_body", "body": "load 1"})"));
}

/// Where the bodies are after a tick, to a micrometre: a turn is rounded.
std::string places(const std::string& text, const Engine& engine) {
  const Played played = play(text, engine, 1);
  EXPECT_EQ(played.problems, "");
  const std::string lines =
      std::regex_replace(played.lines.substr(played.lines.find("1 at")), std::regex("-0[.]000000"), "0.000000");
  return lines;
}

TEST(scene_repeat, turns_places_rotations_and_velocities) {
  const std::string repeated =
      bodies(R"({"repeat": {"i": 3}, "revolve": {"i": {"about": [0, 4, 0], "axis": [0, 0, 2], "degrees": 180}},
                "position": [2, 4, 1], "linear_velocity": [1, 0, 3], "angular_velocity": [0, 5, 1], "shape": "plank"},
                {"repeat": {"i": 2}, "revolve": {"i": {"axis": [0, 1, 0], "degrees": 360}}, "shape": "plank"})");
  const std::string written_out =
      bodies(R"({"position": [2, 4, 1], "linear_velocity": [1, 0, 3], "angular_velocity": [0, 5, 1], "shape": "plank"},
                {"position": [-2, 4, 1], "rotation": [0, 0, -1, 0], "linear_velocity": [-1, 0, 3], "angular_velocity": [0, -5, 1],
                 "shape": "plank"},
                {"position": [2, 4, 1], "linear_velocity": [1, 0, 3], "angular_velocity": [0, 5, 1], "shape": "plank"},
                {"shape": "plank"}, {"shape": "plank"})");
  for (const Engine& engine : engines()) {
    EXPECT_EQ(places(repeated, engine), places(written_out, engine)) << engine.config;
  }
}

Node parsed(const std::string& text) {
  Node root;
  Problem problem;
  EXPECT_TRUE(parse_json(text, root, problem)) << problem.text;
  return root;
}

TEST(scene_repeat, turns_every_form_of_a_rotation) {
  const double half = 0.70710678118654752440;
  for (const char* form : {R"({"axis": [1, 0, 0], "degrees": 90})", R"({"euler_degrees": [90, 0, 0]})",
                           R"({"euler_degrees": [90, 0, 360]})", "[0.70710678118654752, 0, 0, 0.70710678118654752]"}) {
    Node entry = parsed(std::string(R"({"point": [1, 0, 0], "frame": )") + form + "}");
    SceneRevolution revolution;
    revolution.about[1] = 1;
    revolution.axis[2] = 3;
    revolution.degrees = 90;
    revolve_entry(entry, revolution);
    const Node& frame = *member_of(entry, "frame");
    const double expected[4] = {0.5, 0.5, 0.5, 0.5};
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(frame.items[i].number, expected[i], 1e-15) << form << i;
    const Node& point = *member_of(entry, "point");
    EXPECT_NEAR(point.items[0].number, 1, 1e-15);
    EXPECT_NEAR(point.items[1].number, 2, 1e-15);
  }
  Node plain = parsed(R"({"position": [1, 0, 0]})");
  SceneRevolution revolution;
  revolution.axis[1] = 1;
  revolution.degrees = -90;
  revolve_entry(plain, revolution);
  EXPECT_NEAR(member_of(plain, "rotation")->items[1].number, -half, 1e-15);
  EXPECT_NEAR(member_of(plain, "position")->items[2].number, 1, 1e-15);
}

TEST(scene_repeat, tells_the_entry_of_the_file_and_the_copy) {
  EXPECT_EQ(play(bodies(R"({"name": "p {i} {j}", "repeat": {"i": 2, "j": 2}, "shape": "plank"},
{"shape": "plunk"}], "joints": [{"repeat": {"i": 2}, "a": "p {i} 0",
"b": "p {i+1} 0", "point": [0, 0, 0]})"))
                .problems,
            "3: bodies[1].shape: no shape has the name \"plunk\"\n");
  EXPECT_EQ(play(bodies(R"({"name": "p {i} {j}", "repeat": {"i": 2, "j": 2}, "shape": "plank"}], "joints": [
{"repeat": {"i": 2}, "a": "p {i} 0", "b": "p {i+1} 0", "point": [0, 0, 0]})"))
                .problems,
            "3: joints[0]{i=1}.b: no body has the name \"p 2 0\", did you mean \"p 0 0\"?\n");
  expect_refused("\"repeat\": {\"i\": 2},\n\"mass\": -1", "3: bodies[0]{i=0}.mass: -1 is below 0\n");
  expect_refused("\"name\": \"all\", \"repeat\": {\"i\": 3}",
                 "2: bodies[0]{i=1}.name: \"all\" is taken\n2: bodies[0]{i=2}.name: \"all\" is taken\n");
}

TEST(scene_repeat, refuses_what_is_wrong) {
  expect_refused("\"repeat\": 3", "2: bodies[0].repeat: is not an object\n");
  expect_refused("\"repeat\": {}", "2: bodies[0].repeat: has no letter: i, j or k\n");
  expect_refused("\"repeat\": {\"n\": 3}", "2: bodies[0].repeat.n: is unknown here; there are: i, j, k\n");
  expect_refused("\"repeat\": {\"i\":\n\"3\"}", "3: bodies[0].repeat.i: is not a number\n");
  expect_refused("\"repeat\": {\"i\": 1.5}", "2: bodies[0].repeat.i: is not a whole number\n");
  expect_refused("\"repeat\": {\"i\": 0}", "2: bodies[0].repeat.i: is not in [1, 4096]\n");
  expect_refused("\"repeat\": {\"i\": 4097}", "2: bodies[0].repeat.i: is not in [1, 4096]\n");
  expect_refused("\"repeat\": {\"i\": 4096, \"j\": 17}", "2: bodies[0].repeat: is more than 65536 copies\n");
  expect_refused("\"repeat\": {\"i\": 2}, \"step\": [1, 0, 0]", "2: bodies[0].step: is not an object\n");
  expect_refused("\"repeat\": {\"i\": 2}, \"step\": {\"j\": [1, 0, 0]}",
                 "2: bodies[0].step.j: has no count in `repeat`\n");
  expect_refused("\"repeat\": {\"i\": 2}, \"step\": {\"i\": [1, 0]}",
                 "2: bodies[0].step.i: is not a list of 3 numbers\n");
  expect_refused("\"repeat\": {\"i\": 2}, \"revolve\": {\"i\": {\"axis\": [0, 0, 0], \"degrees\": 1}}",
                 "2: bodies[0].revolve.i.axis: has no direction\n");
  expect_refused("\"repeat\": {\"i\": 2}, \"revolve\": {\"i\": {\"axis\": [0, 0, 1]}}",
                 "2: bodies[0].revolve.i.degrees: is missing\n");
  expect_refused("\"repeat\": {\"i\": 2}, \"revolve\": {\"i\": {\"axes\": [0, 0, 1]}}",
                 "2: bodies[0].revolve.i.axes: is unknown here, did you mean \"axis\"?\n");
  expect_refused("\"step\": {\"i\": [1, 0, 0]}", "2: bodies[0].step: goes with `repeat`\n");
  for (const char* name : {"{n}", "{j}", "{i", "{}", "{i*2}", "{i+}", "{i+1.5}", "{ii}", "{i+99999999999}"}) {
    expect_refused("\"repeat\": {\"i\": 2}, \"name\": \"" + std::string(name) + "\"",
                   "2: bodies[0].name: \"" + std::string(name) +
                       "\": in braces is a letter of `repeat`, or one + or - a number\n");
  }
  EXPECT_EQ(play(bodies("{\"name\": \"p {i}\", \"repeat\": {\"i\": 2}, \"shape\": \"plank\"}], \"joints\": ["
                        "{\"repeat\": {\"i\": 1}, \"step\": {\"i\": [1, 0, 0]}, \"a\": \"p 0\", \"b\": \"p 1\"}"))
                .problems,
            "2: joints[0].step: moves nothing: there is no point or position\n");
  EXPECT_EQ(play(bodies("{\"shape\": \"plank\"}], \"actions\": [{\"tick\": 0, \"call\": \"create_body\", \"body\": "
                        "{\"repeat\": {\"i\": 2}, \"shape\": \"plank\"}}"))
                .problems,
            "2: actions[0].body.repeat: is for entries of the scene's lists\n");
}

TEST(scene_repeat, tells_a_screenful_of_problems) {
  std::string many;
  for (int i = 0; i < 100; ++i) many += std::string(i == 0 ? "" : ",") + "{\"repeat\": 0}";
  const std::string problems = play(bodies(many)).problems;
  EXPECT_EQ(std::count(problems.begin(), problems.end(), '\n'), 20);
}

TEST(scene_repeat, refuses_a_scene_that_would_grow_too_large) {
  const std::string many = "{\"repeat\": {\"i\": 4096, \"j\": 16}, \"shape\": \"plank\"}";
  EXPECT_EQ(play(bodies(many + ",\n{\"repeat\": {\"i\": 1}, \"shape\": \"plank\"}")).problems,
            "3: bodies[1].repeat: the scene would have more than 65536 copies\n");
  std::string keys;
  for (int i = 0; i < 20; ++i) keys += ", \"key " + std::to_string(i) + "\": 0";
  EXPECT_EQ(play(bodies("{\"repeat\": {\"i\": 4096, \"j\": 16}" + keys + "}")).problems,
            "2: bodies[0].repeat: the scene would have more than 1048576 values\n");
  EXPECT_EQ(play(bodies("{\"repeat\": {\"i\": 4096}, \"name\": \"" + std::string(10000, 'a') + "\"}")).problems,
            "2: bodies[0].repeat: the scene would have more than 33554432 bytes of text\n");
}

}  // namespace
}  // namespace detent_tool
