#pragma once
#include <vector>

#include "run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Reads the scene and plays it. If the scene has an error, plays nothing and writes nothing.
detent_tool::RunOutcome play_scene(const detent_tool::RunRequest& request, const detent_tool::RunPrinter& print,
                                   const detent_tool::Progress& progress);
/// Describes every kind of object in the scene format. The first is the file as a whole.
std::vector<detent_tool::ObjectInfo> describe_scene();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
