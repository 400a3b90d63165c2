#include <detent/recording.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "play.h"

namespace detent_tool {
namespace {

using Json = nlohmann::ordered_json;

std::string every() { return file_text(DETENT_ROOT "/tests/tool/scene_files/every.json"); }

const Engine& engine_of(const std::string& config) {
  for (const Engine& engine : engines()) {
    if (config == engine.config) return engine;
  }
  return engines().front();
}

TEST(scene_run, every_key_is_read_in_every_configuration) {
  for (const Engine& engine : engines()) {
    const Played first = play(every(), engine), second = play(every(), engine);
    EXPECT_EQ(first.problems, "") << engine.config;
    EXPECT_EQ(first.outcome.ticks, 12u);
    EXPECT_EQ(first.lines, second.lines);
    EXPECT_EQ(first.recording, second.recording);
    EXPECT_FALSE(first.recording.empty());
  }
}

void note_keys(const Json& json, std::vector<std::string>& used) {
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) used.push_back(key);
    note_keys(value, used);
  }
}

TEST(scene_run, the_scene_of_every_key_has_every_key_and_call) {
  const Json scene = Json::parse(every());
  std::vector<std::string> used, calls;
  note_keys(scene, used);
  for (const Json& action : scene["actions"]) calls.push_back(action["call"]);
  for (const ObjectInfo& object : engines().front().scene_format()) {
    for (const VariantInfo& variant : object.variants) {
      for (const FieldInfo& field : variant.fields) {
        EXPECT_NE(std::find(used.begin(), used.end(), field.key), used.end()) << object.name << " " << field.key;
      }
      if (object.name != "action") continue;
      EXPECT_NE(std::find(calls.begin(), calls.end(), variant.tag), calls.end()) << variant.tag;
    }
  }
}

/// Leaves out one key after the other, wherever it is, and plays what is left.
void leave_out_each(Json& scene, Json& part, const std::string& path, const Played& whole, uint32_t& count) {
  if (!part.is_structured()) return;
  std::vector<std::string> keys;
  if (part.is_object()) {
    for (const auto& [key, value] : part.items()) keys.push_back(key);
  }
  for (const std::string& key : keys) {
    // These change nothing that is played; where there is no room for manifolds, `reuse` neither.
    if (key == "$schema" || key == "digest" || key == "contact_recycle_distance") continue;
    const Json full = part;
    part.erase(key);
    const Played left = play(scene.dump());
    part = full;
    ++count;
    EXPECT_FALSE(left.recording == whole.recording && left.lines == whole.lines && left.problems == whole.problems &&
                 left.outcome.description == whole.outcome.description)
        << path << "." << key << " does not matter";
  }
  for (const auto& [key, value] : part.items()) leave_out_each(scene, value, path + "." + key, whole, count);
}

TEST(scene_run, every_key_matters) {
  Json scene = Json::parse(every());
  const Played whole = play(scene.dump());
  ASSERT_EQ(whole.problems, "");
  uint32_t count = 0;
  leave_out_each(scene, scene, "", whole, count);
  EXPECT_GT(count, 300u);
}

