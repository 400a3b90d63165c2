#pragma once
#include <detent/recording.h>

#include "difference.h"
#include "engine.h"
#include "owned_world.h"
#include "recorded.h"
#include "stream.h"

/// The readers of an engine, in each configuration: the functions of Engine with the same names.
namespace detent {
inline namespace DETENT_NAMESPACE {

Source source_of(detent_tool::Input& input);
Sink sink_of(detent_tool::Output& output);
/// Determines the kind of a file from its first k_file_kind_bytes bytes, or from all bytes of a shorter file.
detent_tool::FileKind kind_of(const uint8_t* bytes, uint32_t count);
/// Returns one line with the place where a replay stopped, and the reason.
std::string problem_text(const ReplayError& error, detent_tool::Input& input);

/// The world in which a recording is replayed.
struct ReplayWorld {
  OwnedWorld owned;
  std::vector<Asset> table;

  /// Errors: truncated (the file is too small for its seed), out_of_range, buffer_too_small.
  Status create(const RecordingInfo& info, const detent_tool::Input& input, const detent_tool::Assets& assets);
};

detent_tool::Header header_of(const RecordingInfo& info);
detent_tool::Outcome failed(const std::string& problem);
/// The outcome for a recording that Player::open() refuses with this error.
detent_tool::Outcome failed_to_open(const ReplayError& error, detent_tool::Input& input);

detent_tool::Outcome verify(const detent_tool::ReadRequest& request, const detent_tool::Progress& progress);
detent_tool::Outcome info(const detent_tool::ReadRequest& request, const detent_tool::Progress& progress);
detent_tool::Outcome state(const detent_tool::ReadRequest& request, std::vector<detent_tool::BodyLine>& bodies);
detent_tool::Outcome recover(const detent_tool::ReadRequest& request, const std::string& path,
                             const detent_tool::Progress& progress);

detent_tool::Difference diff(const detent_tool::DiffRequest& request);
detent_tool::Difference diff(const detent_tool::Recorded& a, const detent_tool::Recorded& b,
                             const detent_tool::Assets& assets);
detent_tool::Difference explain(const detent_tool::ReadRequest& request, uint64_t tick);
detent_tool::Outcome trace(const detent_tool::TraceRequest& request, const detent_tool::Progress& progress);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
