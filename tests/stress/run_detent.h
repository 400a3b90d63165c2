#pragma once
#include <detent/world.h>

#include "tests/stress/run.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// This library in the configuration that the source is compiled for.
detent_stress::Engine stress_engine();
/// The world of one of its runs.
World& world_of(detent_stress::Run& run);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