/// What the keys mean: the same world made by calls.
TEST(scene_run, definitions_of_a_file_are_those_of_code) {
  using namespace detent;
  struct Storage {
    WorldStorage<Capacity{.bodies = 8, .contacts = 8, .joints = 2, .sensed = 8}> storage;
  };
  const auto block = std::make_unique<Storage>();
  WorldDef settings;
  settings.gravity = {0.5, -5.0, 0.25};
  settings.tick = Real(0.01);
  settings.iterations = 2;
  settings.contact_frequency = 0.125;
  settings.damping_ratio = 5.0;
  settings.contact_margin = 0.03125;
  settings.contact_recycle_distance = 0.001953125;
  World world;
  ASSERT_EQ(block->storage.create(settings, world), Status::ok);
  BodyDef ball;
  ball.type = BodyType::kinematic;
  ball.position = {1.0, 2.0, 3.0};
  ball.rotation = {0.5, -0.5, 0.5, 0.5};
  ball.linear_velocity = {4.0, 5.0, 6.0};
  ball.angular_velocity = {7.0, 8.0, 9.0};
  ball.shape = capsule(0.25, 0.75);
  ball.material = {0.125, 0.25, 0.375, RestitutionRule::smaller};
  ball.mass = 3.0;
  ball.linear_damping = 0.5;
  ball.angular_damping = 0.75;
  ball.gravity_scale = 2.0;
  ball.user_data = 11;
  ball.filter = {12, 13, -14, 0};
  ball.sensor = true;
  BodyDef crate;
  crate.position = {8.0, 0.0, 0.0};
  crate.shape = rounded(box({0.5, 1.0, 1.5}), 0.0625);
  crate.density = 20.0;
  crate.rotation_locks = k_rotation_lock_y;
  BodyId ids[2];
  ASSERT_EQ(create_body(world, ball, ids[0]), Status::ok);
  ASSERT_EQ(create_body(world, crate, ids[1]), Status::ok);
  JointDef joint;
  joint.type = JointType::wheel;
  joint.a = ids[0];
  joint.b = ids[1];
  joint.anchor_a = {1.0, 2.0, 3.0};
  joint.anchor_b = {4.0, 5.0, 6.0};
  joint.frame_a = {1.0, 0.0, 0.0, 0.0};
  joint.frame_b = {0.0, 1.0, 0.0, 0.0};
  joint.axis = {true, -1.0, 2.0, 3.0, 4.0, 0.5, 6.0, 7.0};
  joint.second = {false, 0.0, 0.0, 0.0, 1.0, 0.0, 8.0, 9.0};
  joint.collide = true;
  joint.break_force = 10.0;
  joint.break_torque = 11.0;
  joint.friction_force = 13.0;
  joint.friction_torque = 14.0;
  joint.user_data = 12;
  JointId joint_id;
  ASSERT_EQ(create_joint(world, joint, joint_id), Status::ok);

  const Played played = play(R"({"format": 1, "ticks": 0,
    "world": {"gravity": [0.5, -5, 0.25], "tick": 0.01, "iterations": 2, "contact_frequency": 0.125, "damping_ratio": 5,
              "contact_margin": 0.03125, "contact_recycle_distance": 0.001953125},
    "bodies": [
      {"name": "ball", "type": "kinematic", "position": [1, 2, 3], "rotation": [0.5, -0.5, 0.5, 0.5],
       "linear_velocity": [4, 5, 6], "angular_velocity": [7, 8, 9], "shape": {"type": "capsule", "radius": 0.25, "half_length": 0.75},
       "material": {"friction": 0.125, "restitution": 0.25, "rolling_resistance": 0.375, "restitution_rule": "smaller"},
       "mass": 3, "linear_damping": 0.5, "angular_damping": 0.75, "gravity_scale": 2, "user_data": 11,
       "filter": {"category": 12, "mask": 13, "group": -14}, "sensor": true},
      {"name": "crate", "position": [8, 0, 0], "density": 20, "rotation_locks": ["y"],
       "shape": {"type": "box", "half_extents": [0.5, 1, 1.5], "rounding": 0.0625}}],
    "joints": [
      {"type": "wheel", "a": "ball", "b": "crate", "anchor_a": [1, 2, 3], "anchor_b": [4, 5, 6],
       "frame_a": [1, 0, 0, 0], "frame_b": [0, 1, 0, 0],
       "axis": {"limited": true, "lower": -1, "upper": 2, "frequency": 3, "damping_ratio": 4, "target": 0.5,
                "speed": 6, "force_max": 7},
       "second": {"speed": 8, "force_max": 9},
       "collide": true, "break_force": 10, "break_torque": 11, "friction_force": 13, "friction_torque": 14,
       "user_data": 12}]})",
                             engine_of(DETENT_CONFIG_TEXT));
  ASSERT_EQ(played.problems, "");
  EXPECT_EQ(played.outcome.digest, digest(world));
}

