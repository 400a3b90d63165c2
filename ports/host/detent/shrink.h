#pragma once
#include <array>
#include <string>

#include "engine.h"

namespace CLI {
class App;
}

/// `detent shrink`: finds the smallest recording that still shows a fault (docs/shrink.md).
namespace detent_tool {

enum class FaultKind : uint32_t {
  tunnels,     ///< a dynamic body's centre passes the surface of a fixed body
  opens,       ///< the anchors of a joint are apart
  penetrates,  ///< two bodies overlap deeply
  differs,     ///< the recording does not verify
  lost,        ///< a step drops something for lack of room or leaves something undecided (lost.h)
  status,      ///< a call is refused
};
inline constexpr std::array<const char*, 6> k_fault_names = {"tunnels", "opens", "penetrates",
                                                             "differs", "lost",  "status"};

/// Bounds that are used if the command gives none; they are the bounds of the zoo (docs/zoo.md): fractions of a body's
/// size (gap) and of its thickness (depth).
inline constexpr double k_gap_bound = 0.02, k_depth_bound = 0.5;
inline constexpr uint32_t k_replays_max = 1000;

struct ShrinkRequest {
  ReadRequest reading = {};  ///< `from`: faults after this tick count
  std::string output = {};
  FaultKind kind = FaultKind::lost;
  double bound = 0;         ///< of `opens` and `penetrates`; 0: k_gap_bound or k_depth_bound
  uint32_t body = 0;        ///< the slot of the body that the fault concerns; 0: any
  uint64_t lead_ticks = 0;  ///< ticks to keep before the tick that shows the fault
  uint32_t replays_max = k_replays_max;
};

/// The amounts in a recording, up to the tick that shows the fault.
struct ShrinkSize {
  uint64_t ticks = 0, bodies = 0, joints = 0;
  uint64_t calls = 0;  ///< without queries
  uint64_t bytes = 0;  ///< of the file
};

struct Shrunk {
  ShrinkSize before, after;
  std::string fault;         ///< what the written recording shows
  uint64_t tick_before = 0;  ///< the tick that shows the fault in the given recording
  uint64_t tick = 0;         ///< the tick that shows the fault in the written recording
  uint32_t replays = 0;
  bool limit_reached = false;  ///< there were not enough replays to try everything
};

struct ShrinkCommand {
  ShrinkRequest request;
  std::string kind;  ///< one of k_fault_names
  std::string page;  ///< empty: none
  std::vector<std::string> asset_paths;
  bool json = false;
};
/// Adds the sub-command and its options, except for the options that all commands have.
CLI::App* add_shrink_command(CLI::App& app, ShrinkCommand& command);
/// Completes the request after the command line was read. Returns what is wrong with the options; empty if nothing is.
std::string take_shrink_options(ShrinkCommand& command);
/// Shrinks the recording, and prints how much remains. Returns false on a problem, and prints it.
bool shrink_file(const ShrinkCommand& command);

}  // namespace detent_tool
