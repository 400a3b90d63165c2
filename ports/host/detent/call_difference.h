#pragma once
#include <detent/config.h>

#include <vector>

#include "difference.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using CallRecords = std::vector<std::vector<uint8_t>>;

/// Finds the first call in which the two lists differ. Returns false if there is none. Does not change
/// `difference.tick`.
bool find_call_difference(const CallRecords& a, const CallRecords& b, detent_tool::CallDifference& difference);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
