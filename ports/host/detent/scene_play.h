#pragma once
#include <vector>

#include "run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Reads the scene and plays it. Nothing is written or played if anything in it is wrong.
detent_tool::RunOutcome play_scene(const detent_tool::RunRequest& request, const detent_tool::RunPrinter& print,
                                   const detent_tool::Progress& progress);
/// Every object of the format, the whole file first.
std::vector<detent_tool::ObjectInfo> describe_scene();

}  // namespace DETENT_NAMESPACE
}  // namespace detent
