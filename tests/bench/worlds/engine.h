#pragma once
#include <stdint.h>

#include <string>
#include <vector>

/// What the benchmark of many worlds asks of a configuration.
namespace detent_bench {

/// An arena with walls: players' balls that inputs push, and boxes. A match is settled for k_worlds_settling ticks
/// without inputs, so that all matches are equal until then.
struct WorldsScene {
  const char* name;
  uint32_t players;
  uint32_t bodies;       ///< that move, players included
  uint32_t ticks;        ///< that each world plays after that
  uint32_t match_ticks;  ///< of a recorded match
};
inline constexpr uint32_t k_worlds_settling = 60;

struct WorldsEffort {
  uint32_t worlds = 1000;                        ///< that are played in each row
  std::vector<uint32_t> alive = {1, 100, 1000};  ///< of them at the same time; 1: one for each thread
  std::vector<uint32_t> threads = {1, 2};
  uint32_t repetitions = 2;
  uint32_t recordings = 100;  ///< that are verified
};

/// All worlds, each played for the scene's ticks after the common state.
struct WorldsSteps {
  uint32_t alive = 0, threads = 0;
  double ticks_per_cpu_second = 0;  ///< of a thread
  double ticks_per_second = 0;      ///< of all threads, by the wall clock
};

/// Many recordings of matches, verified.
struct WorldsVerification {
  uint32_t jobs = 0;  ///< threads, or processes
  double matches_per_cpu_second = 0;
  double matches_per_second = 0;  ///< by the wall clock
};

/// Times are of one thread's processor, us; the least of the repetitions.
struct WorldsRow {
  std::string config, scene;
  uint32_t bodies = 0;
  double awake = 0;  ///< bodies that take part in a step after the common state; mean
  uint32_t world_bytes = 0, snapshot_bytes = 0;
  uint32_t difference_bytes = 0;        ///< of a world from the common state, after k_worlds_settling ticks more; mean
  double create = 0;                    ///< a world and its bodies
  double simulate = 0;                  ///< the ticks of the common start
  double restore = 0;                   ///< their result
  double difference = 0, undo = 0;      ///< writing a difference, and restoring it
  double tree = 0, tree_from_root = 0;  ///< all leaves of a tree of inputs: each edge once, and each leaf from the root
  std::vector<WorldsSteps> steps;
  uint32_t recording_bytes = 0;            ///< of a match; mean
  std::vector<WorldsVerification> verify;  ///< in this process, one world for each thread
  std::vector<WorldsVerification> tool;    ///< by `detent verify --jobs`, which has a process for each recording
  bool same = true;                        ///< whether all digests that must be equal were equal
};

using Recordings = std::vector<std::vector<uint8_t>>;

struct WorldsEngine {
  std::string config;
  /// Without `verify` and `tool`.
  WorldsRow (*measure)(const WorldsScene& scene, const WorldsEffort& effort);
  /// Matches, each of its own seed.
  Recordings (*record)(const WorldsScene& scene, uint32_t count);
  /// False if a tick of a recording differs.
  bool (*verify)(const WorldsScene& scene, const Recordings& recordings, uint32_t threads, WorldsVerification& result);
};
using WorldsEngineList = std::vector<WorldsEngine>;

/// Every configuration of this build.
WorldsEngineList all_worlds_engines();

}  // namespace detent_bench
