#pragma once
#include <stdint.h>

#include <functional>
#include <string>
#include <vector>

/// What the tool asks of one math configuration. The implementation is compiled once per configuration; nothing here
/// depends on one, so that the program can hold all four and take the one that a recording's header names.
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
  refused,  ///< sound as far as it was read, but of another simulation version, configuration or format
  bad,      ///< damaged, unreadable, or the replay went another way
};

/// What became of one file.
struct Outcome {
  Verdict verdict = Verdict::good;
  std::string problem;          ///< one line, without the file's name: empty if good
  std::string status;           ///< the library's words for the problem
  std::string field;            ///< what is wrong
  uint64_t offset = 0;          ///< where in the file, bytes
  uint64_t tick = 0;            ///< after how many completed ticks
  uint64_t first_bad_tick = 0;  ///< the first tick that is not known to be right
  bool digests_differ = false;  ///< of a state after a tick: the recorded and this machine's
  std::string difference_text;  ///< what more the recording tells of that, for people
  std::string difference;       ///< of a digest that differs: a JSON object (difference.h)
  std::string lost;             ///< what a recovered recording had: as `problem`

  bool header_known = false;
  bool other_config = false;  ///< refused for its configuration: another engine may hold it
  Header header;
  uint64_t file_bytes = 0;
  uint64_t ticks = 0;    ///< made, or read
  uint64_t digests = 0;  ///< of ticks: compared and equal, or read, or written
  uint64_t calls = 0;    ///< besides steps
  uint64_t digest = 0;   ///< of the final state
  double seconds = 0;
  std::string release;  ///< the tool of another simulation version that said this; empty: this one
};

/// Called now and then during long work.
using Progress = std::function<void(uint64_t done, uint64_t total)>;

struct RecordRequest {
  std::string scene;
  std::string path;
  uint32_t ticks = 0;  ///< 0: the scene's own
  uint32_t digest_interval = 1;
  uint32_t keyframe_interval = 0;
  bool compressed = false;
};

/// What a file is by its first bytes.
enum class FileKind : uint32_t {
  other,
  recording,
  snapshot,
  hull,
  compound,
  mesh,
  height_field
};  // cooked from hull on
inline constexpr uint32_t k_file_kind_bytes = 8;
/// What to say of a file that is not what was asked for: "is a cooked hull, not " and what `wanted` names.
inline std::string is_not(FileKind kind, const std::string& wanted) {
  constexpr const char* k_texts[] = {
      "", "a recording", "a snapshot", "a cooked hull", "a cooked compound", "a cooked mesh", "a cooked height field"};
  if (kind == FileKind::other) return "is not " + wanted;
  return std::string("is ") + k_texts[static_cast<uint32_t>(kind)] + ", not " + wanted;
}

/// The bytes of a cooked file, at addresses that are multiples of 8.
struct AssetBytes {
  std::vector<uint64_t> words;
  uint32_t byte_count = 0;
  FileKind kind = FileKind::other;
};
using Assets = std::vector<AssetBytes>;
/// What went wrong, or nothing. A file that is not cooked is wrong.
std::string read_asset(const std::string& path, AssetBytes& asset);

struct ObjectInfo;
struct RunLine;
struct RunOutcome;
struct RunRequest;

/// What to read, by the ticks that the world has completed.
struct ReadRequest {
  std::string path;
  Assets assets = {};  ///< of the recorded world; those of the scenes if there are none
  uint64_t from = 0;   ///< from the seed on, if that is later
  uint64_t to = UINT64_MAX;
};

/// Two recordings to compare, and the assets of their worlds.
struct DiffRequest {
  std::string a, b;
  Assets assets = {};
};

struct TraceRequest {
  ReadRequest reading = {};  ///< the window: both are ticks that are completed with it
  std::string output;
  bool full = true;
};

struct Difference;

/// A body, m, m/s, rad/s, in the world.
struct BodyLine {
  uint32_t slot = 0;
  uint32_t generation = 0;
  std::string type;
  bool awake = false;
  double position[3] = {};
  double rotation[4] = {};  ///< x, y, z, w
  double velocity[3] = {};
  double spin[3] = {};
};

struct Engine {
  const char* config;
  uint32_t format_version;
  uint32_t simulation_version;
  FileKind (*kind_of)(const uint8_t* bytes, uint32_t count);
  std::vector<SceneLine> (*scenes)();
  Outcome (*record)(const RecordRequest& request, const Progress& progress);
  Outcome (*verify)(const ReadRequest& request, const Progress& progress);
  /// Without a world.
  Outcome (*info)(const ReadRequest& request, const Progress& progress);
  /// The bodies after `request.to` ticks.
  Outcome (*state)(const ReadRequest& request, std::vector<BodyLine>& bodies);
  /// Writes what is whole of a recording, with an end, to `path`.
  Outcome (*recover)(const ReadRequest& request, const std::string& path, const Progress& progress);
  /// Where two recordings part.
  Difference (*diff)(const DiffRequest& request);
  /// Where a recording and this machine part, whose digests differ first after `tick` ticks.
  Difference (*explain)(const ReadRequest& request, uint64_t tick);
  /// Writes a recording of the same calls with this machine's states, traced.
  Outcome (*trace)(const TraceRequest& request, const Progress& progress);
  /// Scenes as data (run.h).
  RunOutcome (*run)(const RunRequest& request, const std::function<void(const RunLine&)>& print,
                    const Progress& progress);
  std::vector<ObjectInfo> (*scene_format)();
};

/// The engines of this build, in the order fx64, fx32, f32, f64.
const std::vector<Engine>& engines();

/// Of all bytes of a file, or the first ones.
FileKind kind_of(const std::vector<uint8_t>& bytes);
/// `other` also of a file that cannot be read.
FileKind kind_of_file(const std::string& path);

}  // namespace detent_tool
