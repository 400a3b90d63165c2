#pragma once
#include <stdint.h>

#include <functional>
#include <string>
#include <vector>

/// The tool's interface to the library in one configuration. The implementation is compiled once for each
/// configuration. The types in this header do not depend on the configuration, so the program can contain all four
/// implementations and select the one that a recording's header names.
namespace detent_tool {

struct SceneLine {
  std::string name;
  std::string description;
  uint32_t ticks = 0;
  uint32_t bodies = 0;    ///< capacity
  uint32_t contacts = 0;  ///< capacity
};

/// The header of a recording.
struct Header {
  std::string config;
  uint32_t format_version = 0;
  uint32_t simulation_version = 0;
  uint32_t bodies = 0;    ///< capacity
  uint32_t contacts = 0;  ///< capacity
  uint32_t assets = 0;    ///< capacity
  uint32_t trace_level = 0;
  uint32_t digest_interval = 0;
  uint32_t keyframe_interval = 0;
  uint64_t first_tick = 0;
  uint32_t snapshot_bytes = 0;
};

enum class Verdict : uint32_t {
  good,
  /// Valid as far as it was read, but of another simulation version, configuration or format.
  refused,
  bad,  ///< damaged or unreadable, or the replay differs from the recording
};

/// The result for one file.
struct Outcome {
  Verdict verdict = Verdict::good;
  std::string problem;          ///< one line, without the file's name: empty if good
  std::string status;           ///< the library's text for the status of the problem
  std::string field;            ///< the faulty field
  uint64_t offset = 0;          ///< of the fault in the file, bytes from the start
  uint64_t tick = 0;            ///< completed ticks at the fault
  uint64_t first_bad_tick = 0;  ///< the first tick that may be wrong
  bool digests_differ = false;  ///< the recorded and the computed digest after a tick differ
  std::string difference_text;  ///< details of that difference, as text
  std::string difference;       ///< details of that difference, as a JSON object (difference.h)
  std::string lost;             ///< the damage of a recovered recording, in the form of `problem`

  bool header_known = false;
  bool other_config = false;  ///< refused for its configuration: its engine may read it
  Header header;
  uint64_t file_bytes = 0;
  uint64_t ticks = 0;    ///< number of ticks computed or read
  uint64_t digests = 0;  ///< number of ticks whose digests were equal, or were read or written
  uint64_t calls = 0;    ///< number of calls without steps
  uint64_t digest = 0;   ///< of the final state
  double seconds = 0;
  /// The path of the tool of another simulation version that produced this outcome; empty: this tool produced it.
  std::string release;
};

/// Called from time to time during long work, with the amount done and the total.
using Progress = std::function<void(uint64_t done, uint64_t total)>;

struct RecordRequest {
  std::string scene;
  std::string path;
  uint32_t ticks = 0;  ///< 0: the scene's own
  uint32_t digest_interval = 1;
  uint32_t keyframe_interval = 0;
  bool compressed = false;
};

/// The kind of a file, determined from its first bytes.
enum class FileKind : uint32_t {
  other,
  recording,
  snapshot,
  hull,
  compound,
  mesh,
  height_field
};  // all kinds from hull on are cooked files
inline constexpr uint32_t k_file_kind_bytes = 8;
/// The message for a file of the wrong kind, for example "is a cooked hull, not " and `wanted`.
inline std::string is_not(FileKind kind, const std::string& wanted) {
  constexpr const char* k_texts[] = {
      "", "a recording", "a snapshot", "a cooked hull", "a cooked compound", "a cooked mesh", "a cooked height field"};
  if (kind == FileKind::other) return "is not " + wanted;
  return std::string("is ") + k_texts[static_cast<uint32_t>(kind)] + ", not " + wanted;
}

/// The bytes of a cooked file, aligned to 8.
struct AssetBytes {
  std::vector<uint64_t> words;
  uint32_t byte_count = 0;
  FileKind kind = FileKind::other;
};
using Assets = std::vector<AssetBytes>;
/// Reads a cooked file. Returns the problem, empty if none. A file of another kind is a problem.
std::string read_asset(const std::string& path, AssetBytes& asset);

struct ObjectInfo;
struct RunLine;
struct RunOutcome;
struct RunRequest;

/// The file and the range of completed ticks to read.
struct ReadRequest {
  std::string path;
  Assets assets = {};  ///< of the recorded world; empty: the assets of the built-in scenes
  uint64_t from = 0;   ///< if the seed's tick is later, the seed's tick
  uint64_t to = UINT64_MAX;
};

/// Two recordings to compare, and the assets of their worlds.
struct DiffRequest {
  std::string a, b;
  Assets assets = {};
};

struct TraceRequest {
  ReadRequest reading = {};  ///< the window of ticks: from `from` to `to`, numbers of completed ticks
  std::string output;
  bool full = true;
};

struct Difference;
struct ShrinkRequest;
struct Shrunk;

/// A body's state in the world frame. Units: m, m/s, rad/s.
struct BodyLine {
  uint32_t slot = 0;
  uint32_t generation = 0;
  std::string type;
  bool awake = false;
  double position[3] = {};
  double rotation[4] = {};  ///< x, y, z, w
  double linear_velocity[3] = {};
  double angular_velocity[3] = {};
};

struct Engine {
  const char* config;
  uint32_t format_version;
  uint32_t simulation_version;
  FileKind (*kind_of)(const uint8_t* bytes, uint32_t count);
  std::vector<SceneLine> (*scenes)();
  Outcome (*record)(const RecordRequest& request, const Progress& progress);
  Outcome (*verify)(const ReadRequest& request, const Progress& progress);
  /// Reads the recording without a world: does not simulate.
  Outcome (*info)(const ReadRequest& request, const Progress& progress);
  /// Gives the states of the bodies after `request.to` ticks.
  Outcome (*state)(const ReadRequest& request, std::vector<BodyLine>& bodies);
  /// Writes the intact part of a damaged recording to `path`, and completes it with an end.
  Outcome (*recover)(const ReadRequest& request, const std::string& path, const Progress& progress);
  /// Finds the first difference of two recordings.
  Difference (*diff)(const DiffRequest& request);
  /// Finds the difference of a recording and its replay on this machine. Their digests first differ after `tick` ticks.
  Difference (*explain)(const ReadRequest& request, uint64_t tick);
  /// Writes a recording of the same calls with traces of this machine's states.
  Outcome (*trace)(const TraceRequest& request, const Progress& progress);
  /// Writes the smallest recording that still shows a fault (shrink.h).
  Outcome (*shrink)(const ShrinkRequest& request, Shrunk& shrunk, const Progress& progress);
  /// Plays scene files (run.h).
  RunOutcome (*run)(const RunRequest& request, const std::function<void(const RunLine&)>& print,
                    const Progress& progress);
  std::vector<ObjectInfo> (*scene_format)();
  /// The assets of the built-in scenes.
  Assets (*scene_assets)();
};

/// The engines of this build, in the order fx64, fx32, f32, f64.
const std::vector<Engine>& engines();

/// Determines the kind of a file. `bytes`: all bytes of the file, or its first bytes.
FileKind kind_of(const std::vector<uint8_t>& bytes);
/// Determines the kind of a file: `other` if the file cannot be read.
FileKind kind_of_file(const std::string& path);

}  // namespace detent_tool
