#pragma once
#include <detent/config.h>

#include "tests/bench/scaling/engine.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// ScalingEngine::measure_impacts of this configuration.
std::vector<detent_bench::ImpactRow> measure_impacts(const std::string& scene, const std::vector<uint32_t>& threads);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
