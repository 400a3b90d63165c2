#pragma once
#include <detent/config.h>

#include "tests/bench/scaling/engine.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// ScalingEngine::measure_rays of this configuration.
std::vector<detent_bench::RayRow> measure_rays(const detent_bench::ScalingScene& scene,
                                               const std::vector<uint32_t>& threads);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
