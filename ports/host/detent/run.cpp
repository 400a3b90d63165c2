#include "run.h"

#include <nlohmann/json.hpp>

#include "file.h"
#include "json_line.h"
#include "progress.h"
#include "text.h"

namespace detent_tool {

namespace {

using Json = nlohmann::ordered_json;

std::string plain(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void print_text(const RunLine& line) {
  std::string text = "tick " + std::to_string(line.tick) + " " + line.what;
  for (const RunLine::Value& value : line.values) {
    text += std::string(", ") + value.name + " ";
    if (value.list) text += "(";
    if (value.numbers.empty()) text += value.text;
    for (size_t i = 0; i < value.numbers.size(); ++i) text += (i == 0 ? "" : ", ") + plain(value.numbers[i]);
    if (value.list) text += ")";
  }
  printf("%s\n", printable(text).c_str());
}

void print_object(const RunLine& line) {
  Json json = {{"tick", line.tick}, {"what", line.what}};
  for (const RunLine::Value& value : line.values) {
    if (value.list) {
      json[value.name] = value.numbers;
    } else if (value.numbers.empty()) {
      json[value.name] = value.text;
    } else {
      json[value.name] = value.numbers.front();
    }
  }
  print_json_line(json);
}

bool refuse(const RunCommand& command, const std::vector<Problem>& problems) {
  if (command.json) {
    Json list = Json::array();
    for (const Problem& problem : problems) {
      list.push_back({{"line", problem.line}, {"path", problem.path}, {"problem", problem.text}});
    }
    print_json_line({{"file", command.path}, {"ok", false}, {"problems", list}});
  } else {
    for (const Problem& problem : problems) fprintf(stderr, "%s\n", problem_text(command.path, problem).c_str());
  }
  return false;
}

void summarise(const RunCommand& command, const RunOutcome& outcome) {
  if (command.json) {
    Json json = {{"file", command.path}, {"ok", true}, {"config", command.config}};
    if (!outcome.description.empty()) json["description"] = outcome.description;
    json["ticks"] = outcome.ticks;
    json["ticks_incomplete"] = outcome.ticks_incomplete;
    json["ticks_full"] = outcome.ticks_full;
    json["capacity_fit"] = {{"bodies", outcome.bodies_fit},
                            {"contacts", outcome.contacts_fit},
                            {"joints", outcome.joints_fit},
                            {"sensed", outcome.sensed_fit}};
    json["calls"] = outcome.calls;
    json["bodies"] = outcome.bodies;
    json["joints"] = outcome.joints;
    json["assets"] = Json::array();
    for (size_t i = 0; i < outcome.assets.size(); ++i) {
      json["assets"].push_back({{"file", outcome.assets[i]}, {"digest", outcome.asset_digests[i]}});
    }
    if (!command.request.recording.empty()) {
      json["recording"] = command.request.recording;
      json["recording_bytes"] = outcome.recording_bytes;
    }
    json["digest"] = hexadecimal(outcome.digest);
    json["seconds"] = outcome.seconds;
    return print_json_line(json);
  }
  for (size_t i = 0; i < outcome.assets.size(); ++i) {
    printf("asset %zu: %s, digest %s\n", i, printable(outcome.assets[i]).c_str(), outcome.asset_digests[i].c_str());
  }
  std::string text = command.path + ": " + command.config + ", " + std::to_string(outcome.ticks) + " ticks, " +
                     std::to_string(outcome.bodies) + " bodies, " + std::to_string(outcome.joints) + " joints, ";
  if (!command.request.recording.empty()) {
    text += std::to_string(outcome.recording_bytes) + " bytes to " + command.request.recording + ", ";
  }
  printf("%sfinal digest %s\n", text.c_str(), hexadecimal(outcome.digest).c_str());
  if (outcome.ticks_full != 0) {
    std::string fit =
        "\"bodies\": " + std::to_string(outcome.bodies_fit) + ", \"contacts\": " + std::to_string(outcome.contacts_fit);
    if (outcome.sensed_fit != 0) fit += ", \"sensed\": " + std::to_string(outcome.sensed_fit);
    fprintf(stderr, "%s: %llu ticks had no room for what met: \"capacity\": {%s} would do\n", command.path.c_str(),
            static_cast<unsigned long long>(outcome.ticks_full), fit.c_str());
  }
  if (outcome.ticks_incomplete > outcome.ticks_full) {
    fprintf(stderr, "%s: %llu ticks lost range, contacts beyond the most that a pair may have, or a body's time\n",
            command.path.c_str(), static_cast<unsigned long long>(outcome.ticks_incomplete - outcome.ticks_full));
  }
}

}  // namespace

bool read_scene_file(const std::string& path, Node& root, Problem& problem) {
  std::vector<uint8_t> bytes;
  problem.text = read_file(path, bytes, k_json_bytes_max);
  if (problem.text.empty() && kind_of(bytes) != FileKind::other) problem.text = is_not(kind_of(bytes), "a scene");
  if (problem.text.empty() && bytes.empty()) problem.text = "is empty, not a scene";
  if (!problem.text.empty()) return false;
  return parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, root, problem);
}

bool run_scene_file(const RunCommand& command) {
  Problem problem;
  Node root;
  if (!read_scene_file(command.path, root, problem)) return refuse(command, {problem});
  RunRequest request = command.request;
  request.path = command.path;
  request.root = &root;
  for (const Engine& engine : engines()) {
    if (command.config != engine.config) continue;
    RunOutcome outcome;
    {
      ProgressBar bar(command.path);
      outcome = engine.run(request, command.json ? print_object : print_text,
                           [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
    }
    if (!outcome.problems.empty()) return refuse(command, outcome.problems);
    summarise(command, outcome);
    return true;
  }
  return refuse(command, {{0, "", "no such configuration: " + command.config}});
}

}  // namespace detent_tool
