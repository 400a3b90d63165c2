#pragma once
#include <detent/config.h>

#include <vector>

#include "difference.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using CallRecords = std::vector<std::vector<uint8_t>>;

/// The first call in which the two lists differ. False if none does. `difference.tick` is left alone.
bool find_call_difference(const CallRecords& a, const CallRecords& b, detent_tool::CallDifference& difference);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
