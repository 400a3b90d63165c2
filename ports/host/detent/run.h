#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine.h"
#include "scene_format.h"
#include "scene_json.h"

/// `detent run`: plays a scene file (docs/scene.md) with the engine of one configuration.
namespace detent_tool {

/// One line of a run's output, as names and values.
struct RunLine {
  struct Value {
    const char* name;
    std::string text;             ///< the value; if empty, `numbers` is the value
    std::vector<double> numbers;  ///< one number, or a list
    bool list = false;
  };
  uint64_t tick = 0;  ///< completed ticks
  const char* what = "";
  std::vector<Value> values;

  void add(const char* name, const std::string& text) { values.push_back({name, text, {}, false}); }
  void add(const char* name, double number) { values.push_back({name, "", {number}, false}); }
  void add(const char* name, const std::vector<double>& numbers) { values.push_back({name, "", numbers, true}); }
};

struct RunPrints {
  bool bodies = false;   ///< the bodies' poses at the end
  bool events = false;   ///< the events of contacts, sensors, joints and sleep
  bool queries = false;  ///< the results of queries
  bool ticks = false;    ///< the digest after each tick
};

struct RunRequest {
  std::string path;  ///< of the scene file; its assets are in the same folder
  const Node* root = nullptr;
  bool ticks_given = false;
  uint32_t ticks = 0;
  std::string recording;                     ///< path of the recording to write; empty: none
  std::vector<uint8_t>* recorded = nullptr;  ///< receives the recording, instead of a file; null: unused
  uint32_t digest_interval = 1;
  uint32_t world_bytes_max = 1u << 30;  ///< a scene whose world needs more memory is refused
  RunPrints prints;
};

struct RunOutcome {
  std::vector<Problem> problems;  ///< empty on success
  std::string description;
  std::vector<std::string> assets;  ///< files of the asset table, relative to the scene's folder, in order
  std::vector<std::string> asset_digests;
  uint32_t bodies = 0;  ///< number of bodies at the end
  uint32_t joints = 0;
  uint64_t ticks = 0;
  uint64_t ticks_incomplete = 0;  ///< steps that dropped or clamped something: pairs, contacts, range
  uint64_t ticks_full = 0;        ///< steps among these in which a capacity was too small
  /// Capacities that would have been large enough.
  uint32_t bodies_fit = 0, contacts_fit = 0, joints_fit = 0, sensed_fit = 0;
  uint64_t calls = 0;
  uint64_t digest = 0;
  uint64_t recording_bytes = 0;
  double seconds = 0;
};

using RunPrinter = std::function<void(const RunLine&)>;

struct RunCommand {
  std::string path;
  std::string config;
  RunRequest request;
  bool json = false;
};
/// Parses a scene file to nodes; does not read the definitions. Returns false, with the problem, if the file cannot be
/// read or is no JSON.
bool read_scene_file(const std::string& path, Node& root, Problem& problem);
/// Reads and plays a scene, and prints the results. Returns false if anything failed, and prints the problems to
/// standard error.
bool run_scene_file(const RunCommand& command);

/// The JSON Schema of scenes, and the tables of docs/scene.md, as text.
std::string scene_schema(const std::vector<ObjectInfo>& objects);
std::string scene_tables(const std::vector<ObjectInfo>& objects);

}  // namespace detent_tool