TEST(scene_run, angles_in_degrees_turn_as_they_say) {
  const auto turned = [](const std::string& rotation) {
    const Played played =
        play(R"({"format": 1, "ticks": 0, "bodies": [{"shape": {"type": "sphere", "radius": 1}, "rotation": )" +
             rotation + "}]}");
    EXPECT_EQ(played.problems, "");
    const size_t start = played.lines.find("rotation");
    return played.lines.substr(start, played.lines.find(" linear_velocity") - start);
  };
  const std::string quarter_x = "rotation  0.707107 0.000000 0.000000 0.707107";
  EXPECT_EQ(turned("{\"axis\": [5, 0, 0], \"degrees\": 90}"), quarter_x);
  EXPECT_EQ(turned("{\"euler_degrees\": [90, 0, 0]}"), quarter_x);
  // About the world's x and then its y: z goes to -y and stays there, y to z and to x.
  EXPECT_EQ(turned("{\"euler_degrees\": [90, 90, 0]}"), "rotation  0.500000 0.500000 -0.500000 0.500000");
  EXPECT_EQ(turned("{\"axis\": [0, 1, 0], \"degrees\": 180}"), "rotation  0.000000 1.000000 0.000000 0.000000");
}

TEST(scene_run, actions_come_before_their_ticks_in_the_order_of_the_file) {
  const Played played = play(R"({"format": 1, "ticks": 4, "world": {"gravity": [0, 0, 0], "tick": 0.125},
    "bodies": [{"name": "a", "shape": {"type": "sphere", "radius": 1}}],
    "actions": [
      {"tick": 2, "until": 3, "call": "set_velocity", "body": "a", "linear_velocity": [0, 8, 0], "angular_velocity": [0, 0, 0]},
      {"tick": 0, "call": "set_velocity", "body": "a", "linear_velocity": [8, 0, 0], "angular_velocity": [0, 0, 0]},
      {"tick": 3, "call": "set_velocity", "body": "a", "linear_velocity": [0, 0, 8], "angular_velocity": [0, 0, 0]}]})");
  EXPECT_EQ(played.problems, "");
  EXPECT_EQ(played.outcome.calls, 4u);
  EXPECT_NE(played.lines.find("4 at body a position  2.000000 1.000000 1.000000"), std::string::npos) << played.lines;
}

TEST(scene_run, a_capacity_that_is_left_out_has_room_for_all) {
  const Played played = play(R"({"format": 1, "ticks": 40,
    "bodies": [{"type": "fixed", "shape": {"type": "half_space"}}],
    "actions": [{"tick": 3, "until": 32, "call": "create_body",
                 "body": {"shape": {"type": "sphere", "radius": 0.5}, "position": [0, 9, 0], "linear_velocity": [9, 0, 0]}}]})");
  EXPECT_EQ(played.problems, "");
  EXPECT_EQ(played.outcome.bodies, 31u);
  EXPECT_EQ(played.outcome.ticks_incomplete, 0u);
}

TEST(scene_run, a_capacity_that_is_too_small_is_told_with_one_that_fits) {
  const auto with_capacity = [](const std::string& capacity) {
    return play(R"({"format": 1, "ticks": 30, "world": {"capacity": )" + capacity + R"(},
      "bodies": [{"type": "fixed", "shape": {"type": "half_space"}},
                 {"type": "fixed", "sensor": true, "position": [0, 1, 0],
                  "shape": {"type": "box", "half_extents": [20, 2, 20]}},
                 {"name": "ball {i}", "repeat": {"i": 8}, "step": {"i": [2, 0, 0]}, "position": [0, 0.5, 0],
                  "shape": {"type": "sphere", "radius": 0.5}}]})");
  };
  const Played small = with_capacity(R"({"bodies": 10, "contacts": 2, "sensed": 3})");
  ASSERT_EQ(small.problems, "");
  EXPECT_EQ(small.outcome.ticks_full, 30u);
  EXPECT_EQ(small.outcome.ticks_incomplete, 30u);
  const auto number = [](uint32_t value) { return std::to_string(value); };
  const Played fitted = with_capacity("{\"bodies\": " + number(small.outcome.bodies_fit) +
                                      ", \"contacts\": " + number(small.outcome.contacts_fit) +
                                      ", \"sensed\": " + number(small.outcome.sensed_fit) + "}");
  ASSERT_EQ(fitted.problems, "");
  EXPECT_EQ(fitted.outcome.ticks_full, 0u);
  EXPECT_EQ(fitted.outcome.ticks_incomplete, 0u);
}

