#pragma once
#include <detent/recording.h>

#include "engine.h"

/// What an engine reads, in each configuration: the functions of Engine by their names.
namespace detent {
inline namespace DETENT_NAMESPACE {

detent_tool::Header header_of(const RecordingInfo& info);
detent_tool::Outcome failed(const std::string& problem);

detent_tool::Outcome verify(const detent_tool::ReadRequest& request, const detent_tool::Progress& progress);
detent_tool::Outcome info(const detent_tool::ReadRequest& request, const detent_tool::Progress& progress);
detent_tool::Outcome state(const detent_tool::ReadRequest& request, std::vector<detent_tool::BodyLine>& bodies);
detent_tool::Outcome recover(const detent_tool::ReadRequest& request, const std::string& path,
                             const detent_tool::Progress& progress);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
