#pragma once
#include "reading.h"
#include "recorded.h"
#include "shrink.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The implementation of Engine::shrink.
detent_tool::Outcome shrink(const detent_tool::ShrinkRequest& request, detent_tool::Shrunk& shrunk,
                            const detent_tool::Progress& progress);
/// Shrinks a recording that does not verify: keeps the ticks from the last digest that equals this machine's to the
/// first that does not. Leaves out no body and no call, because the digests of the other machine are only known for all
/// of them together.
detent_tool::Outcome shrink_difference(const detent_tool::ShrinkRequest& request, const detent_tool::Recorded& recorded,
                                       detent_tool::Shrunk& shrunk, const detent_tool::Progress& progress);
/// Writes the recording to the request's output. Returns the problem; empty if none.
std::string write_shrunk(const detent_tool::ShrinkRequest& request, const std::vector<uint8_t>& bytes,
                         detent_tool::Shrunk& shrunk);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