TEST(scene_run, the_scene_on_the_page_is_one) {
  const std::string page = file_text(DETENT_ROOT "/docs/scene.md");
  const size_t start = page.find("```json\n") + 8;
  const Played played = play(page.substr(start, page.find("```", start) - start));
  EXPECT_EQ(played.problems, "");
  EXPECT_EQ(played.outcome.ticks, 300u);
  EXPECT_NE(played.lines.find("found name below body ball"), std::string::npos) << played.lines;
}

TEST(scene_run, what_a_file_says_is_printed_without_what_a_terminal_obeys) {
  RunCommand command;
  command.path = testing::TempDir() + "names.json";
  command.config = engines().front().config;
  command.request.prints = {true, true, true, true};
  std::ofstream(command.path) << R"({"format": 1, "ticks": 1,
    "bodies": [{"name": "\u001b[2J", "shape": {"type": "sphere", "radius": 0.5}}],
    "actions": [{"tick": 0, "call": "query_ray", "name": "\u0007", "origin": [0, 8, 0], "displacement": [0, -10, 0]}]})";
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run_scene_file(command));
  const std::string printed = testing::internal::GetCapturedStdout();
  std::filesystem::remove(command.path);
  EXPECT_NE(printed.find("body ?[2J"), std::string::npos) << printed;
  for (const char letter : printed) EXPECT_TRUE(static_cast<unsigned char>(letter) >= ' ' || letter == '\n');
}

TEST(scene_run, events_and_answers_are_told_by_name) {
  const Played played = play(R"({"format": 1, "ticks": 60, "world": {"gravity": [0, -10, 0]},
    "bodies": [{"name": "ground", "type": "fixed", "shape": {"type": "half_space"}},
               {"name": "gate", "type": "fixed", "position": [0, 1, 0], "sensor": true,
                "shape": {"type": "box", "half_extents": [1, 0.125, 1]}},
               {"name": "ball", "position": [0, 3, 0], "shape": {"type": "sphere", "radius": 0.5}},
               {"name": "hook", "type": "fixed", "position": [9, 3, 0], "shape": {"type": "sphere", "radius": 0.5}},
               {"name": "bag", "position": [9, 1, 0], "shape": {"type": "sphere", "radius": 0.5}}],
    "joints": [{"name": "thread", "a": "hook", "b": "bag", "point": [9, 3, 0], "break_force": 1}],
    "actions": [{"tick": 0, "call": "query_ray", "name": "down", "origin": [0, 8, 0], "displacement": [0, -10, 0]},
                {"tick": 0, "call": "query_ray", "name": "bodies", "origin": [0, 8, 0], "displacement": [0, -10, 0],
                 "all": true}]})");
  EXPECT_EQ(played.problems, "");
  for (const char* line :
       {"0 query_ray name down hits  1.0", "0 found name down body ball fraction  0.450000 point  0.000000 3.500000",
        "0 query_ray name bodies hits  2.0", "0 found name bodies body ground fraction  0.800000",
        " enter sensor gate body ball", " begin a ground b ball", " hit a ground b ball",
        "1 break joint thread a hook b bag", "60 tick digest ", "60 at body ball position  0.000000 0.49"}) {
    EXPECT_NE(played.lines.find(line), std::string::npos) << line << "\n" << played.lines;
  }
}

}  // namespace
}  // namespace detent_tool
