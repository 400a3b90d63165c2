#pragma once
#include <detent/world.h>

#include "tests/campaigns/stress/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The library in the configuration of this compilation.
detent_stress::Engine stress_engine();
/// The world of one of the engine's runs.
World& world_of(detent_stress::Run& run);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
