#pragma once
#include <vector>

#include "run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Reads the scene and plays it. Writes and plays nothing if the scene has any error.
detent_tool::RunOutcome play_scene(const detent_tool::RunRequest& request, const detent_tool::RunPrinter& print,
                                   const detent_tool::Progress& progress);
/// Describes every object of the format; the first is the whole file.
std::vector<detent_tool::ObjectInfo> describe_scene();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
